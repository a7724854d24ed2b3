"""What masses and sensors are good for: the budget of the torque that is left."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

from equipoise.app.presentation.tables import Table
from equipoise.planning.sizing.sizing import Sizing

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def lines(found: Sizing) -> Iterator[str]:
    """Yield the verdict and what limits the result."""
    yield f"Design of {found.case.testbed.name}: {found.verdict.sentence}"
    yield f"  {found.limit}"


def table(found: Sizing) -> Table:
    """Return a row a cause."""
    budget = found.budget.lines
    return {
        "cause": [line.name for line in budget],
        "torque_N_m": [line.torque for line in budget],
        "basis": [line.basis for line in budget],
    }


def figure(found: Sizing) -> "Figure | None":
    """Return the budget."""
    from equipoise.app.figures.design_catalogue import pictures_of

    return pictures_of(found)[1].figure
