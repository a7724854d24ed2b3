"""The chi-square distribution of n degrees of freedom: P(x > limit) = chance.

From SciPy's special functions: its package of distributions takes half a second to import.
"""

import scipy


def chi_square_limit(freedom: int, chance: float) -> float:
    """Return what a chi-square exceeds by a ``chance``, 0 to 1."""
    return float(scipy.special.chdtri(freedom, chance))


def chi_square_chance(freedom: int | float, value: float) -> float:
    """Return the chance, 0 to 1, that a chi-square exceeds a value."""
    return float(scipy.special.chdtrc(freedom, value))
