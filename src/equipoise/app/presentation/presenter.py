"""The presenter that the package's root lends to records (``model.presentation``).

``KINDS`` is the only list of what shows which record; a module is loaded when it is needed.
"""

from collections.abc import Iterable
from importlib import import_module
from typing import TYPE_CHECKING, Any, Protocol

from equipoise.app.presentation.tables import Arrays, Table, to_dataset, to_frame
from equipoise.app.text.blocks import Blocks
from equipoise.model.errors import InputError
from equipoise.model.presentation import Shown

if TYPE_CHECKING:
    from matplotlib.figure import Figure

HERE = "equipoise.app.presentation"
KINDS = {
    "Recording": "of_recording",
    "Estimate": "of_estimate",
    "MassProperties": "of_mass_properties",
    "Testbed": "of_testbed",
    "Identification": "of_identification",
    "AssessedPlatform": "of_assessment",
    "Observation": "of_observation",
    "Balancing": "of_balancing",
    "Planning": "of_planning",
    "Sizing": "of_sizing",
    "Compared": "of_comparison",
    "Catalogue": "of_catalogue",
}


class Kind(Protocol):
    """Six views of a record; none of them computes a number."""

    def lines(self, record: Any, /) -> Iterable[str]:
        """Return a few lines: what it is, and the numbers that count, in the bench's units."""
        ...

    def blocks(self, record: Any, /) -> Blocks:
        """Return tables and sentences, in the bench's units."""
        ...

    def document(self, record: Any, /) -> dict[str, Any]:
        """Return the document of the command, SI."""
        ...

    def table(self, record: Any, /) -> Table:
        """Return rows and columns, SI."""
        ...

    def arrays(self, record: Any, /) -> Arrays:
        """Return named arrays with their dimensions, SI."""
        ...

    def figure(self, record: Any, /) -> "Figure | None":
        """Return a figure in the bench's units; None where there is nothing to draw."""
        ...


def kind_of(record: Shown) -> Kind:
    """Return what shows a record."""
    module: Any = import_module(f"{HERE}.{KINDS[type(record).__name__]}")
    return module


def text(record: Shown) -> str:
    """Return a few lines."""
    return "\n".join(kind_of(record).lines(record))


def html(record: Shown) -> str:
    """Return the record's blocks as HTML."""
    from equipoise.app.report.html import fragment

    return fragment(kind_of(record).blocks(record))


def document(record: Shown) -> dict[str, Any]:
    """Return the record's document; None stands for what is not finite."""
    from equipoise.app.text.json_document import finite

    return finite(kind_of(record).document(record))


def frame(record: Shown) -> Any:
    """Return a pandas DataFrame. Raises InputError where pandas is missing."""
    return to_frame(kind_of(record).table(record))


def dataset(record: Shown) -> Any:
    """Return an xarray Dataset. Raises InputError where xarray is missing."""
    return to_dataset(kind_of(record).arrays(record))


def figure(record: Shown) -> Any:
    """Return a matplotlib Figure. Raises InputError where there is nothing to draw."""
    drawn = kind_of(record).figure(record)
    if drawn is None:
        found = "nothing that a figure shows"
        raise InputError(f"plot of {type(record).__name__}", found, "a record with rows to draw")
    return drawn
