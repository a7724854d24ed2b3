"""A polynomial through a few neighbouring rows of a sensor, and what it leaves of each row.

    y_j = sum_a c_a (t_j - t_k)^a        for the 2 m + 1 rows about row k, least squares

For a gyro y is the rate. For an attitude it is the rotation vector, in body axes, by which row j is
off a turn at constant rate w through row k: y_j = log((q_k exp(w (t_j - t_k)))^-1 q_j). With the
turn taken out, y stays small however fast the platform spins. Near an edge of the record, or of a
gap, the window is as wide as elsewhere and row k is not in its middle.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from equipoise.maths.attitude import difference, exponential, multiply
from equipoise.model.arrays import Floats, Ints, Series1

GAP = 3.0  # median intervals, beyond which rows are no neighbours (as where gaps are named)
Vectors = Callable[[Ints, Ints], Floats]  # rows (n, w) and the row in each that counts -> (n, w, 3)


@dataclass(frozen=True, slots=True)
class Span:
    """How many rows, and a polynomial of which degree."""

    half: int
    degree: int

    @property
    def rows(self) -> int:
        """Return the number of rows of a window."""
        return 2 * self.half + 1


@dataclass(frozen=True, slots=True, eq=False)
class LocalFit:
    """Windows, one for each row that has one."""

    rows: Ints  # (n, w) the rows of each window
    place: Ints  # (n,) where in the window its own row stands
    basis: Floats  # (n, w, p) orthonormal columns that span the polynomials
    y: Floats  # (n, w, 3)
    left: Floats  # (n, w, 3) what the polynomial leaves of y
    free: Floats  # (n, w) variance of what is left, in units of the noise's

    @property
    def own(self) -> Ints:
        """Return the row that each window is about."""
        return self.rows[np.arange(len(self.rows)), self.place]

    @property
    def left_own(self) -> Floats:
        """Return what is left (n, 3) of each own row, as if it were noise of that row alone."""
        every = np.arange(len(self.rows))
        return self.left[every, self.place] / np.sqrt(self.free[every, self.place])[:, None]


def windows(t: Series1, keep: Ints, span: Span) -> tuple[Ints, Ints]:
    """Return the windows (n, w) over the rows to keep, and where in each its own row stands."""
    steps = np.diff(t[keep])
    ends = np.flatnonzero(steps > GAP * np.median(np.diff(t))) + 1
    found: list[Ints] = [np.zeros((0, span.rows), np.int64)]
    places: list[Ints] = [np.zeros(0, np.int64)]
    for piece in np.split(keep, ends):
        if len(piece) < span.rows:
            continue
        own = np.arange(len(piece))
        first = np.clip(own - span.half, 0, len(piece) - span.rows)
        found.append(piece[first[:, None] + np.arange(span.rows)])
        places.append(own - first)
    return np.concatenate(found), np.concatenate(places)


def local_fit(t: Series1, keep: Ints, vectors: Vectors, span: Span) -> LocalFit:
    """Return the fit about each row to keep."""
    rows, place = windows(t, keep, span)
    own = rows[np.arange(len(rows)), place]
    x = t[rows] - t[own][:, None]
    x = x / np.maximum(np.abs(x).max(axis=1, keepdims=True), 1e-300)
    basis = np.linalg.qr(x[:, :, None] ** np.arange(span.degree + 1)).Q
    y = vectors(rows, own)
    left = y - basis @ (basis.swapaxes(1, 2) @ y)
    free = 1.0 - np.sum(basis**2, axis=2)
    return LocalFit(rows, place, basis, y, left, np.maximum(free, 1e-9))


def rate_vectors(values: Floats) -> Vectors:
    """Return how a gyro's rows are fitted: as they are."""
    return lambda rows, own: values[rows] - values[own][:, None]


def attitude_vectors(t: Series1, q: Floats) -> Vectors:
    """Return how an attitude's rows are fitted: without the turn that they have in common."""

    def about(rows: Ints, base: Ints, rate: Floats) -> Floats:
        since = (t[rows] - t[base][:, None])[:, :, None]
        return difference(q[rows], multiply(q[base][:, None], exponential(rate[:, None] * since)))

    def vectors(rows: Ints, own: Ints) -> Floats:
        after, before = rows[:, 1:], rows[:, :-1]
        steps = difference(q[after], q[before]) / (t[after] - t[before])[:, :, None]
        rate = np.median(steps, axis=1)  # one bad row spoils two steps, not their median
        middle = rows.shape[1] // 2
        other = np.where(own == rows[:, middle], rows[:, middle - 1], rows[:, middle])
        one, two = about(rows, own, rate), about(rows, other, rate)
        # About a bad row all others seem off, and swing with the spin: then take the other base.
        better = _size(one) <= _size(two)
        return np.where(better[:, None, None], one, two)

    return vectors


def _size(y: Floats) -> Series1:
    return np.asarray(np.median(np.linalg.norm(y, axis=2), axis=1), np.float64)
