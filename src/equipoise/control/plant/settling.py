"""Whether masses and loop have come to rest.

Masses stand from the first sample on in which their shift no longer changes (``standing``). A loop
is judged by exponential means, with f = h / T for a step h:

    m += f (x - m),     mean of tilt, of rate and of the shift s that the masses report
    M += f (m - M),     mean of the mean shift

It is quiet while the mean tilt, the mean rate and m - M of the shift all stay within bounds, from
``since`` on. The mean shift balances the platform, free of the noise that the loop passes on to the
masses. Tilt times depth is the remaining offset: a bound on it is the same on every platform.
"""

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from equipoise.control.law import Sample
from equipoise.control.plant.moving_means import Bounds, follow_means, is_still
from equipoise.control.plant.pendulum import Hanging, pair, rate_of, tilt_of, triple
from equipoise.model.arrays import Floats, Vector3

PERIOD = 0.25  # s, chosen: the step h, a fiftieth of a swing
STANDS = 1e-10  # m, chosen: masses that shift the centre of mass by less stand
MEMORY = 0.5  # swings, chosen: T, and the time for which all must stay within the bounds
LEVEL = 1e-7  # m, chosen: an offset that counts as none, 1.4e-5 N m for 14 kg


class Stand(NamedTuple):
    """The last reported shift by the masses, and since when they stand."""

    shift: Vector3 | None = None  # m; None: not reported yet
    since: float = 0.0  # s


UNREPORTED = Stand()


def standing(before: Stand, sample: Sample) -> Stand:
    """Return how the masses stand after a sample."""
    still = before.shift is not None and np.linalg.norm(sample.shift - before.shift) <= STANDS
    return Stand(sample.shift, before.since if still else sample.t)


@dataclass(frozen=True, slots=True, eq=False)
class Rest:
    """The present means."""

    tilt: Floats = field(default_factory=lambda: np.full(2, np.inf))  # rad
    rate: Floats = field(default_factory=lambda: np.full(2, np.inf))  # rad/s
    shift: Vector3 = field(default_factory=lambda: np.full(3, np.inf))  # m
    before: Vector3 = field(default_factory=lambda: np.full(3, np.inf))  # m, M
    since: float = np.inf  # s


def bounds(plant: Hanging, offset: float) -> Bounds:
    """Return the bounds for an offset (m) that counts as none."""
    tilt, w = offset / plant.depth, float(plant.frequency.min())
    return Bounds(tilt, tilt * w, offset, MEMORY * 2 * np.pi / w)


def finest_bounds(plant: Hanging) -> Bounds:
    """Return the bounds for LEVEL, or for two steps of the masses where these are longer."""
    return bounds(plant, max(LEVEL, 2 * plant.step))


def settle(rest: Rest, sample: Sample, plant: Hanging, bounds: Bounds, *, level: bool) -> Rest:
    """Return the means after another step; ``level``: the platform should come to rest level.

    Otherwise any tilt is accepted with its rate: a tilted platform that turns about the vertical
    has a steady rate in body axes. Only deviations from the means count then.
    """
    tilt, rate = tilt_of(plant, sample), rate_of(plant, sample)
    if not np.isfinite(rest.tilt[0]):
        return Rest(tilt, rate, sample.shift, sample.shift)
    means = np.concatenate([rest.tilt, rest.rate, rest.shift, rest.before])
    now = (pair(tilt), pair(rate), triple(sample.shift))
    follow_means(means, PERIOD / bounds.memory, *now)
    still = is_still(means, now[0], now[1], bounds, level)
    since = min(rest.since, sample.t) if still else np.inf
    return Rest(means[:2], means[2:4], means[4:7], means[7:], since)


def is_quiet(rest: Rest, t: float, bounds: Bounds) -> bool:
    """Say whether all has been within the bounds for long enough."""
    return t - rest.since >= bounds.memory
