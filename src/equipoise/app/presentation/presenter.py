"""The presenter that the package's root lends to records (``model.presentation``).

``KINDS`` is the only list of what shows which record; a module is loaded when it is needed.
"""

from collections.abc import Callable
from importlib import import_module
from typing import Any

from equipoise.app.presentation.tables import Arrays, Table, of_table, to_dataset, to_frame
from equipoise.model.errors import InputError
from equipoise.model.presentation import Shown

HERE, VIEWS = "equipoise.app.presentation", "equipoise.app.views"
# The module here that shows a record, and the module of the command that prints it. A module here
# has ``lines``; ``table`` unless it is the estimate's; ``arrays`` unless they are the table's
# columns; ``figure`` if there is one; ``blocks`` and ``document`` unless the command's are meant.
# None computes a number.
KINDS = {
    "Recording": ("of_recording", ""),
    "Estimate": ("of_estimate", ""),
    "MassProperties": ("of_mass_properties", ""),
    "Testbed": ("of_testbed", ""),
    "Identification": ("of_identification", "identify_views"),
    "JointIdentification": ("of_joint_identification", "identify_runs_views"),
    "AssessedPlatform": ("of_assessment", "assess_views"),
    "Observation": ("of_observation", "observe_views"),
    "TorqueByCause": ("of_torque_by_cause", "torque_views"),
    "Balancing": ("of_balancing", "balancing.balance_views"),
    "Keeping": ("of_keeping", "balancing.keep_views"),
    "Planning": ("of_planning", "plan_views"),
    "Sizing": ("of_sizing", "design_views"),
    "Compared": ("of_comparison", "study.comparison_report"),
    "MassBudget": ("of_mass_budget", "inertia_views"),
    "Catalogue": ("of_catalogue", ""),
}
PRINTED = ("blocks", "document")


def view_of(record: Shown, name: str) -> Callable[[Any], Any] | None:
    """Return what gives a view of a record, by the view's name; None where there is none."""
    own, command = KINDS[type(record).__name__]
    module = import_module(f"{HERE}.{own}")
    if name in PRINTED and not hasattr(module, name):
        module = import_module(f"{VIEWS}.{command}")
    return getattr(module, name, None)


def viewed(record: Shown, name: str) -> Any:
    """Return a view that every record has."""
    view = view_of(record, name)
    assert view is not None
    return view(record)


def text(record: Shown) -> str:
    """Return a few lines: what it is, and the numbers that count, in the bench's units."""
    return "\n".join(viewed(record, "lines"))


def html(record: Shown) -> str:
    """Return tables and sentences as HTML with its own style, in the bench's units."""
    from equipoise.app.report.html import notebook_cell

    return notebook_cell(viewed(record, "blocks"))


def document(record: Shown) -> dict[str, Any]:
    """Return the document of the command, SI; None stands for what is not finite."""
    from equipoise.app.text.json_document import finite

    return finite(viewed(record, "document"))


def tabled(record: Any) -> Any:
    """Return the record that a table is of: itself, or the estimate of one without its own."""
    return record.estimate if view_of(record, "table") is None else record


def table(record: Shown) -> Table:
    """Return columns, SI."""
    return viewed(tabled(record), "table")


def arrays(record: Shown) -> Arrays:
    """Return named arrays with their dimensions, SI: a table's columns unless there are others."""
    view = view_of(tabled(record), "arrays")
    return of_table(table(record)) if view is None else view(tabled(record))


def frame(record: Shown) -> Any:
    """Return a pandas DataFrame. Raises InputError where pandas is missing."""
    return to_frame(table(record))


def dataset(record: Shown) -> Any:
    """Return an xarray Dataset. Raises InputError where xarray is missing."""
    return to_dataset(arrays(record))


def figure(record: Shown) -> Any:
    """Return a matplotlib Figure. Raises InputError where there is nothing to draw."""
    view = view_of(record, "figure")
    drawn = None if view is None else view(record)
    if drawn is None:
        found = "no data that a figure could show"
        raise InputError(f"plot of {type(record).__name__}", found, "a record with rows")
    return drawn
