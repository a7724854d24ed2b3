"""Mass properties from parts and swings."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

from equipoise.app.presentation import of_estimate, of_mass_properties
from equipoise.model.mass_budget import MassBudget

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def lines(found: MassBudget) -> Iterator[str]:
    """Yield what was summed, how it ended, and the parameters."""
    yield f"Mass properties of {found.stated.name}: {found.estimate.outcome.sentence}"
    yield from of_estimate.parameter_lines(found.estimate)


def figure(found: MassBudget) -> "Figure | None":
    """Return the ellipsoid of even density with this inertia, and its centre of mass."""
    return of_mass_properties.figure(found.body)
