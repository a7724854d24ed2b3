"""`equipoise laws`: how a platform can be balanced."""

from equipoise.app.arguments.options import Flag


def laws(name: str | None = None, /, *, json: Flag = False) -> int:
    """List the laws of `equipoise balance --law`, or show the whole card of one.

    Errata that a source names are entries of docs/errata.md.

    Parameters
    ----------
    name
        Law to show. Left out: list them all.
    json
        Print one JSON document instead.
    """
    from equipoise.app.api import catalogues
    from equipoise.app.commands.methods import print_cards

    return print_cards(catalogues.laws(), name, json)
