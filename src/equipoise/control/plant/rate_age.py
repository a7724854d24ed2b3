"""How much older than the attitude a sample's rate is.

A rate is the mean of the gyro's rows since the last sample, n = max(f T, 1) of them, the last one
as old as the attitude: T (1 - 1/n) / 2 older in the mean. A loop that multiplies it by a gain K,
while the rate turns with the speed W, makes K T (1 - 1/n) / 2 of the inertia out of that.
"""

from equipoise.model.testbed import Testbed


def rate_age(testbed: Testbed, period: float) -> float:
    """Return the age (s) of the rate of samples that are ``period`` seconds from each other."""
    rows = 1.0 if testbed.gyro is None else max(testbed.gyro.rate * period, 1.0)
    return period * (1 - 1 / rows) / 2
