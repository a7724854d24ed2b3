"""A platform that sags acts as a stiff one at every attitude, if its masses follow."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.dynamics.sag_trim import SAG_TERMS, acting_com, sag_matrix
from equipoise.estimation.tracker import tracker
from equipoise.estimation.tracker.known_sag import with_sag
from equipoise.io.testbed.presets import read_preset
from equipoise.maths.attitude import from_euler321, to_matrix
from equipoise.procedure.balancing.sag_shift import allowance, as_stiff

BED = read_preset("sputnix")
TARGET = np.array([1e-6, -2e-6, -50e-6])
ATTITUDES = [(0.0, 0.0, 0.3), (0.2, 0.0, 0.0), (-0.3, 0.25, 2.0)]


def some_sag(seed):
    """Return a symmetric C of some um."""
    drawn = 5e-6 * np.random.default_rng(seed).normal(size=(3, 3))
    return drawn + drawn.T


@pytest.mark.parametrize("angles", ATTITUDES)
def test_gravity_turns_it_as_it_turns_a_stiff_one(angles):
    """(r(n) + C n) x n = r_t x n."""
    q, sag = from_euler321(*map(np.array, angles)), some_sag(1)
    n = -to_matrix(q)[2]
    r = TARGET + allowance(sag, q, BED.up)
    np.testing.assert_allclose(np.cross(r + sag @ n, n), np.cross(TARGET, n), atol=1e-18)


@pytest.mark.parametrize("angles", ATTITUDES)
def test_masses_go_sideways_alone(angles):
    """The height of r is the same at every attitude: that of a level platform."""
    q, sag = from_euler321(*map(np.array, angles)), some_sag(1)
    level = from_euler321(*map(np.array, (0.0, 0.0, 0.0)))
    change = allowance(sag, q, BED.up) - allowance(sag, level, BED.up)
    assert BED.up @ change == pytest.approx(0.0, abs=1e-18)


def test_level_it_is_the_acting_centre_of_mass_that_is_on_target():
    """Where balancing leaves it, which takes the platform for stiff."""
    q, sag = from_euler321(*map(np.array, (0.0, 0.0, 1.0))), some_sag(2)
    r = TARGET + allowance(sag, q, BED.up)
    np.testing.assert_allclose(acting_com(r, sag, BED.up), TARGET, atol=1e-18)


def test_sag_that_is_alike_along_both_horizontal_axes_moves_no_mass_at_small_tilts():
    """C = diag(c, c, -2 c), of 10 um, at 1 deg: less than (1 deg)^2 of it."""
    sag, level = np.diag([10.0, 10.0, -20.0]) * 1e-6, np.array([1.0, 0, 0, 0])
    q = from_euler321(np.array(0.0), np.array(0.0), np.array(np.radians(1.0)))
    change = allowance(sag, q, BED.up) - allowance(sag, level, BED.up)
    assert np.abs(change).max() < 30e-6 * np.radians(1.0) ** 2


def test_a_state_as_a_stiff_one_has_the_acting_com_and_its_covariance():
    """By the linear map of the five coefficients; the sag itself stays."""
    q = from_euler321(*map(np.array, ATTITUDES[2]))
    sag = np.array([3.0, -1.0, 2.0, 4.0, -5.0]) * 1e-6
    first = replace(tracker.first_state(0.0, q, BED), com=TARGET)
    assert as_stiff(first, BED.up) is first
    state = with_sag(first, sag, np.diag([1.0, 2.0, 3.0, 4.0, 5.0]) * 1e-12)
    state.covariance[6, 26] = state.covariance[26, 6] = 2e-12
    found = as_stiff(state, BED.up)
    C = sag_matrix(dict(zip(SAG_TERMS, sag, strict=True)))
    np.testing.assert_allclose(found.com, TARGET - allowance(C, q, BED.up), atol=1e-18)
    by = np.column_stack([allowance(sag_matrix({k: 1.0}), q, BED.up) for k in SAG_TERMS])
    both = state.covariance[np.ix_([6, 7, 8], range(24, 29))]
    expected = state.covariance[6:9, 6:9] - both @ by.T - by @ both.T
    expected += by @ state.covariance[24:, 24:] @ by.T
    np.testing.assert_allclose(found.covariance[6:9, 6:9], expected, rtol=1e-10, atol=1e-20)
    np.testing.assert_array_equal(found.covariance[24:, 24:], state.covariance[24:, 24:])
    np.testing.assert_allclose(found.covariance[6:9, 24:], both - by @ state.covariance[24:, 24:])
