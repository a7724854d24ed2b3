"""`equipoise laws`: how a platform can be balanced."""

from equipoise.app.arguments.options import Json


def laws(name: str | None = None, /, *, json: Json = False) -> int:
    """List the laws of `equipoise balance --law`, or show the whole card of one.

    Errata that a source names are entries of docs/errata.md.

    Parameters
    ----------
    name
        Law to show. Left out: list them all.
    """
    from equipoise.app.api import catalogues
    from equipoise.app.commands.methods import print_cards

    return print_cards(catalogues.laws(), name, json)
