"""Running integrals of a sampled function along its first axis, from its first row.

By trapezia,

    I_k+1 = I_k + h_k (y_k + y_k+1) / 2

and by Simpson's rule for uneven steps (Cartwright, J. Math. Sci. Math. Educ. 12, 2017, eq. 8): step
k of length h_k, with the next one of length g as far as there is one, else with the one before,

    I_k+1 = I_k + h/6 [ (3 - r) y_k + (3 + r h/g + r) y_k+1 - r h/g y_k+2 ],      r = h / (h + g)

which is exact for parabolas. Steps are taken in pairs, so every other one looks back.
"""

import numpy as np

from equipoise.model.arrays import Floats, Ints, Series1


def by_trapezia(t: Series1, y: Series1) -> Series1:
    """Return the integral (n - 1,) up to each row of y (n,) but the first."""
    return np.cumsum(np.diff(t) * (y[1:] + y[:-1]) / 2.0)


def by_parabolas(t: Series1, y: Floats) -> Floats:
    """Return the integral up to each of at least three rows of y (n, ...); zero at the first."""
    first, weights = parabola_weights(t)
    wide = weights.reshape(len(t), 3, *(1,) * (y.ndim - 1))
    steps: Floats = wide[:, 0] * y[first]
    steps += wide[:, 1] * y[first + 1] + wide[:, 2] * y[first + 2]
    return np.cumsum(steps, axis=0)


def parabola_weights(t: Series1) -> tuple[Ints, Floats]:
    """Return by which three rows each row's step is integrated: the first (n,); weights (n, 3), s.

    The step is the one that ends at the row; the first row has none.
    """
    h, n = np.diff(t), len(t)
    ahead, back = _of_three(h[:-1], h[1:]), _of_three(h[1:], h[:-1])[:, ::-1]
    first, weights = np.maximum(np.arange(n) - 2, 0), np.zeros((n, 3))
    weights[2:] = back
    first[1:-1:2], weights[1:-1:2] = np.arange(0, n - 2, 2), ahead[::2]
    return first, weights


def _of_three(h: Series1, beside: Series1) -> Floats:
    """Return the weights of a step's near, far and next row."""
    r = h / (h + beside)
    bend = r * (h / beside)
    return (h / 6)[:, None] * np.column_stack([3 - r, 3 + bend + r, -bend])
