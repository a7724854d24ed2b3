"""Cards of methods and of laws for terminal and JSON."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any, Literal

from equipoise.app.text.blocks import Blocks, Column, Pairs, prose, table
from equipoise.app.text.json_lists import LAWS, METHODS
from equipoise.app.text.json_shape import Kind, View
from equipoise.model.law_card import NEEDS, LawCard
from equipoise.model.method_card import REGIMES, Card

CardKind = Literal["method", "law"]


@dataclass(frozen=True, slots=True, eq=False)
class Shown:
    """How cards of a kind are shown: in a list, one alone, and as JSON."""

    listed: tuple[str, ...]
    pairs: Callable[[Any], Iterable[tuple[str, str]]]
    document: Kind


def blocks(kind: CardKind, cards: Sequence[Card | LawCard]) -> Blocks:
    """Return one line a card; of one alone all that it says."""
    shown = SHOWN[kind]
    if len(cards) == 1:
        return (Pairs(tuple(shown.pairs(cards[0]))),)
    columns = (Column(kind), *map(prose, shown.listed))
    rows = ((card.name, *(as_text(getattr(card, key)) for key in shown.listed)) for card in cards)
    return (table("", columns, rows),)


def document(kind: CardKind, cards: Sequence[Card | LawCard]) -> View:
    """Return cards as JSON."""
    return SHOWN[kind].document.write({f"{kind}s": cards, "prospects": None})


def as_text(value: str | tuple[str, ...]) -> str:
    """Return what a card says under one of its keys; several texts as one."""
    return value if isinstance(value, str) else ", ".join(value)


def method_pairs(card: Card) -> list[tuple[str, str]]:
    """Return all that the card of a method says."""
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


def law_pairs(card: LawCard) -> list[tuple[str, str]]:
    """Return all that the card of a law says."""
    return [
        ("law", card.name),
        ("idea", card.idea),
        ("source", card.source),
        ("needs", ", ".join(NEEDS[need] for need in card.needs)),
        ("leaves", card.leaves),
        ("stable", card.stable),
        ("pace", f"{card.period:g} s between steps" if card.period > 0 else "as the record allows"),
    ]


SHOWN = {
    "method": Shown(("formulation", "solver", "source"), method_pairs, METHODS),
    "law": Shown(("idea", "needs", "source"), law_pairs, LAWS),
}
