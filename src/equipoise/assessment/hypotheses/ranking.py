"""Every whole reading of a table, compared: the likeliest, and those that the data leave alike."""

from collections.abc import Iterable
from dataclasses import dataclass

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
from equipoise.assessment.hypotheses.gyros import GyroGuess, gyro_guesses, spans_of, stem
from equipoise.assessment.hypotheses.number_table import NumberTable
from equipoise.model.arrays import Bools

CLOCKS = 3  # that are tried (chosen)
MOST_ROWS = 12_000  # rows that are compared; chosen: minutes of any sensor
AGREES = 0.5  # misfit up to which a gyro agrees with an attitude (chosen)
ALIKE = 1.3  # times the least misfit, up to which another reading may be as good (chosen)
SURE = 30.0  # by how much chi squared must differ for a reading to be worse (chosen)
SHOWN = 12  # readings that are kept (chosen)
NAMED = 3.0  # doubt of what the names speak against (chosen)
STRANGE = 1.0  # doubt of what is unusual, where the data decide nothing (chosen)


@dataclass(frozen=True, slots=True)
class TableReading:
    """One whole reading of a table."""

    clock: ClockGuess
    attitude: AttitudeGuess | None
    gyro: GyroGuess | None
    frame: FrameGuess | None
    norm_sd: float = 0.0  # of the quaternions' lengths about one

    @property
    def handed(self) -> bool:
        """Say whether the gyro's axes, as they are read, came in a right-handed order."""
        if self.gyro is None:
            return True
        order = [sorted(self.gyro.columns).index(name) for name in self.gyro.columns]
        return bool(np.linalg.det(np.eye(3)[order] * np.array(self.gyro.signs)[:, None]) > 0)

    @property
    def doubt(self) -> float:
        """Return how unusual the reading is, for where the data decide nothing."""
        doubt = self.clock.doubt
        if self.attitude is not None:
            doubt += STRANGE * self.attitude.inverse
            doubt += STRANGE * (self.attitude.scalar in (1, 2))
            doubt += NAMED * (not self.attitude.named_as_read)
            doubt += STRANGE * (self.attitude.signs != (1, 1, 1)) + 0.1 * (
                self.attitude.sequence not in ("", "ZYX")
            )
        if self.gyro is not None:
            doubt += STRANGE * (self.gyro.signs != (1, 1, 1)) + STRANGE * (not self.handed)
            doubt += STRANGE * (not self.gyro.unit) + 0.5 * (not stem(self.gyro.columns))
        return doubt


@dataclass(frozen=True, slots=True)
class Ranked:
    """Readings: the likeliest first, then those as good by the data, then the next."""

    alike: tuple[TableReading, ...]  # one: it is decided
    runner_up: TableReading | None  # the best of those that the data speak against


def ranked(table: NumberTable) -> Ranked:
    """Return the readings of a table; none where it has no clock or no sensor."""
    clocks = clock_guesses(table)[:CLOCKS]
    readings = [r for clock in clocks for r in _readings(table, clock)]
    if not readings:
        return Ranked((), None)
    best = min(readings, key=_score)
    alike = [r for r in readings if _is_alike(r, best)]
    others = [r for r in readings if not _is_alike(r, best)]
    alike.sort(key=lambda r: (r.doubt, _score(r)))
    return Ranked(tuple(alike[:SHOWN]), min(others, key=_score, default=None))


def _score(reading: TableReading) -> float:
    """Return the misfit, a gyro that agrees before none."""
    misfit = 1.0 if reading.gyro is None else reading.gyro.misfit
    return misfit + 10.0 * max(0.0, reading.clock.doubt - 3.0)


def _is_alike(reading: TableReading, best: TableReading) -> bool:
    """Say whether the data leave a reading as likely as the best one."""
    if best.gyro is None or reading.gyro is None:
        return (best.gyro is None) == (reading.gyro is None)
    least = max(best.gyro.misfit, 1e-9)
    excess = reading.gyro.misfit / least - 1.0
    return excess < ALIKE - 1.0 or excess * 3 * best.gyro.spans < SURE


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
    t = table.column(clock.column) * clock.factor
    full = _usable(table, clock, columns)
    if full.sum() < 10:
        return
    part = NumberTable(table.names, table.values[full][:MOST_ROWS], table.units)
    others = [n for n in table.names if n not in (*columns, clock.column)]
    spans = spans_of(t[full][:MOST_ROWS], attitude_of(part, guesses[0]), part, others)
    norm = 0.0 if guesses[0].sequence else norm_sd(part, columns)
    for guess in guesses:
        q = attitude_of(part, guess)
        frame = frame_guesses(q)[0]
        gyros = gyro_guesses(spans.rates(q), spans)
        agreeing = [gyro for gyro in gyros[:24] if gyro.misfit < AGREES]
        for gyro in agreeing:
            yield TableReading(clock, guess, gyro, frame, norm)
        if not agreeing:
            yield TableReading(clock, guess, None, frame, norm)


def _usable(table: NumberTable, clock: ClockGuess, columns: tuple[str, ...]) -> Bools:
    values = np.stack([table.column(name) for name in columns], axis=1)
    t = table.column(clock.column)
    full = np.isfinite(values).all(axis=1) & np.isfinite(t)
    rows = np.flatnonzero(full)
    back = np.append(False, np.diff(t[rows]) <= 0)
    full[rows[back]] = False
    return full
