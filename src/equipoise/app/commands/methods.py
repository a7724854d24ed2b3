"""`equipoise methods`: what there is to choose from."""

from equipoise.app.arguments.options import Flag


def methods(name: str | None = None, /, *, json: Flag = False) -> int:
    """List the methods of `equipoise identify`, or tell all about one of them.

    Errata that a source names are entries of docs/errata.md.

    Parameters
    ----------
    name
        Method to tell about. Left out: list them all.
    json
        Print one JSON document instead.
    """
    from equipoise.app.arguments.checks import one_of
    from equipoise.app.console.rich_blocks import show
    from equipoise.app.text.json_document import dump
    from equipoise.app.views.method_views import blocks, methods_json
    from equipoise.estimation.methods.registry import METHODS

    chosen = list(METHODS) if name is None else [one_of("method", name, list(METHODS))]
    cards = [METHODS[each].card for each in chosen]
    if json:
        print(dump(methods_json(cards)))
        return 0
    show(blocks(cards))
    return 0
