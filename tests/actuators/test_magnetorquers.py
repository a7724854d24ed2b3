"""Coils in a field by hand, and what they cannot do."""

from dataclasses import replace

import numpy as np
from hypothesis import assume, given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from equipoise.actuators.magnetorquers import dipoles_for, magnetic_torque
from equipoise.model.devices import Magnetorquer

SKEW = np.array([[1.0, 0, 0], [0.6, 0.8, 0], [0, 0.6, 0.8], [0.0, -1.0, 0.0]])
fields = arrays(np.float64, 3, elements=st.floats(-5e-5, 5e-5))
torques = arrays(np.float64, 3, elements=st.floats(-1e-5, 1e-5))


def coils(axes=((1, 0, 0), (0, 1, 0), (0, 0, 1)), dipole=1e3):
    plain = Magnetorquer("m", np.zeros(3), dipole)
    return tuple(
        replace(plain, name=f"m{i}", axis=np.asarray(a, float)) for i, a in enumerate(axes)
    )


def test_torque_by_hand():
    """2 A m^2 along x in 50 uT along y: 1e-4 N m along z."""
    found = magnetic_torque(coils(), np.array([2.0, 0, 0]), np.array([0, 5e-5, 0]))
    np.testing.assert_allclose(found, [0, 0, 1e-4])


@given(fields, torques)
def test_three_coils_give_b_cross_tau_over_b_squared(field, wanted):
    assume(np.linalg.norm(field) > 1e-6)
    found = dipoles_for(coils(), wanted, field)
    square = field @ field
    np.testing.assert_allclose(found.inputs, np.cross(field, wanted) / square, atol=1e-10)
    across = wanted - field * (field @ wanted) / square
    np.testing.assert_allclose(found.torque, across, atol=1e-16)


@given(fields, torques)
def test_skew_coils_do_all_that_can_be_done(field, wanted):
    """The missing torque lies along the field; the reported one is that of the dipoles."""
    assume(np.linalg.norm(field) > 1e-6)
    found = dipoles_for(coils(SKEW), wanted, field)
    np.testing.assert_allclose(np.cross(wanted - found.torque, field), 0.0, atol=1e-18)
    reported = magnetic_torque(coils(SKEW), found.inputs, field)
    np.testing.assert_allclose(found.torque, reported, atol=1e-18)


def test_torque_along_the_field_cannot_be_made():
    found = dipoles_for(coils(), np.array([0, 0, 1e-5]), np.array([0, 0, 4e-5]))
    np.testing.assert_allclose(found.inputs, 0.0, atol=1e-12)
    np.testing.assert_allclose(found.torque, 0.0, atol=1e-18)


def test_without_a_field_there_is_no_dipole():
    found = dipoles_for(coils(), np.array([0, 0, 1e-5]), np.zeros(3))
    np.testing.assert_array_equal(found.inputs, 0.0)


def test_limits_keep_the_direction():
    """1e-4 N m about x and y across 50 uT along z want 2 A m^2 of each coil of 0.5: a quarter."""
    field = np.array([0.0, 0.0, 5e-5])
    found = dipoles_for(coils(dipole=0.5), np.array([1e-4, 0.5e-4, 0.0]), field)
    np.testing.assert_allclose(found.torque, [0.25e-4, 0.125e-4, 0.0], atol=1e-18)
    assert np.abs(found.inputs).max() <= 0.5 * (1 + 1e-12)


def test_two_coils_do_what_they_can():
    """Coils along x and y in a field along x: only y turns the field, into -z torque."""
    found = dipoles_for(coils()[:2], np.array([0, 1e-5, -1e-5]), np.array([4e-5, 0, 0]))
    np.testing.assert_allclose(found.torque, [0, 0, -1e-5], atol=1e-18)
    np.testing.assert_allclose(found.inputs, [0, 0.25], atol=1e-12)
