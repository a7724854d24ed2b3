"""Cards of methods and laws."""

from collections.abc import Iterator
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

from equipoise.app.api.catalogues import Catalogue
from equipoise.app.presentation.tables import Arrays, Table, of_table
from equipoise.app.text.blocks import Blocks, prose
from equipoise.app.text.blocks import table as text_table
from equipoise.app.text.json_shape import View

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def lines(catalogue: Catalogue) -> Iterator[str]:
    """Yield the names."""
    yield f"{len(catalogue)} {catalogue.kind}s: {', '.join(catalogue)}"


def _texts(card: Any) -> dict[str, str]:
    """Return what a card says, as texts."""
    return {key: ", ".join(value) if isinstance(value, tuple) else str(value)  # pyright: ignore
            for key, value in asdict(card).items()}  # fmt: skip


def blocks(catalogue: Catalogue) -> Blocks:
    """Return one table."""
    of = table(catalogue).columns
    rows = zip(*of.values(), strict=True)
    title = f"{catalogue.kind.capitalize()}s"
    return (text_table(title, (prose(key.replace("_", " ")) for key in of), rows),)


def document(catalogue: Catalogue) -> View:
    """Return what `equipoise methods --json` or `equipoise laws --json` prints."""
    from equipoise.app.views import method_views
    from equipoise.app.views.study import law_views

    cards: Any = list(catalogue.cards.values())
    if catalogue.kind == "method":
        return method_views.methods_json(cards)
    return law_views.laws_json(cards)


def table(catalogue: Catalogue) -> Table:
    """Return a row a card."""
    rows = [_texts(card) for card in catalogue.cards.values()]
    return Table("name", {key: [row[key] for row in rows] for key in rows[0]})


def arrays(catalogue: Catalogue) -> Arrays:
    """Return the table's columns along the names."""
    return of_table(table(catalogue))


def figure(catalogue: Catalogue) -> "Figure | None":
    """Return nothing: cards have no figure."""
    return None
