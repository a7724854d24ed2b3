"""When the sliding masses moved, and how far."""

import numpy as np

from equipoise.model.arrays import Series1
from equipoise.model.finding import Finding
from equipoise.model.reasons.finding_reasons import FindingReason as Why
from equipoise.model.reasons.reason import one_reason
from equipoise.model.recording import Recording, runs

STILL = 1e-6  # m between rows; chosen: below any actuator's step, above an encoder's flicker
ABSOLUTE = ("momentum", "torque", "devices", "position")  # what shows the scale beside moves
NAMED = 12  # moves that are named one by one; chosen: two rounds of six masses


def move_findings(recording: Recording) -> list[Finding]:
    """Return each move in order of time."""
    masses = recording.masses
    absolute = (getattr(recording, channel) for channel in ABSOLUTE)
    scaled = any(rows is not None and np.any(rows.values) for rows in absolute)
    if masses is None or not len(masses):
        return [] if scaled else [Finding("content", one_reason(Why.NO_POSITIONS))]
    moves = [
        move
        for i, name in enumerate(recording.mass_names)
        for move in _moves(name, masses.t, masses.values[:, i])
    ]
    moves.sort(key=lambda move: move.span or (0.0, 0.0))
    if not moves:
        why = Why.MASSES_STAND if scaled else Why.NO_MASS_MOVED
        return [Finding("content", one_reason(why))]
    more = len(moves) - NAMED
    rest = [Finding("motion", one_reason(Why.MORE_MOVES, count=more))] if more > 0 else []
    return [*moves[:NAMED], *rest]


def _moves(name: str, t: Series1, x: Series1) -> list[Finding]:
    """Return the moves of one mass: runs of rows between which it changes."""
    found: list[Finding] = []
    for first, last in runs(np.abs(np.diff(x)) > STILL):
        span, way = ((float(of[first]), float(of[last + 1])) for of in (t, x))
        numbers = {"start": way[0], "end": way[1], "t_start": span[0], "t_end": span[1]}
        found.append(Finding("motion", one_reason(Why.MASS_MOVES, name, **numbers), span, name))
    return found
