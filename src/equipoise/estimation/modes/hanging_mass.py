"""What a mass that hangs does to an estimate: gravity acts at its pivot, whatever its own height.

A pendulum of mass m and length l below its pivot, or a liquid with a free surface, follows the
vertical. For swings to one side it acts as elastic sag of c = m l / M, and as a com that is higher
by c. The two differ in second order of the tilt only. The linear sag of a fit,

    r = r0 + C n,      c = greatest - least eigenvalue of C,

has no meaning to that order where the part hangs. Where sag alone explains a record, a mass that
hangs is fitted beside it (``hanging_choice``). A sag that remains, and that nobody declared, is
reported with c: by so much com along the vertical may be off if the part hangs, and other numbers
by some sd where the sensors are good. A mode beside such a sag says that a mass swings: then no
interval is to be trusted.

Cannot see a hanging mass that moves alike to all sides: gravity acts at its pivot, and com is as it
acts. Nor one whose sag the record does not show.
"""

from dataclasses import replace

import numpy as np

from equipoise.estimation.events.record_model import RecordModel
from equipoise.maths.linalg import unpack_symmetric
from equipoise.model.arrays import Floats
from equipoise.model.estimate import Estimate
from equipoise.model.outcome import Outcome
from equipoise.model.reasons.mode_reasons import ModeReason
from equipoise.model.reasons.reason import Reason
from equipoise.model.torque_terms import GROUPS

SAG = GROUPS["sag"]


def height_of(sag: Floats) -> float:
    """Return how far (m) the pivot of a hanging mass raises com, by the five numbers of a sag."""
    xx, yy, xy, xz, yz = sag
    sizes = np.linalg.eigvalsh(unpack_symmetric(np.array([xx, yy, -xx - yy, xy, xz, yz])))
    return float(sizes[-1] - sizes[0])


def with_hanging(concluded: Estimate, model: RecordModel, declared: tuple[str, ...]) -> Estimate:
    """Return an estimate that states that what sags may hang; ``declared`` terms bend.

    The same where the record shows no sag that is not declared.
    """
    found = set(SAG) & set(model.params.terms)
    if not concluded.outcome.usable or not found or found <= set(declared):
        return concluded
    values = {p.name: p.value for p in concluded.parameters}
    height = height_of(np.array([values.get(term, 0.0) for term in SAG]))
    reasons = [*concluded.outcome.reasons]
    reasons.append(Reason(ModeReason.SAG_MAY_HANG, (), {"height": height}))
    if model.modes:
        reasons.append(Reason(ModeReason.MASS_SWINGS))
    return replace(concluded, outcome=Outcome(tuple(reasons)))
