"""How great a surprise must be to count as an event: one false alarm in ``FALSE_ALARM`` seconds.

Were the tests at all cuts independent, as many would by chance exceed the threshold; they are not,
so that the rate is lower.
"""

from scipy.stats import chi2

from equipoise.estimation.parameters.fit_parameters import RATE, R

KINDS = {"impulse": RATE, "com_step": R}  # what jumps, by kind of event
FALSE_ALARM = 3600.0  # s between false alarms, at least


def threshold(spacing: float) -> float:
    """Return the surprise (chi-square of 3) beyond which a cut is an event; ``spacing`` in s."""
    return float(chi2.isf(spacing / FALSE_ALARM / len(KINDS), 3))
