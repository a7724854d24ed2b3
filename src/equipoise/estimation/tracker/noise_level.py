"""The level of a sensor's noise, learnt from how surprising its rows are, compiled.

    d2 = z^T S^-1 z,  E d2 = 3 where S is right
    ln k += gain ( min(d2 / 3, 3) - 0.979 ),   R = k sd^2,   gain = max( 2 / (40 + n), 1/100 )

A row counts while noise is most of what is expected of it; an odd row counts no more than one at
three times the mean (0.979 is the mean of the bounded term), so contacts and slips raise the level
by a few hundredths at most. With the least gain k wanders by some 6 % (one sd), R^1/2 by 3 %, and a
change is followed within some hundred rows.
"""

from equipoise.maths.kernels.compiled import part
from equipoise.model.arrays import Floats

BOUND, MEAN = 3.0, 0.9788085  # mean of min(chi2_3 / 3, 3)
EARLY, FIRST = 2.0, 40.0
LEAST_GAIN = 0.01
SETTLED = 50.0  # rows, chosen: k is then known to 15 %
LOWEST, HIGHEST = 1 / 16, 100.0  # of the variance: the sd stated is off by 4 and by 10 at most
MOSTLY = 0.5  # of the expected square: noise


@part
def learn_noise(level: Floats, surprise: float, share: float) -> None:
    """Update (k, rows counted) of one sensor from a row's d2; noise is a share of S."""
    if share < MOSTLY:
        return
    gain = max(EARLY / (FIRST + level[1]), LEAST_GAIN)
    grown = level[0] * (1.0 + gain * (min(surprise / 3.0, BOUND) - MEAN))
    level[0] = min(max(grown, LOWEST), HIGHEST)
    level[1] += 1.0


@part
def settled(levels: Floats) -> bool:
    """Say whether the noise is known of every sensor that sends rows, and one does."""
    received = levels[0, 1] + levels[1, 1]
    for k in range(2):
        if 0.0 < levels[k, 1] < SETTLED:
            return False
    return received > 0.0
