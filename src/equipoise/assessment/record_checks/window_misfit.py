"""What explains the misfit of a window: a few rows that are wrong, or a touch of the platform.

Each is a set of columns beside those of the local polynomial; what is left of the rows, in units of
their scale, is compared.

    rows       one column for each row left out
    a touch    of an attitude: (t - t_j)+ and (t - t_j+1)+, its rate jumps at j, at j + 1 or between
               of a gyro:      the same, and t > t_j with t > t_j+1, both in the same direction,
                               with a bend
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from equipoise.model.arrays import Floats, Series1, Vector3

MOST = 3  # rows left out of one window
OPPOSED = -0.5  # of the larger of two jumps: beyond, they are one row off and back (chosen)
FREE = 1e-6  # of a row's variance: with less, the columns follow it wherever it is
ASIDE = 2  # rows on either side of a break: with one, it is a row by itself
SMOOTH = 2.0  # times the scale: what the other rows of a window may show (chosen)


@dataclass(frozen=True, slots=True, eq=False)
class Window:
    """The rows of a window."""

    t: Series1  # s
    basis: Floats  # (w, p) orthonormal columns of the polynomials
    y: Floats  # (w, 3)
    sd: Vector3  # the scale of each axis


def odd_rows(window: Window, allowed: tuple[int, ...], limit: float) -> tuple[int, ...]:
    """Return the places of the rows whose absence explains the misfit; none if nothing does.

    They are found one after the other, each as the one that explains most of what is left. Each
    must in the end take more than ``limit`` off the misfit, in units of the scale squared.
    """
    rows, terms = window.basis.shape
    places: tuple[int, ...] = ()
    for count in range(1, MOST + 1):
        places = (*places, _worst(window, places, allowed))
        left = misfit(window, out(window, places))
        smooth = left < 3 * (rows - terms - count) * SMOOTH**2
        if smooth and all(
            misfit(window, out(window, tuple(p for p in places if p != place))) - left > limit
            for place in places
        ):
            return tuple(sorted(places))
    return ()


def out(window: Window, places: tuple[int, ...]) -> Floats:
    """Return the columns that leave rows out."""
    return np.eye(len(window.t))[:, list(places)]


def _worst(window: Window, places: tuple[int, ...], allowed: tuple[int, ...]) -> int:
    """Return the row whose absence takes most off the misfit, beside those at given places."""
    basis = _basis(window, out(window, places))
    left = _left(window, basis)
    free = 1.0 - np.sum(basis**2, axis=1)
    gain = np.sum(left**2, axis=1) / np.maximum(free, FREE)
    others = [place for place in allowed if place not in places]
    return others[int(np.argmax(gain[others]))]


def away(window: Window, places: tuple[int, ...]) -> Floats:
    """Return how far (count, 3) the rows left out are off the motion of the others."""
    return _coefficients(window, out(window, places))


def touch_misfit(window: Window, most: float, attitude: bool) -> float:
    """Return the misfit of the touch that explains the window best.

    ``most`` is the largest jump of the rate (rad/s) that counts as a touch. Attitudes bend only; a
    gyro's rows break, too.
    """
    found = [misfit(window, out(window, ()))]
    found += [misfit(window, columns) for columns in _bends(window, most, attitude)]
    if not attitude:
        found += [misfit(window, columns) for columns in _breaks(window, most)]
    return min(found)


def misfit(window: Window, columns: Floats) -> float:
    """Return the sum of squares that polynomial and columns leave, in units of the scale."""
    return float(np.sum(_left(window, _basis(window, columns)) ** 2))


def _left(window: Window, basis: Floats) -> Floats:
    return (window.y - basis @ (basis.T @ window.y)) / window.sd


def _basis(window: Window, columns: Floats) -> Floats:
    return np.linalg.qr(np.hstack([window.basis, columns])).Q


def _bends(window: Window, most: float, attitude: bool) -> Iterator[Floats]:
    t = window.t
    for j in range(1, len(t) - 2):
        columns = np.maximum(t[:, None] - t[[j, j + 1]], 0.0)
        jump = np.linalg.norm(_coefficients(window, columns), axis=1).max()
        if jump * (1.0 if attitude else t[j + 1] - t[j]) <= most:
            yield columns


def _breaks(window: Window, most: float) -> Iterator[Floats]:
    t, rows = window.t, len(window.t)
    for j in range(ASIDE - 1, rows - ASIDE - 1):
        bend = np.maximum(t - t[j], 0.0)[:, None]
        columns = np.hstack([(t[:, None] > t[[j, j + 1]]).astype(float), bend])
        first, second, _ = _coefficients(window, columns)
        opposed = first @ second < OPPOSED * max(first @ first, second @ second)
        if not opposed and np.linalg.norm(first + second) <= most:
            yield columns


def _coefficients(window: Window, columns: Floats) -> Floats:
    """Return the coefficients (k, 3) of columns fitted beside the polynomials."""
    both = np.hstack([window.basis, columns])
    found = np.asarray(np.linalg.lstsq(both, window.y, rcond=None)[0], np.float64)
    return found[window.basis.shape[1] :]
