"""Cards of methods and laws."""

from collections.abc import Iterator
from dataclasses import asdict
from typing import Any

from equipoise.app.api.catalogues import Catalogue
from equipoise.app.presentation.tables import Table
from equipoise.app.text.blocks import Blocks, prose
from equipoise.app.text.blocks import table as text_table
from equipoise.app.text.json_shape import View


def lines(catalogue: Catalogue) -> Iterator[str]:
    """Yield the names."""
    yield f"{len(catalogue)} {catalogue.kind}s: {', '.join(catalogue)}"


def _texts(card: Any) -> dict[str, str]:
    """Return what a card says, as texts."""
    return {key: ", ".join(value) if isinstance(value, tuple) else str(value)  # pyright: ignore
            for key, value in asdict(card).items()}  # fmt: skip


def blocks(catalogue: Catalogue) -> Blocks:
    """Return one table."""
    of = table(catalogue)
    rows = zip(*of.values(), strict=True)
    title = f"{catalogue.kind.capitalize()}s"
    return (text_table(title, (prose(key.replace("_", " ")) for key in of), rows),)


def document(catalogue: Catalogue) -> View:
    """Return what `equipoise methods --json` or `equipoise laws --json` prints."""
    from equipoise.app.views import card_views

    return card_views.document(catalogue.kind, list(catalogue.cards.values()))


def table(catalogue: Catalogue) -> Table:
    """Return a row a card."""
    rows = [_texts(card) for card in catalogue.cards.values()]
    return {key: [row[key] for row in rows] for key in rows[0]}
