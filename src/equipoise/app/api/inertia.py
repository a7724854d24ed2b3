"""Inertia: mass properties from a list of parts and from swings about known axes."""

from pathlib import Path

from equipoise.estimation.mass_budget.budget import mass_budget
from equipoise.io.documents.parts_file import read_parts
from equipoise.model.mass_budget import MassBudget, PartsList


def inertia(parts: str | Path | PartsList) -> MassBudget:
    """Sum parts, and combine them with swings about known axes, if there are any.

    Whether the numbers are usable is the ``outcome`` of its ``estimate``.

    Parameters
    ----------
    parts
        Parts file, or what was read of one.

    Raises
    ------
    InputError
        For a file that cannot be read, and a swing by gravity about the centre of mass.
    """
    return mass_budget(parts if isinstance(parts, PartsList) else read_parts(parts))
