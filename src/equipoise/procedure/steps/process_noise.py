"""Process noise of a fit, as a testbed states it: the play of air and bearing, and a walk of com.

The play is an Ornstein-Uhlenbeck process with one sd s and time constant T about each body axis. It
has the density

    S(f) = 2 T s^2 / (1 + (2 pi f T)^2)  <=  2 T s^2

so that an estimate which takes it for white noise of the latter errs by no more than it says. White
noise jumps the rate by sqrt(2 T dt) s / J in a time dt. The centre of mass walks by as much as is
stated for a minute, each axis by itself.

Of the centre of mass across gravity the play leaves, after a time t near level, an sd of
sqrt(2 T / t) s / (m g). While t < T that is too wide, up to twice.
"""

import numpy as np

from equipoise.estimation.output_error.segment_jumps import Jump, inside, walk
from equipoise.model.estimate import COM, RATE
from equipoise.model.testbed import AIR_TIME, Testbed
from equipoise.model.units import MINUTE

SPACING = 2.0  # s, chosen: between jumps, a 15th of the time constant


def process_noise(testbed: Testbed, span: tuple[float, float]) -> tuple[Jump, ...]:
    """Return its jumps within a record that begins and ends at these times (s)."""
    start, end = span
    moments = np.diag(testbed.body.inertia_P)
    rate = testbed.air_torque * np.sqrt(2 * AIR_TIME * SPACING) / moments
    com = np.full(3, testbed.com_walk * np.sqrt(SPACING / MINUTE))
    times = np.arange(start + SPACING, end - SPACING / 2, SPACING)
    return inside(walk(times, (*RATE, *COM), np.concatenate([rate, com])), start, end)
