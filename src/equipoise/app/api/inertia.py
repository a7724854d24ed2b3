"""Inertia: mass properties from a list of parts and from swings about known axes."""

from dataclasses import replace
from pathlib import Path

from equipoise.app.api.files import read_recording
from equipoise.estimation.mass_budget.budget import mass_budget
from equipoise.io.documents.parts_file import read_parts
from equipoise.model.mass_budget import MassBudget, PartsList
from equipoise.procedure.identification.timed_swing import timed


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
        For a file that cannot be read, a recording in which nothing swings about its axis, and a
        swing by gravity about the centre of mass.
    """
    return mass_budget(_timed(parts if isinstance(parts, PartsList) else read_parts(parts)))


def _timed(stated: PartsList) -> PartsList:
    """Return the parts with swings whose periods are those of their recordings."""
    beside = Path(stated.source).parent
    swings = tuple(
        timed(swing, read_recording(beside / swing.recording)) if swing.recording else swing
        for swing in stated.oscillations
    )
    return replace(stated, oscillations=swings)
