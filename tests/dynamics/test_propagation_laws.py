"""What mechanics promises of the motion: conserved quantities and textbook solutions.

Unless said otherwise, tolerances are the integrator's: steps of 0.05 s at 0.1 rad/s err by less
than (0.005)^5 = 3e-12 of the motion each, 4e-8 in 10 min.
"""

from dataclasses import dataclass

import numpy as np
import pytest
from scipy.integrate import simpson

from equipoise.actuators.sliding_masses import com_shift, inertia_shift
from equipoise.dynamics.propagation import body_of
from equipoise.dynamics.regressor import N_TORQUES
from equipoise.dynamics.timeline import timeline
from equipoise.maths.attitude import difference, exponential, logarithm, multiply, to_matrix
from equipoise.maths.linalg import unpack_symmetric
from equipoise.model.recording import Samples
from tests.support.builders import (
    ATTITUDE,
    COM,
    GRAVITY,
    INERTIA,
    MASS,
    RATE,
    body,
    line_of,
    maps,
    move_at,
    travel,
)

LEVEL = np.array([1.0, 0.0, 0.0, 0.0])
TEN_MINUTES = np.linspace(0, 600, 601)
DIAGONAL = np.array([0.3565, 0.5301, 0.8782, 0.0, 0.0, 0.0])
NONE = np.zeros(0)


@dataclass(frozen=True)
class Sums:
    """Quantities along a motion with the masses at home."""

    kinetic: np.ndarray
    potential: np.ndarray
    momentum_N: np.ndarray

    @property
    def energy(self):
        return self.kinetic + self.potential


def sums(motion) -> Sums:
    R, w = to_matrix(motion.q), motion.rate
    kinetic = 0.5 * np.einsum("ni,ij,nj->n", w, unpack_symmetric(INERTIA), w)
    potential = GRAVITY * MASS * (R @ COM)[:, 2]
    return Sums(kinetic, potential, np.einsum("nij,nj->ni", R, motion.momentum))


# --- Conservation -----------------------------------------------------------------------------


def test_energy_is_kept():
    """Ten minutes of swinging: constant to 1e-7 of the energy that goes to and fro."""
    found = sums(travel(line_of(TEN_MINUTES)))
    assert np.ptp(found.kinetic) > 1e-5  # J, it does go to and fro
    assert np.ptp(found.energy) < 1e-7 * np.ptp(found.kinetic)


@pytest.mark.parametrize("track", [None, move_at(100.0, 600.0)], ids=["fixed", "moving masses"])
def test_vertical_momentum_is_kept(track):
    """Gravity has no torque about the vertical, wherever masses are and however they travel."""
    motion = travel(line_of(TEN_MINUTES, track))
    H = sums(motion).momentum_N
    assert np.ptp(H[:, 0]) > 1e-3  # N m s, the others do change
    assert np.ptp(H[:, 2]) < 1e-9 * np.abs(H).max()


def test_momentum_vector_is_kept_without_gravity():
    """Masses travelling and wheels spinning up included: all of it is inside."""
    wheel = Samples(np.array([0.0, 50.0, 90.0]), np.outer([0, 0, 1], [3e-3, -1e-3, 2e-3]))
    line = timeline(np.linspace(0, 120, 241), NONE, move_at(60.0, 120.0), 3, 0.05, wheel)
    motion = travel(line, body_of(MASS, 0.0, INERTIA, MASS * COM))
    H = sums(motion).momentum_N
    assert np.ptp(motion.rate) > 1e-3  # rad/s, although the rate changes
    assert np.abs(H - H[0]).max() < 1e-10 * np.abs(H).max()


def test_momentum_is_continuous_where_travel_begins_and_the_rate_jumps():
    """At 60 s the masses set off at once: H stays, w jumps by -J^-1 h with h = sum m v rho x u."""
    short = 1e-6  # s
    line = line_of(np.array([0.0, 60.0 - short, 60.0, 61.0]), move_at(60.0, 120.0))
    motion = travel(line)
    before, after = line.attitude_node[1:3]
    np.testing.assert_allclose(motion.momentum[after], motion.momentum[before], atol=1e-8)
    h = np.array([-0.01, -0.01, -0.01]) @ maps().momentum
    jump = -np.linalg.solve(unpack_symmetric(INERTIA), h)
    assert np.linalg.norm(jump) > 1e-5
    np.testing.assert_allclose(motion.rate[after] - motion.rate[before], jump, atol=1e-8)


def test_after_a_move_the_platform_is_the_moved_one():
    """From the end of the travel on, it swings as a body with the new J and mu would."""
    d = np.array([-0.01, -0.01, -0.05])
    t = np.array([0.0, 65.0, 120.0])
    line = line_of(t, move_at(60.0, 120.0))
    moved = travel(line)
    at = line.attitude_node[1]
    com = COM + com_shift(maps(), MASS, d)
    there = body_of(MASS, GRAVITY, INERTIA + inertia_shift(maps(), d), MASS * com)
    alone = travel(line_of(t[1:]), there, q0=moved.q[at], w0=moved.rate[at])
    assert np.linalg.norm(difference(alone.q[-1], moved.q[-1])) < 1e-10


def test_drag_does_the_work_that_is_missing():
    """E(end) - E(0) = -integral of w.c w, by Simpson at 0.05 s: errors of 1e-9 of it."""
    c = np.array([2e-3, 1e-3, 3e-3])
    line = line_of(np.linspace(0, 120, 2401))
    motion = travel(line, body(np.append(c, np.zeros(N_TORQUES - 3))))
    work = simpson(-np.sum(c * motion.rate**2, axis=1), x=line.t)
    energy = sums(motion).energy
    assert work < -1e-6  # J
    assert energy[-1] - energy[0] == pytest.approx(work, rel=1e-7)


# --- Textbook motions -------------------------------------------------------------------------


def test_constant_spin_about_the_vertical():
    """Level, the centre below P, a principal axis vertical: nothing disturbs the spin."""
    rigid = body_of(MASS, GRAVITY, DIAGONAL, MASS * np.array([0, 0, -79e-6]))
    spin = np.array([0.0, 0.0, 0.2])
    t = np.linspace(0, 60, 61)
    motion = travel(line_of(t, None, 1 / 20), rigid, q0=LEVEL, w0=spin)
    np.testing.assert_allclose(motion.rate[:, 2], 0.2, rtol=1e-12)
    np.testing.assert_allclose(motion.rate[:, :2], 0.0, atol=1e-18)
    at = line_of(t, None, 1 / 20).attitude_node
    expected = exponential(t[:, None] * spin)
    np.testing.assert_allclose(difference(motion.q[at], expected), 0.0, atol=1e-9)


@pytest.mark.parametrize("axis", [0, 1])
def test_small_swing_has_the_pendulum_period(axis):
    """T = 2 pi sqrt(J / (m g |r_z|)); an amplitude of 1e-3 rad lengthens it by 6e-8."""
    depth, release = 79e-6, np.zeros(3)
    release[axis] = 1e-3
    rigid = body_of(MASS, GRAVITY, DIAGONAL, MASS * np.array([0, 0, -depth]))
    line = line_of(np.linspace(0, 400, 8001))
    motion = travel(line, rigid, q0=exponential(release), w0=np.zeros(3))
    angle = logarithm(motion.q)[:, axis]
    down = np.flatnonzero((angle[:-1] > 0) & (angle[1:] <= 0))
    crossed = line.t[down] + 0.05 * angle[down] / (angle[down] - angle[down + 1])
    period = np.mean(np.diff(crossed))
    assert len(down) > 5
    assert period == pytest.approx(
        2 * np.pi * np.sqrt(DIAGONAL[axis] / (MASS * GRAVITY * depth)), rel=1e-4
    )


def test_axisymmetric_top_precesses_in_the_body():
    """Without gravity w_1 + i w_2 turns at (J3 - J1)/J1 w3 about the axis of symmetry."""
    J1, J3 = 0.4, 0.7
    rigid = body_of(MASS, 0.0, np.array([J1, J1, J3, 0, 0, 0]), MASS * COM)
    line = line_of(np.linspace(0, 60, 601))
    motion = travel(line, rigid, q0=ATTITUDE, w0=np.array([0.05, 0.0, 0.3]))
    angle = (J3 - J1) / J1 * 0.3 * line.t
    expected = 0.05 * np.column_stack([np.cos(angle), np.sin(angle)])
    np.testing.assert_allclose(motion.rate[:, :2], expected, atol=1e-9)
    np.testing.assert_allclose(motion.rate[:, 2], 0.3, atol=1e-12)


def about_z(momentum=None, torque=None):
    """A balanced platform at rest, level, with inputs about z; the rate about z and the times."""
    line = timeline(np.linspace(0, 30, 301), NONE, None, 3, 0.1, momentum, torque)
    rigid = body_of(MASS, GRAVITY, DIAGONAL, np.zeros(3))
    return line.t, travel(line, rigid, q0=LEVEL, w0=np.zeros(3)).rate[:, 2]


def test_wheel_spinning_up_turns_the_platform_the_other_way():
    """h from 0 to 6e-3 N m s between 10 and 20 s: w_z = -h / J_zz throughout."""
    wheel = Samples(np.array([0.0, 10, 20]), np.outer([0, 0, 6e-3], [0, 0, 1]))
    t, rate = about_z(momentum=wheel)
    expected = -np.interp(t, [10, 20], [0, 6e-3]) / DIAGONAL[2]
    np.testing.assert_allclose(rate, expected, atol=1e-14)


def test_wheel_already_spinning_does_not_turn_a_platform_at_rest():
    """The first rate is the platform's own: a constant h about the vertical has no effect."""
    wheel = Samples(np.array([0.0, 30]), np.outer([1, 1], [0, 0, 6e-3]))
    np.testing.assert_allclose(about_z(momentum=wheel)[1], 0.0, atol=1e-15)


def test_known_torque_speeds_the_platform_up():
    """tau = 1e-4 N m from 10 s on, ramped down to 0 by 20 s: w_z = integral / J_zz."""
    push = Samples(np.array([0.0, 10, 20]), np.outer([1e-4, 1e-4, 0], [0, 0, 1]))
    t, rate = about_z(torque=push)
    late = np.clip(t - 10, 0, 10)
    integral = 1e-4 * (np.minimum(t, 10) + late - late**2 / 20)
    np.testing.assert_allclose(rate, integral / DIAGONAL[2], atol=1e-13)


def test_drift_moves_the_centre_of_mass_linearly():
    """Level, balanced, at rest; r_y = c t tips by -m g c t about x: w_x = -m g c t^2 / (2 J_xx).

    0.1 nm/s tips it by 2e-4 rad in 30 s; the next terms are of order (angle)^2 = 3e-8.
    """
    c, torque = 1e-10, np.zeros(N_TORQUES)
    torque[14] = c
    rigid = body_of(MASS, GRAVITY, DIAGONAL, np.zeros(3), torque)
    line = line_of(np.linspace(0, 30, 61))
    rate = travel(line, rigid, q0=LEVEL, w0=np.zeros(3)).rate
    expected = -MASS * GRAVITY * c * line.t**2 / (2 * DIAGONAL[0])
    np.testing.assert_allclose(rate[:, 0], expected, rtol=1e-6, atol=1e-15)
    np.testing.assert_allclose(rate[:, 1], 0.0, atol=1e-12)


def test_time_of_drift_counts_from_the_start_of_the_record():
    """A record that begins at 1e5 s drifts as one that begins at 0."""
    torque = np.zeros(N_TORQUES)
    torque[13:16] = 1e-8, -2e-8, 3e-8
    t = np.linspace(0, 60, 61)
    early, late = (travel(line_of(t + start), body(torque)) for start in (0.0, 1e5))
    np.testing.assert_allclose(late.q, early.q, rtol=0, atol=1e-9)  # 1e5 s holds 1e-11 s


def test_heading_does_not_matter():
    """Turning the laboratory about the vertical turns the motion and changes nothing else."""
    turn = exponential(np.array([0, 0, 1.3]))
    line = line_of(np.linspace(0, 60, 61))
    plain, turned = travel(line), travel(line, q0=multiply(turn, ATTITUDE), w0=RATE)
    np.testing.assert_allclose(turned.rate, plain.rate, atol=1e-13)
    np.testing.assert_allclose(turned.q, multiply(turn, plain.q), atol=1e-12)
