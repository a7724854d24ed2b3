"""Cards of methods for terminal and JSON."""

from collections.abc import Sequence

from equipoise.app.text.blocks import Blocks, Column, Pairs, prose, table
from equipoise.app.text.json_lists import METHODS
from equipoise.app.text.json_shape import View
from equipoise.model.method_card import REGIMES, Card


def blocks(cards: Sequence[Card]) -> Blocks:
    """Return one line a method; of one alone all that its card says."""
    if len(cards) == 1:
        return (Pairs(tuple(card_rows(cards[0]))),)
    columns = (Column("method"), *map(prose, ("formulation", "solver", "source")))
    rows = ((card.name, card.formulation, card.solver, card.source) for card in cards)
    return (table("", columns, rows),)


def card_rows(card: Card) -> list[tuple[str, str]]:
    """Return what a card says, line by line."""
    return [
        ("method", card.name),
        ("formulation", card.formulation),
        ("solver", card.solver),
        ("source", card.source),
        ("needs", card.needs),
        ("cannot see", card.cannot_see),
        ("measured on", REGIMES[card.regime]),
        ("options", " ".join(f"--{choice}" for choice in card.heeds) or "none"),
    ]


def methods_json(cards: Sequence[Card]) -> View:
    """Return cards as JSON."""
    return METHODS.write({"methods": cards})
