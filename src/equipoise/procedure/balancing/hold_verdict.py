"""The verdict on a hold: within tolerance at every measurement, by the posterior at that time.

Each measurement is a claim of its own, on all axes with their covariance. The hold passes if each
of them does, so a platform that was outside at one of them passes in at most 2.5 % of holds.

Cannot see what happens between measurements.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from equipoise.model.arrays import Matrix3, Series3, Vector3
from equipoise.model.criterion import HELD, jointly
from equipoise.model.reasons.reason import axes_of
from equipoise.model.verdict import Verdict
from equipoise.procedure.steps.gaussian_box import bounded_use
from equipoise.procedure.steps.verify import Aim, axes_in_doubt


class Measured(NamedTuple):
    """The posterior of the centre of mass after a measurement, as the masses stand."""

    com: Vector3  # m
    covariance: Matrix3  # m^2

    @property
    def sd(self) -> Vector3:
        """Standard deviations, m."""
        return np.sqrt(np.diag(self.covariance))


def verdict_on(course: Sequence[Measured], aim: Aim, duration: float) -> Verdict:
    """Return the verdict on all measurements of a hold that lasted for ``duration`` (s)."""
    off, sd = (np.array([getattr(each, key) for each in course]) for key in ("com", "sd"))
    off -= aim.target
    uses = [bounded_use(o, each.covariance, aim.tolerance)
            for o, each in zip(off, course, strict=True)]  # fmt: skip
    use = jointly(uses)
    failing = use.low > 1
    found = [
        axes_in_doubt(o, s, aim.tolerance, each)
        for o, s, each in zip(off, sd, uses, strict=True)
        if (each.low if failing else each.high) > 1
    ]
    names = tuple(axis for axis in "xyz" if any(axis in names for names in found))
    numbers = {"duration": duration, **farthest(off, sd)}
    return Verdict((HELD.answer(use, 1.0, numbers, names),), course[-1].com, course[-1].sd)


def farthest(off: Series3, sd: Series3) -> dict[str, float]:
    """Return the greatest offset along each axis and its sd then (m), as a reason's numbers."""
    when = np.abs(off).argmax(axis=0)
    axes = np.arange(3)
    return axes_of("off", np.abs(off)[when, axes]) | axes_of("sd", sd[when, axes])
