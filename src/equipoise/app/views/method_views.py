"""Cards of methods for terminal and JSON."""

from collections.abc import Sequence
from dataclasses import asdict

from rich.table import Table

from equipoise.app.console.rich_tables import named_rows, quiet_table
from equipoise.app.text.json_document import View
from equipoise.model.method_card import REGIMES, Card

SCHEMA = "equipoise/methods/1"


def list_table(cards: Sequence[Card]) -> Table:
    """Return one line a method."""
    table = quiet_table()
    table.add_column("method", style="bold", no_wrap=True)
    for head in ("formulation", "solver", "source"):
        table.add_column(head)
    for card in cards:
        table.add_row(card.name, card.formulation, card.solver, card.source)
    return table


def card_table(card: Card) -> Table:
    """Return all that a card says."""
    return named_rows(card_rows(card))


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
    """Return cards, schema equipoise/methods/1."""
    return {"schema": SCHEMA, "methods": [asdict(card) for card in cards]}
