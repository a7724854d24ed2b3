"""What share of all runs has a property that k of n runs had (Clopper and Pearson 1934).

    low   = Beta^-1(0.025; k, n - k + 1)       0 for k = 0
    high  = Beta^-1(0.975; k + 1, n - k)       1 for k = n

The interval is never too narrow: for no true share is ``high`` below it more often than in 2.5 %.
"""

import scipy

from equipoise.maths.gaussian_length import SURE
from equipoise.model.criterion import Interval


def bounded_share(having: int, runs: int) -> Interval:
    """Return the 95 % bounds of the share."""
    low = (
        float(scipy.special.betaincinv(having, runs - having + 1, 1 - SURE)) if having > 0 else 0.0
    )
    high = (
        float(scipy.special.betaincinv(having + 1, runs - having, SURE)) if having < runs else 1.0
    )
    return Interval(low, high)
