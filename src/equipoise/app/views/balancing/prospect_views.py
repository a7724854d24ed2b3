"""What to expect of laws on a testbed, for terminal and JSON."""

from collections.abc import Sequence

from equipoise.app.text.blocks import Blocks, Column, Pairs, prose, table
from equipoise.app.text.json_lists import LAWS
from equipoise.app.text.json_shape import View
from equipoise.app.views.card_views import law_pairs
from equipoise.model.law_card import NEEDS, LawCard, Prospect
from equipoise.model.units import MINUTE


def blocks(name: str, cards: Sequence[LawCard], prospects: Sequence[Prospect]) -> Blocks:
    """Return a line a law; of one alone its whole card too. ``name`` is the testbed's."""
    title = f"on {name}"
    if len(cards) == 1:
        return (Pairs((*law_pairs(cards[0]), (title, sentence(prospects[0])))),)
    rows = ((each.law, sentence(each)) for each in prospects)
    return (table("", (Column("law"), prose(title)), rows),)


def document(cards: Sequence[LawCard], prospects: Sequence[Prospect]) -> View:
    """Return cards and prospects as JSON."""
    return LAWS.write({"laws": cards, "prospects": prospects})


def sentence(prospect: Prospect) -> str:
    """Return what to expect, in words."""
    if prospect.missing:
        return f"lacks {', '.join(NEEDS[need] for need in prospect.missing)}"
    if prospect.refused is not None:
        return f"would not be stable: {prospect.refused}"
    if prospect.expected is None:
        return "can be used"
    return f"expected duration {prospect.expected / MINUTE:.1f} min for an offset of one com_sd"
