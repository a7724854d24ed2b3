"""A platform that sags acts as a stiff one at every attitude, if its masses follow."""

import numpy as np
import pytest

from equipoise.dynamics.sag_trim import acting_com, sag_coefficients, sag_matrix
from equipoise.io.testbed.presets import read_preset
from equipoise.maths.attitude import from_euler321, to_matrix
from equipoise.procedure.balancing.sag_shift import allowance, lever

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
    r = TARGET + allowance(sag, q, BED)
    np.testing.assert_allclose(np.cross(r + sag @ n, n), np.cross(TARGET, n), atol=1e-18)


def test_level_masses_make_up_for_the_sag_of_a_level_platform_alone():
    q, sag = from_euler321(*map(np.array, (0.0, 0.0, 1.0))), some_sag(2)
    np.testing.assert_allclose(allowance(sag, q, BED), sag @ BED.up, atol=1e-18)


def test_the_lever_is_the_inverse_of_what_acts():
    com, sag = np.array([3e-6, 1e-6, -80e-6]), some_sag(3)
    np.testing.assert_allclose(acting_com(lever(com, sag, BED), sag, BED.up), com, atol=1e-18)


def test_coefficients_give_back_all_of_c_but_its_isotropic_part():
    sag = some_sag(4)
    found = sag_matrix(sag_coefficients(sag))
    np.testing.assert_allclose(found, sag - np.trace(sag) / 3 * np.eye(3), atol=1e-18)
