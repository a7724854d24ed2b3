"""`equipoise laws`: how a platform can be balanced."""

from equipoise.app.commands.kinds import Flag
from equipoise.app.terminal import stdout


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
    from equipoise.app.law_views import card_table, laws_json, list_table
    from equipoise.app.options import one_of
    from equipoise.app.views_json import dump
    from equipoise.procedure.laws import CARDS

    chosen = list(CARDS) if name is None else [one_of("law", name, list(CARDS))]
    cards = [CARDS[each] for each in chosen]
    if json:
        print(dump(laws_json(cards)))
        return 0
    stdout().print(list_table(cards) if name is None else card_table(cards[0]))
    return 0
