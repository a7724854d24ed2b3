"""What turns with the platform: lines in the spectrum of its tilt that are no swings.

    s(t) = ... + sum_k ( a_k cos k psi(t) + b_k sin k psi(t) ),    k = 1, 2, 3

psi is the heading as recorded, so that a spin that changes is followed. A camera whose vertical
leans by d, laboratory axes, shows d turned into body axes beside the tilt: a line at the spin,
whatever the platform does. An error of the camera that goes with the heading has its harmonics.
What is fixed in the body is the constant of roll and pitch. None of these depends on gravity, so
none is a swing, and a record of T seconds cannot separate a swing from a line nearer than 0.5/T.

Cannot see a line of a platform that makes less than half a turn: it is a trend.
"""

from dataclasses import dataclass

import numpy as np

from equipoise.maths.attitude import to_matrix
from equipoise.model.arrays import Floats, Series, Series1, Series4, Vector3

ORDERS = (1, 2, 3)  # as an error of the camera by heading has them (``sensor_terms.GROUPS``)
LEAST_TURN = 0.5  # turns in the record, chosen
SEPARATE = 0.5  # resolution widths, chosen: nearer sines of free size and phase are one


@dataclass(frozen=True, slots=True, eq=False)
class SpinLines:
    """The columns of what turns with the platform, and where they are in a spectrum."""

    columns: Series  # (n, 2 k), of size 1
    frequency: Floats  # (k,) Hz, by the mean spin

    @property
    def turns(self) -> bool:
        """Say whether the platform turns."""
        return len(self.frequency) > 0


def no_lines(rows: int) -> SpinLines:
    """Return those of a platform that does not turn."""
    return SpinLines(np.zeros((rows, 0)), np.zeros(0))


def heading(t: Series1, q: Series4, axis: Vector3, spin: float) -> Series1:
    """Return the angle (rad, (n,)) by which a horizontal body axis has turned about the vertical.

    ``spin`` (rad/s) says how many turns lie between two rows of a slow camera.
    """
    level = to_matrix(q) @ axis
    steady: Floats = spin * (t - t[0])
    return np.unwrap(np.arctan2(level[:, 1], level[:, 0]) - steady) + steady


def spin_lines(t: Series1, psi: Series1) -> SpinLines:
    """Return the lines of a heading (rad) at times t (s)."""
    turns = abs(float(psi[-1] - psi[0])) / (2 * np.pi)
    if turns < LEAST_TURN:
        return no_lines(len(t))
    columns = [wave(k * psi) for k in ORDERS for wave in (np.cos, np.sin)]
    return SpinLines(np.column_stack(columns), turns / float(t[-1] - t[0]) * np.array(ORDERS))


def is_separate(frequency: float, lines: SpinLines, duration: float) -> bool:
    """Say whether a record of ``duration`` (s) separates a frequency (Hz) from all lines."""
    return bool(np.all(np.abs(lines.frequency - frequency) * duration > SEPARATE))
