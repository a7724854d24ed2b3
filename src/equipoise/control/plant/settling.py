"""Has a loop come to rest? Means over a while, and how long they have been small.

With f = h / T of a step h,

    m += f (x - m),     mean of tilt, of rate and of the shift s that the masses report
    M += f (m - M),     mean of the mean shift

The loop is quiet where the mean tilt, the mean rate and m - M of the shift all stay within bounds;
``since`` is when that began. The mean shift is what balances the platform; noise that the loop
passes on to the masses is not in it.
Tilt times depth is the offset that is left: a bound on it is the same on every platform.
"""

from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np

from equipoise.control.plant.pendulum import Hanging
from equipoise.model.arrays import Floats, Vector3


class Bounds(NamedTuple):
    """What is quiet."""

    tilt: float  # rad
    rate: float  # rad/s
    shift: float  # m
    memory: float  # s, T of the means
    hold: float  # s, for which all must stay within the bounds


@dataclass(frozen=True, slots=True, eq=False)
class Rest:
    """The means so far."""

    tilt: Floats = field(default_factory=lambda: np.full(2, np.inf))  # rad
    rate: Floats = field(default_factory=lambda: np.full(2, np.inf))  # rad/s
    shift: Vector3 = field(default_factory=lambda: np.full(3, np.inf))  # m
    before: Vector3 = field(default_factory=lambda: np.full(3, np.inf))  # m, M
    since: float = np.inf  # s


class Sums(NamedTuple):
    """What goes into the means."""

    t: float  # s
    tilt: Floats
    rate: Floats
    shift: Vector3


def bounds(plant: Hanging, offset: float, swings: float) -> Bounds:
    """Return what is quiet where an offset (m) counts as none."""
    tilt, w = offset / plant.depth, float(plant.frequency.min())
    return Bounds(tilt, tilt * w, offset, swings * 2 * np.pi / w, swings * 2 * np.pi / w)


def at_depth(bounds: Bounds, before: float, now: float) -> Bounds:
    """Return bounds for a depth (m) for a platform that now hangs at another: the offset is alike.

    The same offset tilts a platform that hangs at half the depth twice as far.
    """
    share = before / now
    return bounds._replace(tilt=bounds.tilt * share, rate=bounds.rate * share**0.5)


def settle(rest: Rest, now: Sums, step: float, bounds: Bounds, aim: Floats | None = None) -> Rest:
    """Return the means after another step (s); ``aim`` is the tilt (rad) sought.

    Without one, any tilt will do, and any rate that goes with it: a tilted platform that turns
    about the vertical does so at a steady rate in body axes. What swings about the means counts.
    """
    if not np.isfinite(rest.tilt[0]):
        return Rest(now.tilt, now.rate, now.shift, now.shift)
    share = step / bounds.memory
    mean = replace(
        rest,
        tilt=rest.tilt + share * (now.tilt - rest.tilt),
        rate=rest.rate + share * (now.rate - rest.rate),
        shift=rest.shift + share * (now.shift - rest.shift),
        before=rest.before + share * (rest.shift - rest.before),
    )
    if aim is None:
        off, turning = now.tilt - mean.tilt, now.rate - mean.rate
    else:
        off, turning = mean.tilt - aim, mean.rate
    still = (
        float(np.linalg.norm(off)) <= bounds.tilt
        and float(np.linalg.norm(turning)) <= bounds.rate
        and float(np.linalg.norm(mean.shift - mean.before)) <= bounds.shift
    )
    return replace(mean, since=min(rest.since, now.t) if still else np.inf)


def is_quiet(rest: Rest, t: float, bounds: Bounds) -> bool:
    """Say whether all has been within the bounds for long enough."""
    return t - rest.since >= bounds.hold
