"""Masses that follow a platform's tilt and its drift, once a law has found sag and drift.

Masses that stand still leave the part of the sag that no centre of mass trims
(``dynamics.sag_trim``). With n = g_B / g, masses that shift the centre of mass by

    s(n, t) = s_0 - d (t - t_0) - (E - n n^T)(trim + C n)

compensate it: m g (r + s + C n) x n = m g target x n. A shift along n gives no torque and is left
out, so the shift is the least that does it: 0.17 um at 20 deg for a deck that sinks by 25 um.

Wheels or gyros hold the platform meanwhile, level and at its heading: one that is balanced in every
attitude stays in none by itself.

Nothing is estimated here: errors of C and d remain.
"""

from dataclasses import dataclass, field, replace

from equipoise.control.elements import slew as slews
from equipoise.control.elements.attitude_pid import Gains, Pid, gains_for, torque, unwound
from equipoise.control.law import Law, Sample
from equipoise.control.plant.wheel_capacity import capacity
from equipoise.dynamics.sag_trim import trimming_shift
from equipoise.model.arrays import Vector3
from equipoise.model.command import Command
from equipoise.model.estimate import Estimate
from equipoise.model.following import Following
from equipoise.model.law_card import LawCard
from equipoise.model.reasons.law_reasons import LawReason
from equipoise.model.reasons.reason import one_reason
from equipoise.model.testbed import Testbed

PERIOD = 0.1  # s, chosen: a servo's beat

CARD = LawCard(
    "follow",
    ("Moves masses with the tilt and the estimated drift, while wheels hold the platform level."),
    "Equipoise; the sag that dynamics.sag_trim cannot trim",
    ("masses", "momentum", "gyro", "attitude"),
    "the errors of the estimated sag and drift",
    "masses open loop: always; wheels that can hold the residual torque",
    PERIOD,
)


@dataclass(frozen=True, slots=True, eq=False)
class Params:
    """The sag and drift to follow, until when (s), and the attitude loop."""

    following: Following
    end: float
    target: Vector3  # m
    testbed: Testbed
    gains: Gains
    pace: slews.Pace


@dataclass(frozen=True, slots=True, eq=False)
class State:
    """The state of the attitude loop, and the turn to level."""

    pid: Pid = field(default_factory=unwound)
    way: slews.Slew | None = None


def shift_at(following: Following, down: Vector3, t: float) -> Vector3:
    """Return the shift (m) that is wanted with gravity along ``down`` (unit, body axes) at t, s."""
    moved: Vector3 = following.shift - following.drift * (t - following.t)
    return moved + trimming_shift(following.sag, following.trim, down)


def step(state: State, sample: Sample | Estimate, params: Params) -> tuple[State, Command]:
    """Return the state and the command: the shift for this attitude and time, and the torque."""
    assert isinstance(sample, Sample)  # it requests no measurement
    bed, down = params.testbed, sample.gravity / params.testbed.gravity
    if state.way is None:
        state = replace(
            state, way=slews.slew(sample.q, slews.levelled(sample.q, bed.up), sample.t, params.pace)
        )
    assert state.way is not None
    reference = slews.reference_at(state.way, sample.t)
    weight = bed.body.mass * params.target
    pid, u = torque(state.pid, sample, reference, params.gains, weight)
    over = one_reason(LawReason.FOLLOWED) if sample.t >= params.end else ()
    shift = shift_at(params.following, down, sample.t)
    return replace(state, pid=pid), Command(shift=shift, torque=u, finished=over)


def following_law(following: Following, end: float) -> Law[State, Params]:
    """Return the law that follows sag and drift until a time, s."""

    def begin(testbed: Testbed, target: Vector3) -> tuple[State, Params]:
        can, J = capacity(testbed), testbed.body.inertia_P
        pace = slews.pace_for(slews.moment_across(J, testbed.up), can)
        return State(), Params(following, end, target, testbed, gains_for(J, can.torque), pace)

    return Law(CARD, begin, step)
