"""`equipoise laws`: how a platform can be balanced."""

from equipoise.app.arguments.options import Flag


def laws(name: str | None = None, /, *, json: Flag = False) -> int:
    """List the laws of `equipoise balance --law`, or tell all about one of them.

    Errata that a source names are entries of docs/errata.md.

    Parameters
    ----------
    name
        Law to tell about. Left out: list them all.
    json
        Print one JSON document instead.
    """
    from equipoise.app.arguments.checks import one_of
    from equipoise.app.console.rich_blocks import show
    from equipoise.app.text.json_document import dump
    from equipoise.app.views.study.law_views import blocks, laws_json
    from equipoise.procedure.balancing.catalogue import CARDS

    chosen = list(CARDS) if name is None else [one_of("law", name, list(CARDS))]
    cards = [CARDS[each] for each in chosen]
    if json:
        print(dump(laws_json(cards)))
        return 0
    show(blocks(cards))
    return 0
