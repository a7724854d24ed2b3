"""A gyro and an accelerometer in a table without an attitude: which columns, axes and factors.

    n = a / |a|,    |a| = g,    n' = n x w,    w_k = f s_k c_o(k) - b_k

An accelerometer on a platform near its bearing feels hardly more than gravity, which gives its
factor. How gravity turns in the body gives the gyro's factor f, the order o and the signs s of its
columns: n(t) is held against the sums of n x w, of all orders and signs, with zeros b.

Columns are taken by their names. Cannot see the turn about gravity but as far as the platform
leans, so axes that are not those of the accelerometer are believed only where these are far worse.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from equipoise.assessment.hypotheses.clocks import ClockGuess, clock_guesses
from equipoise.assessment.hypotheses.gyros import ORDERS, RATES, SIGNS, known_factor
from equipoise.assessment.hypotheses.number_table import NumberTable, varies, words_of
from equipoise.assessment.hypotheses.verticals import EVEN, accelerometer_columns
from equipoise.model.arrays import Floats, Series1, Series3, Vector3
from equipoise.model.growing_times import longest_rising
from equipoise.model.units import G0

SPAN = 0.1  # s, over which rows are averaged (chosen: a swing takes seconds)
FEWEST = 50  # spans (chosen)
AGREES = 0.2  # share of the variation of n that may be left (chosen)
TIMES = 4.0  # by which another order must leave less than the plain one to be taken (chosen)
GYRO_WORDS = ("gyr", "gyro", "omega", "rate", "angvel")
# What one count is, m/s^2: units in use, then data sheets of common accelerometers.
ACCELERATIONS = {"m/s2": 1.0, "g0": G0} | {
    f"1/{counts} g0 per count": G0 / counts for counts in (256, 1024, 2048, 4096, 8192, 16384)
} | {"mg0": G0 / 1000}  # fmt: skip


class Triad(NamedTuple):
    """Three columns: axis k is ``signs[k] columns[k] factor``."""

    columns: tuple[str, str, str]
    signs: tuple[int, int, int]
    factor: float  # SI for one of the column's unit
    unit: str  # as it is known; '' for a factor that is none of those known


@dataclass(frozen=True, slots=True, eq=False)
class InertialUnit:
    """What a table without an attitude holds."""

    clock: ClockGuess
    accelerometer: Triad
    gyro: Triad  # axes of the accelerometer
    misfit: float  # share of how gravity turned that the gyro leaves
    spans: int  # that were compared
    up: str  # axis of the accelerometer that is nearest to the vertical: 'z', '-x'


def inertial_unit(table: NumberTable) -> InertialUnit | None:
    """Return the unit of a table; None where names or numbers show none."""
    clocks, load, turns = clock_guesses(table), accelerometer_columns(table), gyro_columns(table)
    if not (clocks and load and turns):
        return None
    t, a, c = _means(table, clocks[0], load, turns)
    if len(t) < FEWEST:
        return None
    length = np.linalg.norm(a, axis=1)
    if length.min() <= 0 or np.std(length) > EVEN * np.mean(length):
        return None
    n: Series3 = a / length[:, None]
    gyro = _gyro(t, n, c, turns)
    if gyro is None:
        return None
    triad, misfit = gyro
    mean: np.float64 = length.mean()
    factor, unit = known_factor(G0 / float(mean), ACCELERATIONS)
    accelerometer = Triad(load, (1, 1, 1), factor, unit)
    return InertialUnit(clocks[0], accelerometer, triad, misfit, len(t), _up(n))


def gyro_columns(table: NumberTable) -> tuple[str, str, str] | None:
    """Return the columns that are named as x, y, z of one gyro; None unless there is one."""
    found: list[str] = []
    for axis in "xyz":
        named = [n for n in table.names if _is_rate(n, axis) and varies(table.column(n))]
        if len(named) != 1:
            return None
        found += named
    return found[0], found[1], found[2]


def _is_rate(name: str, axis: str) -> bool:
    words = words_of(name)
    spoken = any(w.startswith(GYRO_WORDS) for w in words)
    joined = any(w in (f"g{axis}", f"w{axis}", f"gyr{axis}", f"gyro{axis}") for w in words)
    return joined or (spoken and axis in words)


def _means(
    table: NumberTable, clock: ClockGuess, load: tuple[str, ...], turns: tuple[str, ...]
) -> tuple[Series1, Series3, Series3]:
    """Return middles of spans (s), and the means of both triads over them."""
    named = np.stack([table.column(n) for n in (clock.column, *load, *turns)], axis=1)
    rows = named[np.isfinite(named).all(axis=1)]
    rows = rows[longest_rising(rows[:, 0])] if len(rows) else rows
    each = max(1, round(SPAN / clock.step))
    count = len(rows) // each
    means: Floats = rows[: count * each].reshape(count, each, 7).mean(axis=1)
    return means[:, 0] * clock.factor, means[:, 1:4], means[:, 4:]


def _gyro(
    t: Series1, n: Series3, c: Series3, names: tuple[str, str, str]
) -> tuple[Triad, float] | None:
    """Return the gyro, and what it leaves; None where no order of its columns agrees."""
    found = sorted(_assignments(t, n, c), key=lambda each: each[0])
    plain = next((each for each in found if each[1:3] == (ORDERS[0], SIGNS[0])), None)
    best = plain if plain is not None and plain[0] < TIMES * found[0][0] else found[0]
    misfit, order, signs, measured = best
    if misfit > AGREES:
        return None
    factor, unit = known_factor(measured, RATES)
    x, y, z = (names[k] for k in order)
    return Triad((x, y, z), signs, factor, unit), misfit


def _assignments(
    t: Series1, n: Series3, c: Series3
) -> Iterator[tuple[float, tuple[int, int, int], tuple[int, int, int], float]]:
    """Yield misfit, order, signs and factor of each way to read the columns of a gyro."""
    step, middle = np.diff(t)[:, None], 0.5 * (n[1:] + n[:-1])
    zeros = [np.cumsum(np.cross(middle, axis) * step, axis=0) for axis in np.eye(3)]
    starts = [np.broadcast_to(axis, middle.shape) for axis in np.eye(3)]
    beside = np.stack([each.ravel() for each in (*zeros, *starts)], axis=1)
    basis = np.linalg.qr(beside)[0]
    shown = _without(basis, n[1:].ravel())
    power, rates = float(shown @ shown), 0.5 * (c[1:] + c[:-1])
    for order in ORDERS:
        for signs in SIGNS:
            w = rates[:, list(order)] * np.array(signs)
            turned = _without(basis, np.cumsum(np.cross(middle, w) * step, axis=0).ravel())
            factor = float(turned @ shown) / float(turned @ turned)
            if factor > 0:
                left = shown - factor * turned
                yield float(left @ left) / power, order, signs, factor


def _without(basis: Floats, values: Series1) -> Series1:
    return values - basis @ (basis.T @ values)


def _up(n: Series3) -> str:
    mean: Vector3 = n.mean(axis=0)
    axis = int(np.argmax(np.abs(mean)))
    return ("-" if mean[axis] < 0 else "") + "xyz"[axis]
