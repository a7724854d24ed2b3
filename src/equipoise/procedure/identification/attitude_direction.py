"""Which way a quaternion turns, where no gyro shows it: by which of two fits explains the motion.

An attitude read the other way round is a motion too, but not one of a body that gravity pulls:

    J w' + w x J w = m g com x n,      n = R^T e_z

holds for one direction alone. Both are fitted to windows of the record, without any prior, and
chi squared is compared. Motion without much turning about the vertical shows no difference.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from equipoise.estimation.output_error.fit_estimate import residual_of
from equipoise.estimation.output_error.fixed_parameters import settle_pinned
from equipoise.estimation.output_error.initial_guess import as_measured, start
from equipoise.estimation.output_error.solution import Fitted
from equipoise.estimation.output_error.trajectory import (
    Params,
    fit,
    held_names,
    nearer,
    problem_of,
)
from equipoise.maths.attitude import conjugate
from equipoise.model.finding import Finding
from equipoise.model.reasons.finding_reasons import FindingReason as Why
from equipoise.model.reasons.reason import one_reason
from equipoise.model.recording import Recording, Samples, arranged, window
from equipoise.model.testbed import Testbed

LONGEST = 60.0  # s of a window (chosen: several swings, before small torques have added up)
MOST = 6  # windows (chosen)
FEWEST = 50  # rows of a window (chosen)
SLACK, CHANCE = 0.1, 5.0  # above the stated noise, and sd of chance, up to which a fit explains
MOST_BY = 1e6  # by how much a window counts at most, so that each has its word (chosen)
SURE = 50.0  # by how much chi squared must differ in all (chosen)


@dataclass(frozen=True, slots=True)
class Direction:
    """How much better one direction explains the motion than the other."""

    excess: float  # of chi squared, as read over the other way round; 0: no window counts
    windows: int  # that counted

    @property
    def is_reversed(self) -> bool:
        """Say whether the attitude must be read the other way round."""
        return self.excess > SURE

    @property
    def is_sure(self) -> bool:
        """Say whether the data decide."""
        return abs(self.excess) > SURE


def reversed_attitude(recording: Recording) -> Recording:
    """Return a recording whose attitude is read the other way round."""
    attitude = recording.attitude
    if attitude is None:
        return recording
    return replace(recording, attitude=Samples(attitude.t, conjugate(attitude.values)))


def direction_of(recording: Recording, testbed: Testbed) -> Direction:
    """Return which direction of the attitude explains the motion of a fitted recording."""
    found = [_excess(part, testbed) for part in _windows(recording)]
    counted = [excess for excess in found if excess is not None]
    return Direction(float(np.sum(counted)), len(counted))


def direction_findings(recording: Recording, testbed: Testbed) -> list[Finding]:
    """Return an attitude that is read the wrong way round; with a gyro it is compared with that."""
    if recording.attitude is None or recording.rate is not None:
        return []
    found = direction_of(recording, testbed)
    if not found.is_reversed:
        return []
    reason = one_reason(Why.ATTITUDE_REVERSED, excess=found.excess)
    return [Finding("wrong", (*reason, *one_reason(Why.READ_INVERSE)))]


def _windows(recording: Recording) -> Iterator[Recording]:
    first, last = recording.span
    count = min(max(round((last - first) / LONGEST), 1), MOST)
    length = min((last - first) / count, LONGEST)
    for since in np.linspace(first, last - length, count):
        part = window(recording, float(since), float(since + length))
        if part.attitude is not None and len(part.attitude) >= FEWEST:
            yield part


def _excess(part: Recording, testbed: Testbed) -> float | None:
    """Return by how much chi squared as read exceeds the other way's; None if neither explains.

    What is found quickly decides, but for an attitude that then seems to be reversed: before that
    is believed the search as read is a whole one.
    """
    read, other = _quick(part, testbed), _quick(reversed_attitude(part), testbed)
    if _difference(read, other) > 0 and other.explains:
        read = min(read, _Misfit.of(fit(part, testbed, Params())), key=lambda m: m.chi_square)
    if not (read.explains or other.explains):
        return None
    return _difference(read, other)


@dataclass(frozen=True, slots=True)
class _Misfit:
    """What a fit leaves."""

    chi_square: float
    freedom: int  # degrees of it

    @property
    def reduced(self) -> float:
        """Return chi squared a degree of freedom."""
        return self.chi_square / self.freedom

    @property
    def explains(self) -> bool:
        """Say whether no more is left than the stated noise, and chance."""
        return self.reduced < 1.0 + SLACK + CHANCE * float(np.sqrt(2.0 / self.freedom))

    @staticmethod
    def of(fitted: Fitted) -> "_Misfit":
        residual = residual_of(fitted)
        square = residual.chi_square if np.isfinite(residual.chi_square) else np.inf
        return _Misfit(square, residual.degrees_of_freedom)


def _difference(read: _Misfit, other: _Misfit) -> float:
    """Return by how much chi squared is more as read, in units of the better fit's noise."""
    noise = max(min(read.reduced, other.reduced), 1.0)
    return float(np.clip((read.chi_square - other.chi_square) / noise, -MOST_BY, MOST_BY))


def _quick(part: Recording, testbed: Testbed) -> _Misfit:
    """Return what a fit leaves from where the linear methods and the rows begin."""
    params = Params()
    part = arranged(part, testbed.mass_names)
    problem = problem_of(part, testbed, params)
    first = float(problem.line.t[0])
    hold = held_names(part, testbed, params)
    linear = start(part, testbed, problem.layout, first, hold)
    point = nearer(problem, linear, as_measured(part, testbed, first, linear))
    return _Misfit.of(settle_pinned(problem, point))
