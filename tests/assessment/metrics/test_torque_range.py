"""Gravity's torque over a range of tilts: worked by hand, and against the mean over directions."""

import numpy as np
import pytest

from equipoise.assessment.metrics.torque_range import Pull, levers, torque_form, torque_in_range
from equipoise.dynamics.sag_trim import SAG_TERMS, residual_torque, sag_matrix
from equipoise.model.estimate import COM

UP = np.array([0.0, 0.0, 1.0])
WEIGHT = 14.0 * 9.81
TILT = np.radians(20.0)
NAMES = (*COM, *SAG_TERMS)


def known(names, mean, sd=0.0):
    covariance = sd**2 * np.eye(len(mean))
    return Pull(names, np.asarray(mean, float), covariance, covariance)


def test_level_a_micrometre_aside_is_the_weight_times_a_micrometre():
    """14 kg x 9.81 x 1 um = 137 uN m, about y for a shift along x."""
    found = torque_in_range(known(COM, [1e-6, 0, 0]), WEIGHT, UP, 1e-6)
    assert found.rms.value == pytest.approx(137.34e-6, rel=1e-6)
    A = levers(COM, -UP[None])[0]
    np.testing.assert_allclose(A @ [1.0, 0, 0], np.cross([1.0, 0, 0], -UP))


def test_a_height_turns_by_the_sine_of_the_tilt():
    """Greatest at the edge: W h sin(20 deg); mean square of the sine over the cap by hand."""
    found = torque_in_range(known(COM, [0, 0, -5e-6]), WEIGHT, UP, TILT)
    assert found.worst == pytest.approx(WEIGHT * 5e-6 * np.sin(TILT), rel=1e-9)
    c = np.cos(TILT)
    mean_square = 1 - (1 - c**3) / (3 * (1 - c))
    assert found.rms.value == pytest.approx(WEIGHT * 5e-6 * np.sqrt(mean_square), rel=1e-9)


@pytest.mark.parametrize("up", [UP, np.array([0.0, 1.0, 0.0]), np.array([0.6, 0.0, 0.8])])
def test_the_form_is_the_mean_square_over_directions(up):
    rng = np.random.default_rng(5)
    x = 1e-6 * rng.normal(size=8)
    form = torque_form(NAMES, WEIGHT, up, TILT)
    sag = sag_matrix(dict(zip(SAG_TERMS, x[3:], strict=True)))
    assert np.sqrt(x @ form @ x) == pytest.approx(
        WEIGHT * residual_torque(x[:3], sag, up, TILT), rel=1e-9
    )


def test_a_sag_indistinguishable_from_a_height_does_not_widen_the_torque():
    """C = c diag(1, 1, -2) acts as a height of 3 c: 30 um of one less the other is hardly any.

    Within 2 deg the two differ by the square of the tilt, 1e-3 of them.
    """
    names, way = ("com_z", "sag_xx", "sag_yy"), np.array([-3.0, 1.0, 1.0])
    doubt = Pull(names, np.zeros(3), 1e-10 * np.outer(way, way), 1e-10 * np.outer(way, way))
    alone = known(("com_z",), [0.0], 3e-5)
    tied, height = (torque_in_range(pull, WEIGHT, UP, np.radians(2.0)) for pull in (doubt, alone))
    assert tied.rms.high < 2e-3 * height.rms.high


def test_the_worst_attitude_is_bounded_by_its_draws():
    """Far from zero the upper bound of the worst is that of one normal number."""
    found = torque_in_range(known(COM, [0, 0, -5e-6], 1e-7), WEIGHT, UP, TILT)
    assert found.worst < found.worst_high < WEIGHT * 5e-6 * np.sin(TILT) * 1.2
