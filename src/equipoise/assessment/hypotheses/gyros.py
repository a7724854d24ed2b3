"""Which columns may be a gyro, by what the attitude says of the rate of turn.

    w_a(t) = f s c(t) - b          for axis a of the body rate w: column c, sign s, zero b

Compared are sums of turns from attitude to attitude with the integral of a column, both without
what is straight in time: so the noise of attitudes does not grow and a zero does nothing. The
factor f is common to the three axes. The share of their variation that this leaves is the misfit:
of a wrong direction or order it is large where the platform turned well about the vertical.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from equipoise.assessment.hypotheses.number_table import NumberTable, words_of
from equipoise.maths.attitude import difference
from equipoise.model.arrays import Floats, Ints, Series1, Series3, Series4
from equipoise.model.units import DEG, MILLI, RPM

SPAN = 0.2  # s, over which turns are taken at most (chosen: a swing takes longer)
SMALL = np.radians(10.0)  # turn up to which the integral of rates is a turn (chosen)
LEAST = 0.02  # share of a column's variation that must be the motion's for it to be tried (chosen)
FEWEST = 20  # spans (chosen)
TRIED = 8  # columns that are tried as gyros, chosen: two inertial units and a magnetometer
ORDERS = [(0, 1, 2), (1, 2, 0), (2, 0, 1), (0, 2, 1), (2, 1, 0), (1, 0, 2)]
SIGNS = [(x, y, z) for x in (1, -1) for y in (1, -1) for z in (1, -1)]
# What one count is, rad/s: the units in use, then data sheets of common gyros, deg/s per count.
SHEETS = (1 / 131, 1 / 65.5, 1 / 32.8, 1 / 16.4, 8.75e-3, 17.5e-3, 35e-3, 70e-3, 1 / 14.375,
          1 / 16, 1 / 900)  # fmt: skip
RATES = {"rad/s": 1.0, "deg/s": DEG, "mrad/s": MILLI, "mdeg/s": MILLI * DEG, "rpm": RPM} | {
    f"{sheet:.6g} deg/s per count": sheet * DEG for sheet in SHEETS
}
NEAR = 0.04  # by which a factor may miss a known one (chosen: above the scale error of gyros)


@dataclass(frozen=True, slots=True, eq=False)
class Spans:
    """Spans between two attitudes, and the means of other columns over them."""

    starts: Ints  # rows of the attitude
    lag: int  # rows that a span is long
    duration: Series1  # s
    means: dict[str, Series1]

    def turns(self, q: Series4) -> Floats:
        """Return the sums of turns up to the end of each span, rad, body axes, nothing straight."""
        return self._bent(difference(q[self.starts + self.lag], q[self.starts]))

    def integrals(self) -> dict[str, Series1]:
        """Return the integrals of the columns up to the end of each span, nothing straight."""
        return {name: self._bent(mean * self.duration) for name, mean in self.means.items()}

    def _bent(self, steps: Floats) -> Floats:
        """Return sums of steps without their straight line in time."""
        t = np.cumsum(self.duration)
        straight = np.linalg.qr(np.stack([np.ones_like(t), t - t.mean()], axis=1))[0]
        whole = np.cumsum(steps, axis=0)
        return whole - straight @ (straight.T @ whole)


@dataclass(frozen=True, slots=True)
class GyroGuess:
    """Three columns that may be a gyro: axis k of the body is ``signs[k] columns[k] factor``."""

    columns: tuple[str, str, str]
    order: tuple[int, int, int]  # of the three axes' columns in the table
    signs: tuple[int, int, int]
    factor: float  # rad/s for one of the column's unit
    unit: str  # as it is known; '' for a factor that is none of those known
    misfit: float  # share of the variation that is left
    spans: int  # that were compared


def spans_of(t: Series1, q: Series4, table: NumberTable, names: list[str]) -> Spans:
    """Return spans without gaps over rows at given times.

    They are long, so that the noise of attitudes does little, and turns over them small.
    """
    starts, lag = span_rows(t, q)
    duration = t[starts + lag] - t[starts]
    even = (duration > 0) & (duration < 2 * np.median(duration))
    starts, duration = starts[even], duration[even]
    means = {name: _means(t, table.column(name), starts, lag) for name in names}
    return Spans(starts, lag, duration, {n: m for n, m in means.items() if _moves(m)})


def span_rows(t: Series1, q: Series4) -> tuple[Ints, int]:
    """Return the rows in which spans between attitudes begin, and how many rows they are long."""
    step = float(np.median(np.linalg.norm(difference(q[1:], q[:-1]), axis=1)))
    most = (SPAN / float(np.median(np.diff(t))), SMALL / max(step, 1e-12), len(t) / FEWEST)
    lag = max(1, int(min(most)))
    return np.arange(0, len(t) - lag, lag), lag


def gyro_guesses(turns: Series3, columns: dict[str, Series1]) -> list[GyroGuess]:
    """Return gyros that the columns may hold, the one with the smallest misfit first."""
    tried = _columns_that_turn(turns, columns)
    found = [g for three in combinations(tried, 3) for g in _assignments(turns, columns, three)]
    return sorted(found, key=lambda guess: guess.misfit)


def _columns_that_turn(turns: Series3, columns: dict[str, Series1]) -> list[str]:
    """Return the columns of which the motion explains most, in the table's order."""
    shares = {name: _share(turns, column) for name, column in columns.items()}
    best = sorted(shares, key=lambda name: -shares[name])[:TRIED]
    return [name for name in columns if name in best and shares[name] > LEAST]


def _moves(values: Series1) -> bool:
    return bool(np.isfinite(values).all() and np.ptp(values) > 0)


def _share(turns: Series3, column: Series1) -> float:
    """Return the share of a column's variation that a linear map of the turns explains."""
    answer = np.linalg.lstsq(turns, column, rcond=1e-9)[0]
    left = column - turns @ answer
    return 1.0 - float(left @ left) / float(column @ column)


def _assignments(
    turns: Series3, named: dict[str, Series1], three: tuple[str, ...]
) -> list[GyroGuess]:
    """Return the assignments of three columns to axes and signs."""
    columns = np.stack([named[name] for name in three], axis=1)
    whole, power = float(np.sum(columns**2)), float(np.sum(turns**2))
    cross = turns.T @ columns
    found: list[GyroGuess] = []
    for order in ORDERS:
        x, y, z = (three[k] for k in order)  # the column of each axis
        along = cross[range(3), order]
        for signs in SIGNS:
            projected = float(np.dot(signs, along))
            if projected > 0:
                # The attitude is the noisier, so it is what is explained.
                factor, unit = known_factor(projected / whole, RATES)
                misfit = 1.0 - projected**2 / (power * whole)
                found.append(GyroGuess((x, y, z), order, signs, factor, unit, misfit, len(turns)))
    return found


def known_factor(measured: float, known: Mapping[str, float]) -> tuple[float, str]:
    """Return the known factor nearest to a measured one, and its unit; else the one measured."""
    unit = min(known, key=lambda each: abs(float(np.log(measured / known[each]))))
    if abs(measured / known[unit] - 1) < NEAR:
        return known[unit], unit
    return measured, ""


def _means(t: Series1, values: Series1, starts: Ints, lag: int) -> Floats:
    """Return the mean of a column over each span, by trapezoids."""
    good = np.isfinite(values)
    if not good.all():
        if good.sum() < 0.5 * len(values):
            return np.full(len(starts), np.nan)
        values = np.interp(t, t[good], values[good])
    panels = 0.5 * np.diff(t) * (values[1:] + values[:-1])
    whole = np.concatenate([[0.0], np.cumsum(panels)])
    spans: Floats = t[starts + lag] - t[starts]
    return (whole[starts + lag] - whole[starts]) / spans


def stem(names: tuple[str, ...]) -> bool:
    """Say whether names are alike but for a letter or a number, as of one sensor."""
    rests = {tuple(w for w in words_of(n) if w not in ("x", "y", "z", "0", "1", "2", "3"))
             for n in names}  # fmt: skip
    return len(rests) == 1
