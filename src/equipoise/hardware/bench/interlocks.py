"""The interlocks that stop every motor and device, evaluated at every turn, whoever commands.

    tilt, rate      the median of the last three rows is beyond its limit
    silence         a sensor has given no row of a channel, or a board no answer, for too long
    travel, speed   a mass is beyond its travel, or faster than it can be
    mismatch        a mass stands elsewhere than where it was sent
    fault           a board or an actuator says that something is wrong
    following       a device does not do what it is driven to, or is beyond its limit

``model.reasons.interlocks`` has them all, those of a bench that does not start among them.

A sensor that falls silent stops masses that move and devices that give a torque; while they rest
nothing needs to be stopped, and it may come back. Tilt and rate stop nothing where no board knows
its masses' places yet and no device works, or there is none: who only records is not disturbed.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from statistics import median

import numpy as np

from equipoise.hardware.transport.driver_protocol import (
    Activity,
    ActuatorState,
    BoardState,
    Phase,
)
from equipoise.maths.attitude import conjugate, multiply, tilt
from equipoise.model.arrays import Floats
from equipoise.model.hardware import Gives, SafetyLimits
from equipoise.model.reasons.interlocks import Interlock
from equipoise.model.reasons.reason import Reason
from equipoise.model.testbed import SlidingMass, Testbed

TENTHS = 1  # decimals of a silence, chosen: what says more often says nothing more
LAST = 3  # rows whose median counts, chosen: one bad row is no reason to stop
HASTE = 1.5  # of a mass's speed, chosen: beyond it, it does not follow its commands
WAY = 1e-3  # m, chosen: a way long enough to compute a speed from two answers of a board


@dataclass(frozen=True, slots=True, eq=False)
class Observed:
    """What the interlocks evaluate."""

    t: float  # s, now
    attitudes: Sequence[tuple[float, Floats]] = ()  # the last rows: s, quaternion
    rates: Sequence[tuple[float, Floats]] = ()  # the last rows: s, rad/s
    silent: Mapping[tuple[str, Gives], float] = field(  # s, by sensor and channel
        default_factory=dict[tuple[str, Gives], float]
    )
    boards: Mapping[str, BoardState] = field(default_factory=dict[str, BoardState])
    before: Mapping[str, tuple[float, float]] = field(  # s, m: an earlier answer, by mass
        default_factory=dict[str, tuple[float, float]]
    )
    actuators: Mapping[str, ActuatorState] = field(default_factory=dict[str, ActuatorState])
    deviation: Reason | None = None  # the first device that does not do what it is driven to

    @property
    def able(self) -> bool:
        """Say whether any mass or device could act, so that there is something to stop."""
        working = any(each.activity is Activity.WORKING for each in self.actuators.values())
        return working or self.moving or any(state.sure for state in self.boards.values())

    @property
    def moving(self) -> bool:
        """Say whether any mass may be on its way, or a device turn the platform."""
        acting = any(each.active for each in self.actuators.values())
        return acting or any(
            state.phase in (Phase.MOVING, Phase.HOMING) for state in self.boards.values()
        )


def tripped(observed: Observed, testbed: Testbed, limits: SafetyLimits) -> Reason | None:
    """Return the first reason to stop every motor; None if there is none."""
    return (
        _fault(observed)
        or (_leaning(observed, testbed) or _turning(observed, limits) if observed.able else None)
        or (silence(observed, limits) if observed.moving else None)
        or _masses(observed, testbed, limits)
    )


def silence(observed: Observed, limits: SafetyLimits) -> Reason | None:
    """Return which sensor gives no rows of what, whether masses move or not."""
    for (name, channel), since in observed.silent.items():
        if since > limits.stale:
            return Reason(Interlock.SILENCE, (name, channel), {"seconds": round(since, TENTHS)})
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


def _fault(observed: Observed) -> Reason | None:
    for name, state in observed.boards.items():
        if state.phase is Phase.FAULT:
            return Reason(Interlock.FAULT, (name, state.sentence))
    for name, state in observed.actuators.items():
        if state.activity is Activity.FAULT:
            return Reason(Interlock.DEVICE_FAULT, (name, state.sentence))
    return observed.deviation


def _leaning(observed: Observed, testbed: Testbed) -> Reason | None:
    if not observed.attitudes:
        return None
    q = np.array([attitude for _, attitude in observed.attitudes[-LAST:]])
    angle, limit = median(tilt(q, testbed.up).tolist()), testbed.tilt_limit
    if angle <= limit:
        return None
    return Reason(Interlock.TILT, (), {"tilt": angle, "limit": limit})


def _turning(observed: Observed, limits: SafetyLimits) -> Reason | None:
    rate = turning(observed)
    if rate <= limits.rate:
        return None
    return Reason(Interlock.RATE, (), {"rate": rate, "limit": limits.rate})


def _masses(observed: Observed, testbed: Testbed, limits: SafetyLimits) -> Reason | None:
    for state in observed.boards.values():
        if not state.sure or state.phase is Phase.HOMING:
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


def _outside(mass: SlidingMass, at: float, limits: SafetyLimits) -> Reason | None:
    low, high = mass.travel
    if low - limits.mismatch <= at <= high + limits.mismatch:
        return None
    return Reason(Interlock.TRAVEL, (mass.name,), {"at": at, "low": low, "high": high})


def _hasty(observed: Observed, mass: SlidingMass, at: float, state: BoardState) -> Reason | None:
    """Two answers may be read late by different times; so a short way determines no speed."""
    t, where = observed.before.get(mass.name, (0.0, at))
    if state.reported is None or abs(at - where) < WAY or state.reported <= t:
        return None
    speed = abs(at - where) / (state.reported - t)
    if speed <= HASTE * mass.speed:
        return None
    return Reason(Interlock.SPEED, (mass.name,), {"speed": speed, "limit": mass.speed})


def _elsewhere(
    mass: SlidingMass, at: float, state: BoardState, limits: SafetyLimits
) -> Reason | None:
    goal = state.goal.get(mass.name)
    if state.phase is not Phase.READY or goal is None or abs(at - goal) <= limits.mismatch:
        return None
    return Reason(Interlock.MISMATCH, (mass.name,), {"at": at, "goal": goal})
