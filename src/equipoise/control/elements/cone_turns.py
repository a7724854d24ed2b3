"""What is left of an offset, from how far masses moved in the last turn of a cone.

An offset that fades by e^-p in a turn moves the mean shift of a turn, s_k, by what it loses:

    |s_k - s_(k-1)| = mean_k (e^p - 1),      mean_k = rest_k (e^p - 1) / p

rest_k is what is left at the end of the turn, and p = d / sin^2 A times int (E - n n^T) dt over it,
with the least eigenvalue of the integral, in which rows without the requested torque do not count.
A mean over a turn is free of what goes round with the cone. Noise of rows and whole motor steps
move masses too: the rest is then said to be greater than it is.

Cannot see what stands still: the effect of a wrong inertia.
"""

from typing import NamedTuple

import numpy as np

from equipoise.model.arrays import Floats, Matrix3, Vector3


class Turns(NamedTuple):
    """The turns so far."""

    rests: tuple[float, float]  # m, after the last two turns; at first the prior's sd
    observed: Matrix3  # s, the integral since the start
    whole: int = 0  # turns
    rows: int = 0  # of this turn
    total: Floats = np.zeros(3)  # m, sum of their shifts
    mean: Vector3 | None = None  # m, of the turn before
    swept: float = 0.0  # s, the least eigenvalue at its end

    @property
    def rest(self) -> float:
        """Return what is left, m: the greater of what the last two turns show."""
        return max(self.rests)


def first_turn(unknown: float) -> Turns:
    """Return the beginning, with an offset of which ``unknown`` (m) is one sd."""
    return Turns((unknown, unknown), np.zeros((3, 3)))


def swept(turns: Turns, down: Vector3, duration: float) -> Turns:
    """Return the turns after so many seconds with gravity along ``down`` and the right torque."""
    return turns._replace(observed=turns.observed + duration * (np.eye(3) - np.outer(down, down)))


def counted(turns: Turns, turn: int, shift: Vector3, fading: float) -> Turns:
    """Return the turns after a row of one of them, from 0; ``fading`` (1/s) is d / sin^2 A."""
    if turn == turns.whole:
        return turns._replace(rows=turns.rows + 1, total=turns.total + shift)
    mean = turns.total / max(turns.rows, 1)
    least = float(np.linalg.eigvalsh(turns.observed)[0])
    fresh = turns._replace(whole=turn, rows=1, total=shift, mean=mean, swept=least)
    if turns.mean is None:
        return fresh
    moved, p = float(np.linalg.norm(mean - turns.mean)), fading * (least - turns.swept)
    rest = moved * p / float(np.expm1(p)) ** 2 if p > 0 else np.inf
    return fresh._replace(rests=(turns.rests[1], rest))
