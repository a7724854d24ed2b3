"""Records as a table of which nobody has said what its columns are."""

from dataclasses import dataclass

import numpy as np

from equipoise.assessment.hypotheses.attitudes import attitude_of
from equipoise.assessment.hypotheses.number_table import NumberTable
from equipoise.assessment.hypotheses.ranking import TableReading
from equipoise.maths.attitude import conjugate
from equipoise.model.arrays import Floats, Series1, Series3
from equipoise.model.units import DEG, MILLI
from tests.support.recordings.recorded_motion import Motion
from tests.support.recordings.same_motion import RENAMED, axes_of

COUNT = (DEG / 131, DEG / 16.4)  # rad/s, of a gyro that goes to 250 or 2000 deg/s in 16 bits
UNITS = (1.0, DEG, MILLI, *COUNT)
PER_S = {"time": 1.0, "ms": 1e3, "us": 1e6, "ns": 1e9}
ORDERS = ("wxyz", "xyzw")
EPOCH = 1.7e9  # s since 1970
SAME, RATE = 0.02, 0.02  # rad; of the largest rate: far above rounding, far below another meaning


@dataclass(frozen=True, slots=True, eq=False)
class Scrambled:
    """A table, and how it was made."""

    table: NumberTable
    motion: Motion
    how: str


def scrambled(rng: np.random.Generator, motion: Motion, gyro: bool = True) -> Scrambled:
    """Return a motion in an order, in units and under names that are drawn."""
    clock, unit, counted = _clock(rng, motion.t)
    inverse, order = bool(rng.integers(2)), ORDERS[rng.integers(2)]
    q = conjugate(motion.q) if inverse else motion.q
    blocks = [(clock, counted[:, None])]
    blocks.append((" ".join(f"q{c}" for c in order), q[:, ["wxyz".index(c) for c in order]]))
    how = f"{clock} {unit} {order}{' inverse' * inverse}"
    if gyro:
        rates, of_gyro = _gyro(rng, motion.w)
        blocks.append(("gx gy gz", rates))
        how += of_gyro
    blocks += _others(rng, len(motion.t))
    rng.shuffle(blocks)
    values = np.hstack([columns for _, columns in blocks])
    meant = bool(rng.integers(2))
    names = " ".join(name for name, _ in blocks).split()
    names = names if meant else [f"c{k}" for k in range(len(names))]
    return Scrambled(NumberTable(tuple(names), values), motion, f"{how}; {' '.join(names)}")


def _clock(rng: np.random.Generator, t: Series1) -> tuple[str, str, Series1]:
    """Return a clock's name, where it starts, and what it counts: a date, a board's, or zero."""
    name = list(PER_S)[rng.integers(4)]
    start = ("zero", "date", "board", "wrap")[rng.integers(4)]
    if start == "wrap" and name == "us":
        return name, start, np.round(1e6 * t + 2.0**32 - 20e6) % 2.0**32
    begin = {"date": EPOCH, "board": 123.4}.get(start, 0.0)
    counted = (t + begin) * PER_S[name]
    return name, start, np.round(counted, 6) if name == "time" else np.round(counted)


def _gyro(rng: np.random.Generator, w: Series3) -> tuple[Series3, str]:
    """Return a gyro in some unit whose axes have any order and signs."""
    order, signs = rng.permutation(3), rng.choice([1, -1], 3)
    unit = UNITS[rng.integers(len(UNITS))]
    values = w[:, order] * signs / unit
    return np.round(values) if unit in COUNT else values, f" gyro {order} {signs} {unit:.3g}"


def _others(rng: np.random.Generator, rows: int) -> list[tuple[str, Floats]]:
    """Return columns that mean nothing to an estimate."""
    walk = 20.0 + 0.01 * np.cumsum(rng.normal(size=rows))
    others = [("temp", walk[:, None]), ("mode", np.arange(rows)[:, None] % 7.0)]
    return others[: rng.integers(3)]


def is_right(reading: TableReading, made: Scrambled) -> bool:
    """Say whether a reading is the motion: its attitude with what is up, its rate, its clock."""
    table, motion = made.table, made.motion
    up = _axis(reading.frame.lab_up)
    found = axes_of(attitude_of(table, reading.attitude), motion.q, SAME, RENAMED, up)
    standing = [S for S, _ in found if np.array_equal(S[:, 2], _axis(reading.frame.body_up))]
    t = table.column(reading.clock.column) * reading.clock.factor
    step = np.median(np.diff(t)) / np.median(np.diff(motion.t))
    return bool(standing) and abs(step - 1) < 1e-3 and _has_rate(reading, made, standing)


def _has_rate(reading: TableReading, made: Scrambled, standing: list[Floats]) -> bool:
    if reading.gyro is None:
        return "gyro" not in made.how
    gyro, w = reading.gyro, made.motion.w
    read = np.stack([made.table.column(name) for name in gyro.columns], axis=1)
    read = read * np.array(gyro.signs) * gyro.factor
    return any(np.abs(read @ S - w).max() < RATE * np.abs(w).max() for S in standing)


def _axis(name: str) -> Floats:
    return (-1.0 if name.startswith("-") else 1.0) * np.eye(3)["xyz".index(name[-1])]
