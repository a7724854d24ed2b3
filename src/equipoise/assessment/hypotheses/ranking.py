"""Every whole reading of a table, compared: the likeliest, and those that the data leave alike."""

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from equipoise.assessment.hypotheses.attitudes import (
    AttitudeGuess,
    angle_guesses,
    angle_sets,
    attitude_of,
    norm_sd,
    quaternion_guesses,
    quaternion_sets,
)
from equipoise.assessment.hypotheses.clocks import ClockGuess, clock_guesses
from equipoise.assessment.hypotheses.frames import FrameGuess, frame_guesses
from equipoise.assessment.hypotheses.gyro_zero import GyroZero, zero_of
from equipoise.assessment.hypotheses.gyros import GyroGuess, gyro_guesses, spans_of, stem
from equipoise.assessment.hypotheses.number_table import NumberTable, words_of
from equipoise.assessment.hypotheses.verticals import Vertical, vertical_of
from equipoise.model.arrays import Floats, Ints, Series4
from equipoise.model.growing_times import longest_rising, wraps

CLOCKS = 3  # that are tried (chosen)
DOUBTED = 1.0  # doubt beyond the best clock's, from which a clock is not tried (chosen)
UNUSUAL = 0.25  # doubt beyond the best clock's, from which a unit is out of the question (chosen)
MOST_ROWS = 12_000  # rows that are compared; chosen: minutes of any sensor
AGREES = 0.5  # misfit up to which a gyro agrees with an attitude (chosen)
FEWEST = 10  # rows (chosen)
BEST = 60  # assignments of a gyro that are kept of each attitude (chosen)
SURE = 30.0  # by how much chi squared must differ for a reading to be worse (chosen)
NEAR = 4.0  # by how much it may differ for what is usual to be preferred (chosen)
SAME = 1e-6  # of the misfit, by which readings of the same motion differ (chosen: rounding)
SHOWN = 12  # readings that are kept (chosen)
# Doubt of what the names speak against, and of what is unusual, where data decide nothing (chosen).
NAMED, STRANGE = 3.0, 1.0


@dataclass(frozen=True, slots=True)
class TableReading:
    """One whole reading of a table."""

    clock: ClockGuess
    attitude: AttitudeGuess
    gyro: GyroGuess | None
    frames: tuple[FrameGuess, ...]  # the likeliest first
    norm_sd: float = 0.0  # of the quaternions' lengths about one
    in_laboratory: bool = False  # rates about axes of the laboratory explain the same more plainly
    zero: GyroZero | None = None  # the gyro's
    vertical: Vertical | None = None  # by an accelerometer, if there is one

    @property
    def frame(self) -> FrameGuess:
        """Return what points up."""
        return self.frames[0]

    @property
    def has_names(self) -> bool:
        """Say whether the columns' names say which axis is which."""
        letters = [words_of(name)[-1:] for name in (*self.attitude.columns, *self._gyro_columns)]
        return all(word and word[0][-1] in "wxyz" for word in letters) or bool(
            self.attitude.sequence
        )

    @property
    def _gyro_columns(self) -> tuple[str, ...]:
        return () if self.gyro is None else self.gyro.columns

    @property
    def handed(self) -> bool:
        """Say whether the gyro's axes, as they are read, came in a right-handed order."""
        if self.gyro is None:
            return True
        axes = np.eye(3)[list(self.gyro.order)] * np.array(self.gyro.signs)[:, None]
        return bool(np.linalg.det(axes) > 0)

    @property
    def against_laboratory(self) -> bool:
        """Say whether plain rates about axes of the laboratory are read as of the body, reversed.

        Of the opposite attitude they are those about the body's axes, with all signs changed.
        """
        attitude, gyro = self.attitude, self.gyro
        if gyro is None or not attitude.inverse or attitude.scalar in (1, 2):
            return False
        return gyro.order == (0, 1, 2) and gyro.signs == (-1, -1, -1)

    @property
    def doubt(self) -> float:
        """Return how unusual the reading is, for where the data decide nothing."""
        attitude, gyro = self.attitude, self.gyro
        doubt = self.clock.doubt
        doubt += STRANGE * (self.frame.body_up != "z") + STRANGE * (self.frame.lab_up != "z")
        doubt += STRANGE * attitude.inverse + STRANGE * (attitude.scalar in (1, 2))
        doubt += NAMED * (not attitude.named_as_read) + STRANGE * (attitude.signs != (1, 1, 1))
        doubt += 0.1 * (attitude.sequence not in ("", "ZYX"))
        if gyro is not None:
            doubt += STRANGE * (gyro.signs != (1, 1, 1)) + STRANGE * (not self.handed)
            doubt += STRANGE * (not gyro.unit) + 0.5 * (not stem(gyro.columns))
            doubt += STRANGE * (gyro.order != (0, 1, 2))
        return doubt


@dataclass(frozen=True, slots=True)
class Ranked:
    """Readings: the likeliest first, then those as good by the data, then the next."""

    alike: tuple[TableReading, ...]
    runner_up: TableReading | None  # the best of those that the data speak against
    decided: bool  # the first is to be taken; else a person has to choose


def ranked(table: NumberTable) -> Ranked:
    """Return the readings of a table; none where it has no clock or no attitude."""
    clocks = clock_guesses(table)[:CLOCKS]
    clocks = [clock for clock in clocks if clock.doubt < clocks[0].doubt + DOUBTED]
    readings = _different([r for clock in clocks for r in _readings(table, clock)])
    if not readings:
        return Ranked((), None, False)
    best = min(readings, key=_misfit)
    alike = sorted((r for r in readings if _excess(r, best) < SURE), key=lambda r: r.doubt)
    others = [r for r in readings if _excess(r, best) >= SURE]
    alike = _with_known_units(alike)
    decided = len(alike) == 1 or _is_usual(alike[0], alike[1], best)
    decided = decided and not alike[0].in_laboratory
    shown = tuple(_with_evidence(table, reading) for reading in alike[:SHOWN])
    return Ranked(shown, min(others, key=_misfit, default=None), decided)


def _with_evidence(table: NumberTable, reading: TableReading) -> TableReading:
    """Return a reading with the zero of its gyro, and with what an accelerometer says of up."""
    gyro = reading.gyro
    rows, t = _timed_rows(table, reading.clock, attitude_of(table, reading.attitude))
    part = NumberTable(table.names, table.values[rows], table.units)
    q = attitude_of(part, reading.attitude)
    spans = None if gyro is None else spans_of(t, q, part, list(gyro.columns))
    zero = None if gyro is None or spans is None else zero_of(spans, q, gyro)
    vertical = vertical_of(part, q, gyro, reading.frame.lab_up)
    return replace(reading, zero=zero, vertical=vertical)


def _with_known_units(alike: list[TableReading]) -> list[TableReading]:
    """Return the readings in which clock and gyro have units that are in use, if some are such.

    A clock in another unit is made up for by a gyro in a unit of its own. Without a gyro only rates
    that sensors usually have speak for a clock's unit.
    """
    named = [r for r in alike if r.gyro is not None and r.gyro.unit]
    if named or any(r.gyro is not None for r in alike):
        return named or alike
    least = min(r.clock.doubt for r in alike)
    return [r for r in alike if r.clock.doubt < least + UNUSUAL]


def _is_usual(first: TableReading, second: TableReading, best: TableReading) -> bool:
    """Say whether names and usage decide between readings that the data leave alike.

    They may where the columns' names have meaning and the data do not speak against them at all.
    """
    if not first.has_names or _excess(first, best) > NEAR:
        return False
    return first.gyro is not None and first.doubt + STRANGE <= second.doubt


def _misfit(reading: TableReading) -> float:
    return 1.0 if reading.gyro is None else reading.gyro.misfit


def _excess(reading: TableReading, best: TableReading) -> float:
    """Return by how much chi squared of a reading is above the best's; infinite without a gyro."""
    if best.gyro is None or reading.gyro is None:
        return 0.0 if best.gyro is reading.gyro else np.inf
    least = max(best.gyro.misfit, 1e-9)
    return (reading.gyro.misfit / least - 1.0) * 3 * best.gyro.spans


def _different(readings: list[TableReading]) -> list[TableReading]:
    """Return one reading of each motion: of several the one with the least doubt.

    A quaternion in another order, of the other direction, is the same motion with other axes, which
    the order of the gyro then undoes.
    """
    alike: dict[tuple[object, ...], list[TableReading]] = {}
    for reading in sorted(readings, key=lambda r: r.doubt):
        alike.setdefault(_motion(reading), []).append(reading)
    return [_first(same) for same in alike.values()]


def _first(same: list[TableReading]) -> TableReading:
    """Return the first of readings of one motion, and whether another explanation is as plain."""
    return replace(same[0], in_laboratory=any(reading.against_laboratory for reading in same))


def _motion(reading: TableReading) -> tuple[object, ...]:
    """Return what distinguishes the motion of a reading from others."""
    clock, attitude, gyro = reading.clock, reading.attitude, reading.gyro
    which = (clock.column, clock.unit, attitude.columns)
    if gyro is not None:
        return (*which, frozenset(gyro.columns), round(np.log(max(gyro.misfit, 1e-12)) / SAME))
    if attitude.sequence:
        return (*which, attitude)
    return (*which, (attitude.scalar + attitude.inverse) % 2)


def _readings(table: NumberTable, clock: ClockGuess) -> Iterable[TableReading]:
    sets = [(four, tuple(quaternion_guesses(four))) for four in quaternion_sets(table)]
    if not sets:
        sets = [(three, tuple(angle_guesses(table, three))) for three in angle_sets(table)]
    for columns, guesses in sets:
        yield from _of_attitude(table, clock, columns, guesses)


def _of_attitude(
    table: NumberTable,
    clock: ClockGuess,
    columns: tuple[str, ...],
    guesses: tuple[AttitudeGuess, ...],
) -> Iterable[TableReading]:
    """Yield the readings in which given columns are the attitude."""
    rows, t = _timed_rows(table, clock, attitude_of(table, guesses[0]))
    if len(rows) < FEWEST:
        return
    part = NumberTable(table.names, table.values[rows], table.units)
    others = [n for n in table.names if n not in (*columns, clock.column)]
    spans = spans_of(t, attitude_of(part, guesses[0]), part, others)
    norm = 0.0 if guesses[0].sequence else norm_sd(part, columns)
    integrals = spans.integrals()
    for guess in guesses:
        q = attitude_of(part, guess)
        frames = tuple(frame_guesses(q))
        gyros = gyro_guesses(spans.turns(q), integrals)
        agreeing = [gyro for gyro in gyros[:BEST] if gyro.misfit < AGREES]
        for gyro in agreeing:
            yield TableReading(clock, guess, gyro, frames, norm)
        if not agreeing:
            yield TableReading(clock, guess, None, frames, norm)


def _timed_rows(table: NumberTable, clock: ClockGuess, q: Series4) -> tuple[Ints, Floats]:
    """Return the rows that have an attitude, without those out of order, and their times (s)."""
    counted = table.column(clock.column) * clock.factor
    rows = np.flatnonzero(np.isfinite(q).all(axis=1) & np.isfinite(counted))[:MOST_ROWS]
    t = counted[rows]
    for place, length in wraps(t, clock.factor):
        t[place:] += length
    kept = longest_rising(t) if (np.diff(t) < 0).any() else np.arange(len(t))
    kept = kept[np.append(True, np.diff(t[kept]) > 0)[: len(kept)]]
    return rows[kept], t[kept]
