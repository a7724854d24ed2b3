"""Whether gyro and attitude show the same rotation: direction, axes, signs, scale, zero.

Sums of turns from attitude to attitude are compared with integrals of the gyro
(``hypotheses.gyros``). As it is read the gyro competes with every order and sign of its axes, and
with the attitude turned the other way. What is much better is what is the matter, unless a delay
explains as much: in a steady precession a quarter of a period looks like other axes.
"""

from dataclasses import dataclass

import numpy as np

from equipoise.assessment.hypotheses.gyros import GyroGuess, Spans, gyro_guesses, span_rows
from equipoise.assessment.record_checks.clock_offset import ClockOffset
from equipoise.assessment.record_checks.gyro_consistency import (
    FEWEST,
    across_gap,
    integral,
    rate_pairs,
    repeats,
)
from equipoise.maths.attitude import conjugate
from equipoise.model.arrays import Series1, Series3
from equipoise.model.finding import Finding
from equipoise.model.reasons.finding_reasons import FindingReason as Why
from equipoise.model.reasons.reason import Reason, axes_of, one_reason
from equipoise.model.recording import Samples
from equipoise.model.units import DEG

NAMES = ("x", "y", "z")
RELATED = 0.5  # misfit up to which a gyro shows the attitude's turning (chosen)
CLEAR = 0.05  # misfit up to which another reading is believed (chosen)
BETTER = 4.0  # times the least misfit, from which what is read is wrong (chosen)
SURE = 100.0  # and by how much chi squared must differ (chosen: it counts systematic errors too)
OFF = 0.2  # of the scale, before it is reported (chosen: no gyro's scale is this wrong)
UNIT = 2.0  # times, from which a scale is another unit (chosen)
SHOWS = 20.0  # times the residual, by which an axis must turn for its scale to be judged (chosen)
MOVES = 3.0  # times, of the attitude's sums over the gyro's misfit where nothing agrees (chosen)
ZERO_OFF = 0.05 * DEG  # rad/s: a zero worth a finding (chosen)


def rotation_findings(
    attitude: Samples | None, rate: Samples | None, offset: ClockOffset | None
) -> list[Finding]:
    """Return what is wrong with the gyro against the attitude, or that they agree.

    ``offset`` is the delay that both show.
    """
    if attitude is None or rate is None or min(len(attitude), len(rate)) < FEWEST:
        return []
    camera, gyro = rate_pairs(attitude, rate)
    if len(camera) < FEWEST:
        return [Finding("problem", one_reason(Why.NO_OVERLAP))]
    if repeats(camera, gyro):
        return [Finding("problem", one_reason(Why.RATES_DERIVED))]
    compared = _compared(attitude, rate, offset)
    if compared is None:
        return [Finding("content", one_reason(Why.TOO_LITTLE_MOTION))]
    wrong = compared.wrong()
    if wrong:
        return [wrong]
    return [*compared.scales(), *_agreement(compared, camera, gyro)]


@dataclass(frozen=True, slots=True, eq=False)
class _Compared:
    """Sums of turns and integrals of the gyro, and how the best of all readings relates them."""

    turns: Series3  # rad
    integrals: Series3  # rad
    best: GyroGuess
    inverse: bool  # the best turns the attitude the other way

    @property
    def as_read(self) -> float:
        """Return the misfit of the gyro as it is read, its common factor free."""
        common = float(np.sum(self.turns * self.integrals))
        power = float(np.sum(self.turns**2)) * float(np.sum(self.integrals**2))
        return 1.0 - max(common, 0.0) ** 2 / power

    def is_worse(self) -> bool:
        """Say whether another reading explains much more than the one that is taken."""
        least = max(self.best.misfit, 1e-9)
        excess = (self.as_read / least - 1.0) * 3 * len(self.turns)
        return least < CLEAR and self.as_read > BETTER * least and excess > SURE

    def wrong(self) -> Finding | None:
        """Return what is wrong and what mends it; None if nothing is."""
        if self.as_read > RELATED and self.best.misfit > CLEAR:
            return Finding("problem", one_reason(Why.NO_RELATION, unexplained=self.as_read))
        if not self.is_worse():
            return self._other_unit()
        found: list[Reason] = []
        if self.inverse:
            found += [*one_reason(Why.ATTITUDE_INVERSE), *one_reason(Why.READ_INVERSE)]
        if (self.best.order, self.best.signs) != ((0, 1, 2), (1, 1, 1)):
            axes = self._axes()
            quoted = [f'"{axis}"' for axis in axes]
            found += [*one_reason(Why.GYRO_AXES, *axes), *one_reason(Why.READ_AXES, *quoted)]
        return Finding("wrong", tuple(found))

    def _axes(self) -> list[str]:
        """Return our axes in terms of the gyro's."""
        pairs = zip(self.best.order, self.best.signs, strict=True)
        return [("" if sign > 0 else "-") + NAMES[k] for k, sign in pairs]

    def _other_unit(self) -> Finding | None:
        scale = self.scale
        if 1 / UNIT < scale < UNIT:
            return None
        unit = one_reason(Why.OTHER_UNIT, scale=scale)
        return Finding("wrong", (*unit, *one_reason(Why.READ_UNIT)))

    @property
    def scale(self) -> float:
        """Return the gyro's common scale against the attitude's."""
        return float(np.sum(self.integrals**2) / np.sum(self.turns * self.integrals))

    def shown(self) -> list[int]:
        """Return the axes that turn enough for their scale to be judged."""
        left = self.turns - self.integrals / self.scale
        noise = float(np.mean(left**2))
        return [k for k in range(3) if float(np.mean(self.turns[:, k] ** 2)) > SHOWS * noise]

    def scales(self) -> list[Finding]:
        """Return the axes whose scale is off."""
        found: list[Finding] = []
        for k in self.shown():
            gyro, turn = self.integrals[:, k], self.turns[:, k]
            scale = float(gyro @ gyro) / float(gyro @ turn)
            if abs(scale - 1) > OFF:
                found.append(Finding("problem", one_reason(Why.OTHER_SCALE, NAMES[k], scale=scale)))
        return found


def _compared(attitude: Samples, rate: Samples, offset: ClockOffset | None) -> _Compared | None:
    """Return the comparison, at the delay that both show if that explains more; None if none can.

    Without a delay another reading may explain as much, and is the likelier.
    """
    prompt = _at_delay(attitude, rate, 0.0)
    if prompt is None or offset is None:
        return prompt
    late = _at_delay(attitude, rate, offset.lag)
    return late if late is not None and late.as_read < prompt.best.misfit else prompt


def _at_delay(attitude: Samples, rate: Samples, late: float) -> _Compared | None:
    spans = _spans(attitude, Samples(rate.t + late, rate.values))
    if spans is None:
        return None
    columns = spans.integrals()
    if set(columns) != set(NAMES):
        return None  # a dead axis, which has a finding of its own
    q = attitude.values
    found = [
        (guess, inverse)
        for inverse, turns in ((False, spans.turns(q)), (True, spans.turns(conjugate(q))))
        for guess in gyro_guesses(turns, columns)[:1]
    ]
    if not found:
        return None
    best, inverse = min(found, key=lambda each: (each[0].misfit, each[1]))
    integrals = np.stack([columns[name] for name in NAMES], axis=1)
    return _Compared(spans.turns(q), integrals, best, inverse)


def _spans(attitude: Samples, rate: Samples) -> Spans | None:
    """Return spans between attitudes that the gyro covers, with its means; None for too few."""
    starts, lag = span_rows(attitude.t, attitude.values)
    start, end = attitude.t[starts], attitude.t[starts + lag]
    use = (start >= rate.t[0]) & (end <= rate.t[-1]) & ~across_gap(rate, start, end)
    use &= end - start < 2 * np.median(end - start)
    if use.sum() < FEWEST:
        return None
    starts, duration = starts[use], (end - start)[use]
    means = (integral(rate, end[use]) - integral(rate, start[use])) / duration[:, None]
    named: dict[str, Series1] = {n: c for n, c in zip(NAMES, means.T, strict=True) if np.ptp(c) > 0}
    return Spans(starts, lag, duration, named)


def _agreement(compared: _Compared, camera: Series3, gyro: Series3) -> list[Finding]:
    """Return about which axes the two agree, and the gyro's zero."""
    offset = np.median(gyro - camera, axis=0)
    shown = [NAMES[k] for k in compared.shown()]
    agree = one_reason(Why.SENSORS_AGREE, *shown) if shown else one_reason(Why.TOO_LITTLE_MOTION)
    found = [Finding("content", agree)]
    if np.abs(offset).max() > ZERO_OFF:
        found.append(Finding("content", one_reason(Why.GYRO_ZERO, **axes_of("zero", offset))))
    return found
