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
    h = np.diff(t).reshape(-1, *(1,) * (y.ndim - 1))
    ahead, back = _parts(h, y), _parts(h[::-1], y[::-1])[::-1]
    steps = np.zeros_like(y, dtype=np.float64)
    steps[1:-1:2], steps[2::2], steps[-1] = ahead[::2], back[::2], back[-1]
    return np.cumsum(steps, axis=0)


def parabola_weights(t: Series1) -> tuple[Ints, Floats]:
    """Return by which three rows ``by_parabolas`` takes each row's step: the first (n,).

    And their weights (n, 3), s. The step is the one that ends at the row; the first row has none.
    """
    h, n = np.diff(t), len(t)
    ahead, back = (scale[:, None] * np.column_stack(parts)
                   for scale, parts in (_of_three(h), _of_three(h[::-1])))  # fmt: skip
    first, weights = np.maximum(np.arange(n) - 2, 0), np.zeros((n, 3))
    weights[2:] = back[::-1, ::-1]
    first[1:-1:2], weights[1:-1:2] = np.arange(0, n - 2, 2), ahead[::2]
    return first, weights


def _parts(h: Floats, y: Floats) -> Floats:
    """Return the integral over each step but the last, of the parabola through the next row."""
    scale, (before, behind, after) = _of_three(h)
    return scale * (before * y[:-2] + behind * y[1:-1] + after * y[2:])


def _of_three(h: Floats) -> tuple[Floats, tuple[Floats, Floats, Floats]]:
    """Return by what the rows before, behind and after each step but the last count."""
    first, second = h[:-1], h[1:]
    r = first / (first + second)
    bend = r * (first / second)
    return first / 6, (3 - r, 3 + bend + r, -bend)
