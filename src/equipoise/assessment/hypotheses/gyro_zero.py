"""What a gyro reports of a platform that stands still, by the attitude beside it.

    sum of turns_a(t) = M_a . integral of the gyro - b_a t + c_a        each axis a of the body

M takes in errors of scale and of axes, which a steady turn would else pass on to the zero. What is
left is the noise of attitudes; that it goes on from span to span widens the sd.
"""

from dataclasses import dataclass

import numpy as np

from equipoise.assessment.hypotheses.gyros import GyroGuess, Spans
from equipoise.maths.attitude import difference
from equipoise.model.arrays import Floats, Series1, Series3, Series4, Vector3

CLEAR = 5.0  # sd that a zero must have to be stated (chosen)
UNKNOWNS = 5  # of each axis: three of M, the zero, and where the sum begins


@dataclass(frozen=True, slots=True, eq=False)
class GyroZero:
    """A zero, and how well it is known."""

    rate: Vector3  # rad/s, body axes of the attitude
    sd: Vector3  # rad/s

    @property
    def is_clear(self) -> bool:
        """Say whether some axis has a zero beyond doubt."""
        return bool((np.abs(self.rate) > CLEAR * self.sd).any())


def zero_of(spans: Spans, q: Series4, gyro: GyroGuess) -> GyroZero | None:
    """Return the zero of a gyro; None where there are too few spans."""
    if len(spans.starts) < 2 * UNKNOWNS:
        return None
    steps = difference(q[spans.starts + spans.lag], q[spans.starts])
    integrals = np.cumsum(_rates(spans, gyro) * spans.duration[:, None], axis=0)
    t = np.cumsum(spans.duration)
    knowns = np.column_stack([-t, np.ones_like(t), integrals])
    answer, *_ = np.linalg.lstsq(knowns, np.cumsum(steps, axis=0), rcond=None)
    left = np.cumsum(steps, axis=0) - knowns @ answer
    # M takes the gyro's integral into turns; what it reports at rest is before M.
    back: Floats = np.linalg.pinv(answer[2:].T).astype(np.float64)
    variance = np.linalg.pinv(knowns.T @ knowns)[0, 0] * _variances(left)
    return GyroZero(back @ answer[0], np.sqrt(np.square(back) @ variance))


def _rates(spans: Spans, gyro: GyroGuess) -> Series3:
    """Return a gyro's means over spans, rad/s, axes of the body."""
    named = [spans.means[name] for name in gyro.columns]
    return np.stack(named, axis=1) * np.array(gyro.signs) * gyro.factor


def _variances(left: Series3) -> Vector3:
    """Return what a row's square is worth of each axis, widened where rows are alike."""
    alike: Series1 = np.sum(left[1:] * left[:-1], axis=0) / np.maximum(
        np.sum(left**2, axis=0), np.finfo(float).tiny
    )
    wider = (1 + np.clip(alike, 0.0, 0.99)) / (1 - np.clip(alike, 0.0, 0.99))
    return np.sum(left**2, axis=0) / (len(left) - UNKNOWNS) * wider
