"""Cards of laws for terminal and JSON."""

from collections.abc import Sequence
from dataclasses import asdict

from rich.table import Table

from equipoise.app.tables import named_rows, quiet_table
from equipoise.app.views_json import View
from equipoise.control.law import NEEDS, LawCard

SCHEMA = "equipoise/laws/1"


def list_table(cards: Sequence[LawCard]) -> Table:
    """Return one line a law."""
    table = quiet_table()
    table.add_column("law", style="bold", no_wrap=True)
    for head in ("idea", "needs", "source"):
        table.add_column(head)
    for card in cards:
        table.add_row(card.name, card.idea, ", ".join(card.needs), card.source)
    return table


def card_table(card: LawCard) -> Table:
    """Return all that a card says."""
    needs = ", ".join(NEEDS[need] for need in card.needs)
    period = f"{card.period:g} s between steps" if card.period > 0 else "as the record allows"
    return named_rows([
        ("law", card.name),
        ("idea", card.idea),
        ("source", card.source),
        ("needs", needs),
        ("leaves", card.leaves),
        ("stable", card.stable),
        ("pace", period),
    ])  # fmt: skip


def laws_json(cards: Sequence[LawCard]) -> View:
    """Return cards, schema equipoise/laws/1."""
    return {"schema": SCHEMA, "laws": [asdict(card) for card in cards]}
