"""Every column of the regressor against vector formulas, and a few by hand."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from equipoise.dynamics.regressor import DRIFT, MOMENT, SAG, SWIRL, THERMAL, TORQUE, WIDTH
from equipoise.estimation.regression.formulations.columns import regressor_rows
from equipoise.maths.attitude import exponential, to_matrix
from equipoise.maths.linalg import unpack_symmetric
from equipoise.model.torque_terms import TERMS
from tests.support.builders import GRAVITY, MASS

vectors = arrays(np.float64, 3, elements=st.floats(-2.0, 2.0))
sixes = arrays(np.float64, 6, elements=st.floats(-2.0, 2.0))
LATER, WARMER = 7.0, -3.0  # s and K after the start of the record
TILTED = -GRAVITY * to_matrix(exponential(np.array([0.3, -0.2, 0.5])))[2]
LEVEL = np.array([0.0, 0.0, -GRAVITY])
SPIN = np.array([0.3, -0.4, 1.2])  # |w| = 1.3


def columns(w, g):
    """Return the (3, 28) regressor at LATER and WARMER, the second of two rows."""
    out = np.zeros((2, 3, WIDTH))
    t = np.array([100.0, 100.0 + LATER])
    regressor_rows(
        np.tile(w, (2, 1)), np.tile(g, (2, 1)), t, np.array([0.0, WARMER]), MASS, GRAVITY, out
    )
    return out[1]


def test_one_column_for_every_term():
    """The order of the columns is the order of the names."""
    assert len(TERMS) == WIDTH - TORQUE
    assert TERMS[SWIRL] == "swirl"
    assert TERMS[SAG : SAG + 5] == ("sag_xx", "sag_yy", "sag_xy", "sag_xz", "sag_yz")
    assert (TERMS[DRIFT], TERMS[THERMAL]) == ("drift_x", "thermal_x")


@given(vectors, sixes)
def test_momentum(w, six):
    """W(w) p = J w for any symmetric J."""
    found = columns(w, LEVEL)[:, :MOMENT] @ six
    np.testing.assert_allclose(found, unpack_symmetric(six) @ w, atol=1e-14)


@given(vectors, vectors)
def test_weight(moment, lean):
    """-[g x] mu = mu x g."""
    g = -GRAVITY * to_matrix(exponential(lean))[2]
    found = columns(SPIN, g)[:, MOMENT:TORQUE] @ moment
    np.testing.assert_allclose(found, np.cross(moment, g), atol=1e-13)


def test_weight_by_hand():
    """A centre of mass along +x of a level platform tips it about +y: (1,0,0) x (0,0,-g)."""
    assert columns(SPIN, LEVEL)[:, MOMENT].tolist() == [0.0, GRAVITY, 0.0]


AXES = np.eye(3)
BY_HAND = {
    "viscous_y": np.array([0.0, 0.4, 0.0]),
    "quadratic": -1.3 * SPIN,
    "constant_z": AXES[2],
    "swirl": -TILTED / GRAVITY,
    "drift_x": MASS * LATER * np.cross(AXES[0], TILTED),
    "drift_y": MASS * LATER * np.cross(AXES[1], TILTED),
    "drift_z": MASS * LATER * np.cross(AXES[2], TILTED),
    "thermal_x": MASS * WARMER * np.cross(AXES[0], TILTED),
    "thermal_y": MASS * WARMER * np.cross(AXES[1], TILTED),
    "thermal_z": MASS * WARMER * np.cross(AXES[2], TILTED),
    "viscous_x": np.array([-0.3, 0.0, 0.0]),
    "viscous_z": np.array([0.0, 0.0, -1.2]),
    "constant_x": AXES[0],
    "constant_y": AXES[1],
}


@pytest.mark.parametrize("term", BY_HAND)
def test_torque_by_hand(term):
    """w = (0.3, -0.4, 1.2), so |w| = 1.3; the swirl is about the laboratory's vertical."""
    found = columns(SPIN, TILTED)[:, TORQUE + TERMS.index(term)]
    np.testing.assert_allclose(found, BY_HAND[term], atol=1e-13)


def test_swirl_turns_about_the_vertical_in_laboratory_axes():
    """R u = Z at any attitude."""
    q = exponential(np.array([0.4, 0.1, -2.0]))
    found = columns(SPIN, -GRAVITY * to_matrix(q)[2])[:, TORQUE + SWIRL]
    np.testing.assert_allclose(to_matrix(q) @ found, [0.0, 0.0, 1.0], atol=1e-15)


@given(arrays(np.float64, 5, elements=st.floats(-1.0, 1.0)), vectors)
def test_sag_is_a_centre_of_mass_that_gravity_pulls(five, lean):
    """The centre moves by C n towards n = g/|g|; its torque is m (C n) x g, C explicit."""
    n = -to_matrix(exponential(lean))[2]
    xx, yy, xy, xz, yz = five
    compliance = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, -xx - yy]])
    found = columns(SPIN, GRAVITY * n)[:, TORQUE + SAG : TORQUE + SAG + 5] @ five
    np.testing.assert_allclose(found, MASS * np.cross(compliance @ n, GRAVITY * n), atol=1e-11)


@given(arrays(np.float64, (3, 3), elements=st.floats(-1.0, 1.0)), st.floats(-5, 5), vectors)
def test_isotropic_sag_gives_no_torque(any_matrix, stretch, lean):
    """C + c E moves the centre along gravity: five numbers of C are all that make a torque."""
    C, n = any_matrix + any_matrix.T, -to_matrix(exponential(lean))[2]
    explicit = MASS * np.cross((C + stretch * np.eye(3)) @ n, GRAVITY * n)
    traceless = C - np.trace(C) / 3 * np.eye(3)
    five = traceless[[0, 1, 0, 0, 1], [0, 1, 1, 2, 2]]
    found = columns(SPIN, GRAVITY * n)[:, TORQUE + SAG : TORQUE + SAG + 5] @ five
    np.testing.assert_allclose(found, explicit, atol=1e-11)


def test_in_plane_sag_exerts_no_torque_on_a_level_platform():
    """n = -Z: C_xx, C_yy and C_xy push nothing off the vertical."""
    level = columns(SPIN, LEVEL)[:, TORQUE + SAG : TORQUE + SAG + 5]
    assert (level[:, :3] == 0).all()
    assert np.abs(level[:, 3:]).max() == pytest.approx(MASS * GRAVITY)
