"""What devices did, by hand, from what they reported."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.actuators.stored_momentum import known_torque, stored_momentum
from equipoise.maths.attitude import exponential, to_matrix
from equipoise.model.devices import (
    ControlMomentGyro,
    JetPair,
    MagneticField,
    Magnetorquer,
    ReactionWheel,
)
from equipoise.model.errors import InputError
from equipoise.model.recording import Recording, Samples
from tests.support.builders import platform
from tests.support.gyro_pyramid import with_light_gimbals

X, Y, Z = np.eye(3)
TESTBED = replace(
    platform(),
    wheels=(ReactionWheel("wx", X, 2e-4, 500.0, 0.01), ReactionWheel("wz", Z, 1e-4, 500.0, 0.01)),
    cmgs=(ControlMomentGyro("g", Z, X, 0.5, 1.0, gimbal_inertia=2e-3),),
    magnetorquers=(Magnetorquer("my", Y, 5.0),),
    jets=(JetPair("jx", X, 0.1),),
    magnetic_field=MagneticField(np.array([0.0, 0.0, 4e-5])),
)
T = np.arange(5) * 0.1
COLUMNS = {
    "jx": [0, 0.1, 0, -0.1, 0],
    "wz": [100, 100, 100, 100, 200],
    "g": 0.3 * T + 0.2 * T**2,
    "wx": [0, 10, 20, 30, 40],
    "my": [0, 2, 2, 2, -2],
}
NAMES = ("jet:jx", "wheel:wz", "gimbal:g", "wheel:wx", "dipole:my")


def recording(**changes):
    values = np.column_stack([np.asarray(c, dtype=float) for c in COLUMNS.values()])
    tilted = np.tile(exponential(np.radians([90.0, 0.0, 0.0])), (5, 1))
    plain = Recording(attitude=Samples(T, tilted), device_names=NAMES, devices=Samples(T, values))
    return replace(plain, **changes)


def test_momentum_by_hand():
    """Wheels x and z, a gyro from x towards y, and its gimbal about z; a parabola's slope is exact.

    (At the first and last row the slope is one-sided.)
    """
    x = 0.3 * T + 0.2 * T**2
    h = stored_momentum(recording(), TESTBED)
    np.testing.assert_array_equal(h.t, T)
    np.testing.assert_allclose(h.values[:, 0], 2e-4 * 10 * np.arange(5) + 0.5 * np.cos(x))
    np.testing.assert_allclose(h.values[:, 1], 0.5 * np.sin(x))
    z = 1e-4 * np.array([100, 100, 100, 100, 200]) + 2e-3 * (0.3 + 0.4 * T)
    np.testing.assert_allclose(h.values[1:-1, 2], z[1:-1])
    bare = stored_momentum(recording(), with_light_gimbals(TESTBED))
    np.testing.assert_allclose(bare.values[:, 2], 1e-4 * np.array([100, 100, 100, 100, 200]))


def test_torque_with_a_known_field_turned_by_the_attitude():
    """Rolled by 90 deg, up is +y in the body, and a coil along y has no torque; pitched it has."""
    tau = known_torque(recording(), TESTBED)
    np.testing.assert_allclose(tau.values[:, 0], [0, 0.1, 0, -0.1, 0], atol=1e-18)
    np.testing.assert_allclose(tau.values[:, 1:], 0.0, atol=1e-18)
    pitched = np.tile(exponential(np.radians([0.0, 30.0, 0.0])), (5, 1))
    field_B = to_matrix(pitched[0]).T @ np.array([0, 0, 4e-5])
    np.testing.assert_allclose(field_B, [-2e-5, 0, 4e-5 * 0.75**0.5], atol=1e-19)  # up leans to -x
    tau = known_torque(recording(attitude=Samples(T, pitched)), TESTBED)
    np.testing.assert_allclose(tau.values[1] - 0.1 * X, 2 * np.cross(Y, field_B), atol=1e-18)


def test_torque_with_a_measured_field():
    """A magnetometer goes before what is known; its rows are read between."""
    field = Samples(np.array([0.0, 0.4]), np.array([[1e-5, 0, 0], [3e-5, 0, 0]]))
    tau = known_torque(recording(field=field), TESTBED)
    np.testing.assert_allclose(tau.values[2], [0, 0, -2 * 2e-5], atol=1e-18)  # y x x = -z


def test_without_devices_there_is_nothing():
    bare = recording(devices=None, device_names=())
    assert stored_momentum(bare, TESTBED) is None
    assert known_torque(bare, TESTBED) is None
    assert stored_momentum(recording(), platform()) is None
    assert known_torque(recording(), platform()) is None


def test_a_device_that_does_not_report_is_named():
    short = recording(device_names=(*NAMES[:3], "wheel:w_x", NAMES[4]))
    with pytest.raises(InputError, match=r"no 'wx'.*did you mean 'wheel:w_x'"):
        stored_momentum(short, TESTBED)


def test_a_coil_without_a_magnetic_field_is_refused():
    with pytest.raises(InputError, match="no magnetic field"):
        known_torque(recording(), replace(TESTBED, magnetic_field=None))


def test_one_row_has_no_slope():
    one = recording(devices=Samples(T[:1], np.zeros((1, 5))))
    np.testing.assert_allclose(stored_momentum(one, TESTBED).values, [[0.5, 0, 0]])
