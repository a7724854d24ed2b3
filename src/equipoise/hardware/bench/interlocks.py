"""When every motor is stopped: one place, asked at every turn, whoever commands.

    tilt, rate      the median of the last three rows is beyond its limit
    silence         a sensor has given no row, or a board no answer, for too long
    travel, speed   a mass is beyond its travel, or faster than it can be
    mismatch        a mass stands elsewhere than where it was sent
    fault           a board says that something is wrong
    operator        a person, or the loss of who commands

A sensor that falls silent stops masses that move; while they stand nothing needs to be stopped,
and it may come back. Tilt and rate stop nothing where no board knows its masses' places yet, or
there is no board: who only records is not disturbed.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from statistics import median
from typing import Literal

import numpy as np

from equipoise.hardware.transport.driver_protocol import BoardState
from equipoise.maths.attitude import conjugate, multiply, tilt
from equipoise.model.arrays import Floats
from equipoise.model.bench_units import MM, PER_DEG
from equipoise.model.hardware import SafetyLimits
from equipoise.model.testbed import SlidingMass, Testbed

Kind = Literal["tilt", "rate", "silence", "travel", "speed", "mismatch", "fault", "operator"]
LAST = 3  # rows whose median counts, chosen: one bad row is no reason to stop
HASTE = 1.5  # of a mass's speed, chosen: beyond it, it does not do as it is told
WAY = 1e-3  # m, chosen: a way on which a speed can be told from two answers of a board


@dataclass(frozen=True, slots=True)
class Trip:
    """Why every motor is stopped."""

    kind: Kind
    sentence: str


@dataclass(frozen=True, slots=True, eq=False)
class Observed:
    """What is looked at."""

    t: float  # s, now
    attitudes: Sequence[tuple[float, Floats]] = ()  # the last rows: s, quaternion
    rates: Sequence[tuple[float, Floats]] = ()  # the last rows: s, rad/s
    silent: Mapping[str, float] = field(default_factory=dict[str, float])  # s, by sensor
    boards: Mapping[str, BoardState] = field(default_factory=dict[str, BoardState])
    before: Mapping[str, tuple[float, float]] = field(  # s, m: an earlier answer, by mass
        default_factory=dict[str, tuple[float, float]]
    )

    @property
    def able(self) -> bool:
        """Say whether any mass could be moved, so that there is something to stop."""
        return self.moving or any(state.sure for state in self.boards.values())

    @property
    def moving(self) -> bool:
        """Say whether any mass may be on its way."""
        return any(state.phase in ("moving", "homing") for state in self.boards.values())


def tripped(observed: Observed, testbed: Testbed, limits: SafetyLimits) -> Trip | None:
    """Return the first reason to stop every motor; None if there is none."""
    return (
        _fault(observed)
        or (_leaning(observed, testbed) or _turning(observed, limits) if observed.able else None)
        or _silence(observed, limits)
        or _masses(observed, testbed, limits)
    )


def silence(observed: Observed, limits: SafetyLimits) -> Trip | None:
    """Return which sensor gives no rows, whether masses move or not."""
    for name, since in observed.silent.items():
        if since > limits.stale:
            return Trip("silence", f"sensor {name} has given no row for {since:.1f} s")
    return None


def turning(observed: Observed) -> float:
    """Return how fast the platform turns, rad/s; from attitudes where there is no gyro."""
    if observed.rates:
        return median(math.hypot(*rate) for _, rate in observed.rates[-LAST:])
    if len(observed.attitudes) < LAST:
        return 0.0
    (t0, q0), (t1, q1) = observed.attitudes[-LAST], observed.attitudes[-1]
    turned = multiply(conjugate(q0), q1)
    return float(2 * np.arctan2(np.linalg.norm(turned[1:]), abs(turned[0])) / (t1 - t0))


def _fault(observed: Observed) -> Trip | None:
    for name, state in observed.boards.items():
        if state.phase == "fault":
            return Trip("fault", f"board {name}: {state.sentence}")
    return None


def _leaning(observed: Observed, testbed: Testbed) -> Trip | None:
    if not observed.attitudes:
        return None
    q = np.array([attitude for _, attitude in observed.attitudes[-LAST:]])
    angle, limit = median(tilt(q, testbed.up).tolist()), testbed.tilt_limit
    if angle <= limit:
        return None
    found = f"the platform tilts by {PER_DEG * angle:.1f} deg"
    return Trip("tilt", f"{found}; its limit is {PER_DEG * limit:.1f} deg")


def _turning(observed: Observed, limits: SafetyLimits) -> Trip | None:
    rate = turning(observed)
    if rate <= limits.rate:
        return None
    found = f"the platform turns with {PER_DEG * rate:.1f} deg/s"
    return Trip("rate", f"{found}; the limit is {PER_DEG * limits.rate:.1f} deg/s")


def _silence(observed: Observed, limits: SafetyLimits) -> Trip | None:
    return silence(observed, limits) if observed.moving else None


def _masses(observed: Observed, testbed: Testbed, limits: SafetyLimits) -> Trip | None:
    for state in observed.boards.values():
        if not state.sure or state.phase == "homing":
            continue
        for name, at in state.position.items():
            mass = testbed.mass_named(name)
            trip = (
                _outside(mass, at, limits)
                or _hasty(observed, mass, at, state)
                or _elsewhere(mass, at, state, limits)
            )
            if trip is not None:
                return trip
    return None


def _outside(mass: SlidingMass, at: float, limits: SafetyLimits) -> Trip | None:
    low, high = mass.travel
    if low - limits.mismatch <= at <= high + limits.mismatch:
        return None
    found = f"mass {mass.name} is at {MM * at:.1f} mm"
    return Trip("travel", f"{found}; its travel is {MM * low:g} to {MM * high:g} mm")


def _hasty(observed: Observed, mass: SlidingMass, at: float, state: BoardState) -> Trip | None:
    """Two answers may be read late by different times; so a way that is short tells nothing."""
    t, where = observed.before.get(mass.name, (0.0, at))
    if state.reported is None or abs(at - where) < WAY or state.reported <= t:
        return None
    speed = abs(at - where) / (state.reported - t)
    if speed <= HASTE * mass.speed:
        return None
    found = f"mass {mass.name} moves with {MM * speed:.1f} mm/s"
    return Trip(
        "speed", f"{found}; it was told {MM * mass.speed:g} mm/s at most, or its board is misheard"
    )


def _elsewhere(
    mass: SlidingMass, at: float, state: BoardState, limits: SafetyLimits
) -> Trip | None:
    goal = state.goal.get(mass.name)
    if state.phase != "ready" or goal is None or abs(at - goal) <= limits.mismatch:
        return None
    found = f"mass {mass.name} stands at {MM * at:.2f} mm"
    return Trip("mismatch", f"{found} and was sent to {MM * goal:.2f} mm")
