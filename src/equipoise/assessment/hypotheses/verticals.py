"""What is vertical in the laboratory of a table, by an accelerometer beside the attitude.

    u = mean of R a / |a|            a: what stands against gravity, axes of the body

An accelerometer on a platform near its bearing feels hardly more than gravity, so R a points one
way in the laboratory, whatever the platform does. Its axes are taken to be those of the gyro.
"""

from dataclasses import dataclass
from math import radians

import numpy as np

from equipoise.assessment.hypotheses.gyros import GyroGuess
from equipoise.assessment.hypotheses.number_table import NumberTable, varies, words_of
from equipoise.maths.attitude import to_matrix
from equipoise.model.arrays import Series3, Series4, Vector3

EVEN = 0.1  # of a length, by which lengths may scatter: more is no gravity (chosen)
TOGETHER = 0.9  # length of the mean direction, below which the axes are other ones (chosen)
TILTED = radians(15.0)  # chosen: axes of a camera and a sensor are aligned by eye at least
TIMES = 3.0  # the scatter, from which a tilt is beyond doubt (chosen)


@dataclass(frozen=True, slots=True)
class Vertical:
    """How an axis of the laboratory stands to the vertical."""

    columns: tuple[str, ...]  # of the accelerometer
    tilt: float  # rad
    scatter: float  # rad, the median

    @property
    def is_off(self) -> bool:
        """Say whether the axis is no vertical beyond doubt."""
        return self.tilt > max(TILTED, TIMES * self.scatter)


def vertical_of(
    table: NumberTable, q: Series4, gyro: GyroGuess | None, lab_up: str
) -> Vertical | None:
    """Return how ``lab_up`` stands to the vertical, by columns named as an accelerometer's.

    None where there are none, or where they show no gravity in the axes of the body.
    """
    columns = accelerometer_columns(table)
    if columns is None:
        return None
    named = np.stack([table.column(name) for name in columns], axis=1)
    order, signs = ((0, 1, 2), (1, 1, 1)) if gyro is None else (gyro.order, gyro.signs)
    pull = named[:, list(order)] * np.array(signs)
    full = np.isfinite(pull).all(axis=1) & np.isfinite(q).all(axis=1)
    length = np.linalg.norm(pull[full], axis=1)
    if full.sum() < 3 or length.min() <= 0 or np.std(length) > EVEN * np.mean(length):
        return None
    towards = np.einsum("nij,nj->ni", to_matrix(q[full]), pull[full] / length[:, None])
    return _stands(columns, towards, lab_up)


def _stands(columns: tuple[str, ...], towards: Series3, lab_up: str) -> Vertical | None:
    mean: Vector3 = towards.mean(axis=0)
    if np.linalg.norm(mean) < TOGETHER:
        return None
    mean = mean / np.linalg.norm(mean)
    scatter = float(np.median(np.arccos(np.clip(towards @ mean, -1.0, 1.0))))
    along = abs(float(mean["xyz".index(lab_up[-1])]))  # some sensors give gravity, others the stand
    return Vertical(columns, float(np.arccos(min(1.0, along))), scatter)


def accelerometer_columns(table: NumberTable) -> tuple[str, str, str] | None:
    """Return the columns named as x, y, z of one accelerometer; None unless there is one."""
    named = [name for name in table.names if _is_acceleration(name)]
    by_axis = [[name for name in named if _axis(name) == axis] for axis in "xyz"]
    if any(len(names) != 1 for names in by_axis):
        return None
    x, y, z = (names[0] for names in by_axis)
    return (x, y, z) if any(varies(table.column(name)) for name in (x, y, z)) else None


def _is_acceleration(name: str) -> bool:
    return any(w.startswith("acc") or w in ("ax", "ay", "az") for w in words_of(name))


def _axis(name: str) -> str:
    """Return the axis that a name says, '' if it says none."""
    ends = {w[-1] for w in words_of(name) if w in ("x", "y", "z", "ax", "ay", "az")}
    ends |= {w[-1] for w in words_of(name) if w.startswith("acc") and w[-1] in "xyz"}
    return ends.pop() if len(ends) == 1 else ""
