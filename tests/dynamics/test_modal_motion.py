"""A platform with modes: conservation, numbers worked by hand, and agreement with a rigid one."""

import numpy as np
import pytest

from equipoise.dynamics.modal_inputs import ModalInputs, summed
from equipoise.dynamics.modal_motion import begun, follow_modes, modes_of
from equipoise.dynamics.propagation import body_of, rigid_body
from equipoise.maths.attitude import to_matrix
from equipoise.model.mass_properties import MassProperties
from equipoise.model.modes import Mode, freed, held
from equipoise.model.recording import Samples

UP, GRAVITY, MASS = np.array([0.0, 0.0, 1.0]), 9.81, 10.0
J = np.array([[1.0, 0.02, -0.03], [0.02, 2.0, 0.05], [-0.03, 0.05, 2.5]])
COM = np.array([1e-4, -5e-5, -2e-4])
RATE = np.array([0.02, -0.03, 0.05])
NO_MASSES = np.zeros((0, 18))


def packed(inertia):
    return inertia[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]


def followed(modes, com=COM, rate=RATE, span=30.0, gravity=GRAVITY):
    """Return times, motion and the kernels' modes of a platform that begins a little tilted."""
    body = body_of(MASS, gravity, packed(J), MASS * com)
    q = np.array([1.0, 0.02, 0.03, 0.0])
    H = J @ rate + sum((m.coupling * m.velocity for m in modes), np.zeros(3))
    y = np.concatenate([q / np.linalg.norm(q), H, begun(modes, rate)])
    t = np.linspace(0.0, span, 601)
    kernel_modes = modes_of(modes, UP, gravity)
    return t, follow_modes(body, NO_MASSES, kernel_modes, y, t, np.zeros((601, 7))), kernel_modes


def energy_of(found, mode, level):
    """Return T + 1/2 W^2 e^2 - (mu + s e).g_B + e s.g_0, and e'."""
    w, e, p = found.rate, found.y[:, 7], found.y[:, 8]
    along = p - w @ mode.coupling
    g = -GRAVITY * to_matrix(found.y[:, :4])[:, 2, :]
    kinetic = 0.5 * np.einsum("ni,ij,nj->n", w, J, w) + along * (w @ mode.coupling)
    spring = 0.5 * (mode.angular_frequency * e) ** 2
    lifted = g @ (MASS * COM) + e * ((g - np.array(level)) @ mode.moment)
    return kinetic + 0.5 * along**2 + spring - lifted, along


SLOSHING = Mode(0.7, 0.0, np.array([0.3, 0.2, -0.1]), np.array([0.05, -0.02, 0.01]), 0.01, 0.02)


def test_an_undamped_mode_keeps_energy_and_vertical_momentum():
    _, found, modes = followed([SLOSHING])
    energy, along = energy_of(found, SLOSHING, modes.level)
    H_N = np.einsum("nij,nj->ni", to_matrix(found.y[:, :4]), found.y[:, 4:7])
    assert np.ptp(energy) < 1e-9
    assert np.ptp(H_N[:, 2]) < 1e-12
    assert np.ptp(along) > 0.02


def test_a_damped_mode_loses_2_z_W_e_dot_squared():
    mode = Mode(0.7, 0.02, SLOSHING.coupling, SLOSHING.moment, 0.01, 0.02)
    t, found, modes = followed([mode])
    energy, along = energy_of(found, mode, modes.level)
    power = 2 * 0.02 * mode.angular_frequency * along**2
    lost = np.sum(0.5 * (power[1:] + power[:-1]) * np.diff(t))
    assert energy[0] - energy[-1] == pytest.approx(lost, rel=2e-3)


def test_a_free_platform_shows_the_raised_frequency():
    """About one axis, k = d^2 / J = 0.19: the free frequency is 1 / 0.9 of 0.9 Hz."""
    mode = Mode(0.9, 0.0, np.array([0.0, 0.0, np.sqrt(0.19 * 2.5)]), deflection=0.01)
    inertia = np.diag([1.0, 2.0, 2.5])
    body = body_of(MASS, 0.0, packed(inertia), np.zeros(3))
    y = np.concatenate([[1.0, 0, 0, 0], np.zeros(3), begun([mode], np.zeros(3))])
    t = np.linspace(0.0, 5.0, 501)
    found = follow_modes(body, NO_MASSES, modes_of([mode], UP, 0.0), y, t, np.zeros((501, 7)))
    assert freed(mode, inertia).frequency == pytest.approx(1.0)
    assert found.y[:, 7] == pytest.approx(0.01 * np.cos(2 * np.pi * t), abs=1e-6)
    again = held(freed(mode, inertia), inertia)
    assert (again.frequency, again.damping) == pytest.approx((0.9, 0.0))


def test_a_mode_without_coupling_leaves_the_rigid_motion():
    loose = Mode(1.0, 0.01, np.zeros(3), deflection=0.1)
    _, found, _ = followed([loose])
    _, rigid, _ = followed([])
    assert found.rate == pytest.approx(rigid.rate, abs=1e-10)


def test_a_slosh_rests_where_gravity_has_it():
    """Level it does not move; s.(g_B - g_0) / W^2 is where it rests on a tilted platform."""
    mode = Mode(2.0, 0.5, np.zeros(3), np.array([0.5, 0.0, 0.0]))
    body = rigid_body(MassProperties(MASS, np.zeros(3), 1e6 * np.eye(3)), GRAVITY)
    tilt = np.radians(4.0)
    y = np.concatenate([[np.cos(tilt / 2), 0, np.sin(tilt / 2), 0], np.zeros(5)])
    t = np.linspace(0.0, 5.0, 51)
    found = follow_modes(body, NO_MASSES, modes_of([mode], UP, GRAVITY), y, t, np.zeros((51, 7)))
    expected = 0.5 * GRAVITY * np.sin(tilt) / (4 * np.pi) ** 2  # x sinks at a positive pitch
    assert found.y[-1, 7] == pytest.approx(expected, rel=1e-4)


def test_inputs_of_modes_add_to_those_known():
    one = Samples(np.array([0.0, 2.0]), np.array([[0.0], [2.0]]))
    other = Samples(np.array([0.0, 1.0, 2.0]), np.array([[1.0], [0.0], [1.0]]))
    found = summed(one, other)
    assert found.t.tolist() == [0.0, 1.0, 2.0]
    assert found.values[:, 0].tolist() == [1.0, 1.0, 3.0]
    assert summed(None, other) is other
    assert summed(one, None) is one
    assert ModalInputs(one, other).torque is other
