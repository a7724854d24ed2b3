"""Running integrals of a sampled function along its first axis, from its first row.

By trapezia,

    I_k+1 = I_k + h_k (y_k + y_k+1) / 2

and by Simpson's rule for uneven steps (Cartwright, J. Math. Sci. Math. Educ. 12, 2017, eq. 8): step
k of length h_k, with the next one of length g as far as there is one, else with the one before,

    I_k+1 = I_k + h/6 [ (3 - r) y_k + (3 + r h/g + r) y_k+1 - r h/g y_k+2 ],      r = h / (h + g)

which is exact for parabolas. Steps are taken in pairs, so every other one looks back.
"""

import numpy as np

from equipoise.model.arrays import Floats, Series1


def by_trapezia(t: Series1, y: Series1) -> Series1:
    """Return the integral (n - 1,) up to each row of y (n,) but the first."""
    return np.cumsum(np.diff(t) * (y[1:] + y[:-1]) / 2.0)


def by_parabolas(t: Series1, y: Floats) -> Floats:
    """Return the integral up to each of at least three rows of y (n, ...); zero at the first."""
    h = np.diff(t).reshape(-1, *(1,) * (y.ndim - 1))
    ahead, back = _parts(h, y), _parts(h[::-1], y[::-1])[::-1]
    steps = np.zeros_like(y, dtype=np.float64)
    steps[1:-1:2], steps[2::2], steps[-1] = ahead[::2], back[::2], back[-1]
    return np.cumsum(steps, axis=0)


def _parts(h: Floats, y: Floats) -> Floats:
    """Return the integral over each step but the last, of the parabola through the next row."""
    first, second = h[:-1], h[1:]
    r = first / (first + second)
    bend = r * (first / second)
    return first / 6 * ((3 - r) * y[:-2] + (3 + bend + r) * y[1:-1] + -bend * y[2:])
