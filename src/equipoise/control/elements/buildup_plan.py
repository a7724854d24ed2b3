"""Which attitudes to hold, for how long: chosen by the predicted covariance.

A plan is a list of stages. Its samples are predicted on the reference attitudes, once a PLAN step
and without noise. The filter (``momentum_balance``) then has the covariance that the real one will
have, since that does not depend on the measured values.

Opposite tilts follow one another, so that the momentum which r_z and sag put in is taken out again.
Two sizes of tilt separate sag from r_z: both grow with the sine, and sag decreases with the cosine.
Tilts about one axis first and last separate both from drift. Of 226 orders of three or four pairs
of 10, 14 and 20 deg this one has the least covariance for a table of 14 kg with sag and drift.
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from equipoise.control.elements.momentum_balance import Book, Ledger, entered, opened
from equipoise.control.elements.slew import Pace, end_of, reference_at, slew, turned
from equipoise.control.law import Sample
from equipoise.maths.attitude import level, to_matrix
from equipoise.model.arrays import Quaternion, Vector3
from equipoise.model.testbed import Testbed

PLAN = 1.0  # s, chosen: between predicted samples
PROBE = float(np.radians(5))  # rad, chosen: the tilt that first shows r_z
SMALLER = 0.7  # chosen: the smaller tilt, see above
CATCH = 8.0  # s of each catch, chosen: r to 1 % of what would tilt the platform in that time


class Stage(NamedTuple):
    """One attitude, how long it is held, and whether masses move there."""

    turn: Vector3  # rad, from level, body axes
    seconds: float
    follows: bool  # masses follow the estimate


def stages_of(up: Vector3, tilt: float, hold: float) -> tuple[Stage, ...]:
    """Return catches and holds; opposite tilts follow one another, large ones and small ones."""
    x, y = to_matrix(level(up)).T[:, :2].T  # two axes across ``up``
    pairs = [tilt * x, tilt * y, SMALLER * tilt * y, tilt * x]
    turns = [turn * sign for turn in pairs for sign in (1.0, -1.0)]
    catches = [Stage(np.zeros(3), CATCH, True), Stage(PROBE * x, CATCH, True)]
    return (*catches, *(Stage(turn, hold, False) for turn in turns))


def samples_of(
    stages: tuple[Stage, ...], base: Quaternion, gravity: float, pace: Pace
) -> Iterator[Sample]:
    """Yield the predicted samples."""
    t, here, none = 0.0, base, np.zeros(3)
    for stage in stages:
        way = slew(here, turned(base, stage.turn), t, pace)
        end = end_of(way) + stage.seconds
        while t < end:
            at = reference_at(way, t)
            down = to_matrix(at.q).T @ np.array([0.0, 0.0, -gravity])
            yield Sample(t, at.q, at.rate, down, none, none, none, none, None)
            t += PLAN
        here = turned(base, stage.turn)


def foreseen(stages: tuple[Stage, ...], testbed: Testbed, book: Book, pace: Pace) -> Ledger:
    """Return the filter's state at the end of a plan; its covariance and times count."""
    samples = samples_of(stages, level(testbed.up), testbed.gravity, pace)
    ledger = opened(testbed, book, next(samples))
    for sample in samples:
        ledger = entered(ledger, sample, book)
    return ledger
