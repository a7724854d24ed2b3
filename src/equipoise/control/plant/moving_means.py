"""The means by which a loop is judged, in numbers alone: a micro-controller runs the same.

    m += f (x - m)      tilt, rate and shift
    M += f (m - M)      the mean shift

The means stand in one array of ten: tilt (2), rate (2), shift (3), mean of the mean shift (3).
(``settling`` says what they are for.)
"""

from typing import NamedTuple

from equipoise.control.plant.tilt_axes import Pair
from equipoise.model.arrays import Floats, Triple


class Bounds(NamedTuple):
    """The bounds within which a loop counts as quiet."""

    tilt: float  # rad
    rate: float  # rad/s
    shift: float  # m
    memory: float  # s, T of the means, and for how long all must stay within the bounds


def begin_means(means: Floats, tilt: Pair, rate: Pair, shift: Triple) -> None:
    """Write the means after the first sample."""
    for k in range(2):
        means[k], means[2 + k] = tilt[k], rate[k]
    for k in range(3):
        means[4 + k] = means[7 + k] = shift[k]


def follow_means(means: Floats, share: float, tilt: Pair, rate: Pair, shift: Triple) -> None:
    """Write the means after another sample, of which they take ``share``."""
    for k in range(3):
        means[7 + k] += share * (means[4 + k] - means[7 + k])
        means[4 + k] += share * (shift[k] - means[4 + k])
    for k in range(2):
        means[k] += share * (tilt[k] - means[k])
        means[2 + k] += share * (rate[k] - means[2 + k])


def is_still(means: Floats, tilt: Pair, rate: Pair, bounds: Bounds, level: bool) -> bool:
    """Say whether all is within the bounds: the means, or unless ``level`` what is off them."""
    off, turning, wandering = 0.0, 0.0, 0.0
    for k in range(2):
        a = means[k] if level else tilt[k] - means[k]
        b = means[2 + k] if level else rate[k] - means[2 + k]
        off, turning = off + a * a, turning + b * b
    for k in range(3):
        c = means[4 + k] - means[7 + k]
        wandering += c * c
    return (
        off**0.5 <= bounds.tilt and turning**0.5 <= bounds.rate and wandering**0.5 <= bounds.shift
    )


def at_depth(bounds: Bounds, before: float, now: float) -> Bounds:
    """Return the bounds for the same offset at another depth (m).

    An offset tilts a platform that hangs at half the depth twice as far.
    """
    share = before / now
    return Bounds(bounds.tilt * share, bounds.rate * share**0.5, bounds.shift, bounds.memory)
