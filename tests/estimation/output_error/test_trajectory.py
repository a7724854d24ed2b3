"""The trajectory fit recovers what made the record, and says what the record does not show."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from equipoise.dynamics.regressor import N_TORQUES
from equipoise.estimation.model_selection.reference_fit import estimate
from equipoise.estimation.output_error.solution import settle
from equipoise.estimation.output_error.trajectory import (
    Params,
    fastest_rate,
    fit,
    problem_of,
    upright,
)
from equipoise.estimation.parameters import fit_parameters
from equipoise.estimation.parameters.fit_parameters import Unknowns, physical
from equipoise.maths.attitude import difference, exponential, logarithm, multiply, to_matrix
from equipoise.maths.linalg import inverse_spd
from equipoise.model.errors import InputError
from equipoise.model.estimate import COM as COM_NAMES
from equipoise.model.estimate import INERTIA as INERTIA_NAMES
from equipoise.model.recording import Recording, Samples, window
from equipoise.model.testbed import AttitudeSensor, Gyro
from tests.support.builders import (
    ATTITUDE,
    CAMERA_SD,
    COM,
    INERTIA,
    MASS,
    RATE,
    guessed_wrong,
    level,
    move_at,
    noisy,
    platform,
    recording,
)

TRUTH = np.concatenate([RATE, INERTIA, COM])
SIZES = np.array([0.01] * 3 + [0.5] * 6 + [79e-6] * 3)  # what a relative error is relative to
CORE = slice(3, 15)


@cache
def clean(moved: bool = True, gyro: float = 0.0, camera: float = 5.0) -> Recording:
    return recording(120.0, move_at(60.0, 120.0) if moved else None, camera, gyro)


def core(fitted) -> np.ndarray:
    """Return first rate, J and com."""
    return physical(fitted.point, MASS, fitted.problem.layout)[CORE]


def sd_of(fitted) -> np.ndarray:
    return np.sqrt(np.diag(inverse_spd(fitted.at.normal)))[CORE]


def sharp(testbed):
    """The same platform with sensors so good that the search must go on to 1e-6 or better."""
    return replace(
        testbed,
        attitude=testbed.attitude and AttitudeSensor(5.0, 1e-6),
        gyro=testbed.gyro and Gyro(20.0, 1e-7, 1e-2),
    )


# --- Recovery ---------------------------------------------------------------------------------


@pytest.mark.parametrize("gyro", [0.0, 20.0], ids=["camera", "camera and gyro"])
def test_without_noise_the_truth_comes_back(gyro):
    """From a guess 10 % and 79 um off, to 1e-6 of the size of each parameter."""
    testbed = guessed_wrong(sharp(platform(gyro=gyro > 0)))
    fitted = fit(clean(gyro=gyro), testbed, Params())
    assert fitted.converged
    np.testing.assert_allclose((core(fitted) - TRUTH) / SIZES, 0.0, atol=1e-6)
    assert np.linalg.norm(difference(fitted.point.q0, ATTITUDE)) < 1e-7


def test_torque_comes_back_too():
    """Viscous drag and a constant torque, made and found (2 and 0.01 mN m: 1e-3 of each)."""
    torque = np.zeros(N_TORQUES)
    torque[[0, 1, 2, 4, 5, 6]] = 2e-3, 1e-3, 3e-3, 1e-5, -2e-5, 5e-6
    record = recording(120.0, move_at(60.0, 120.0), torque=torque)
    terms = ("viscous_x", "viscous_y", "viscous_z", "constant_x", "constant_y", "constant_z")
    fitted = fit(record, guessed_wrong(sharp(platform())), Params(terms))
    found = fitted.point.torque[[0, 1, 2, 4, 5, 6]]
    np.testing.assert_allclose(found, torque[[0, 1, 2, 4, 5, 6]], rtol=1e-3)


def off(seed: int) -> Unknowns:
    """A start some 5 % and 5 um off the truth."""
    rng = np.random.default_rng(seed)
    fitted = fit(clean(), platform(), Params()).point
    return replace(
        fitted,
        q0=multiply(fitted.q0, exponential(rng.normal(scale=0.01, size=3))),
        w0=RATE * (1 + 0.05 * rng.normal(size=3)),
        six=fitted.six + 0.02 * rng.normal(size=6),
        com=COM + 5e-6 * rng.normal(size=3),
    )


def test_one_optimum_from_any_start():
    """The linear start and four others end within 0.03 sd (converged: the step is below 0.01)."""
    record, testbed = noisy(clean(), 2), guessed_wrong(platform())
    best = fit(record, testbed, Params())
    for seed in range(4):
        other = fit(record, testbed, Params(), off(seed))
        assert other.converged
        assert np.abs((core(other) - core(best)) / sd_of(best)).max() < 0.03


def test_errors_are_as_large_as_stated():
    """Camera alone, 30 seeds: 12 parameters each; the mean of 30 chi-squares is 12 +- 4 x 0.9."""
    squares = []
    for seed in range(30):
        fitted = fit(noisy(clean(), seed), guessed_wrong(platform()), Params())
        error = core(fitted) - TRUTH
        covariance = inverse_spd(fitted.at.normal)[CORE, CORE]
        squares.append(error @ inverse_spd(covariance) @ error)
    assert np.mean(squares) == pytest.approx(12.0, abs=3.6)


def test_wrong_stops_are_found():
    """z stops 1 mm short of its command: an unknown with its accuracy as prior finds it."""
    reported = move_at(60.0, 120.0)
    really = Samples(reported.t, reported.values + np.outer([0, 0, 0, 1, 1], [0, 0, 1e-3]))
    record = replace(recording(120.0, really), masses=reported, mass_names=("x", "y", "z"))
    fitted = fit(record, sharp(platform(accuracy=1e-3)), Params())
    assert fitted.problem.layout.errors == ("error_x_1", "error_y_1", "error_z_1")
    # an error of 2 % in the step is an error of 2 % in the scale, unless the prior speaks: the
    # record without noise says which combination, the prior that x and y stopped well
    left = fit(record, sharp(platform(accuracy=0.0)), Params())
    assert fitted.at.cost < 1e-2 * left.at.cost


# --- Robustness -------------------------------------------------------------------------------


def with_outliers(record: Recording) -> Recording:
    """5 % of the camera's rows are off by 10 deg in any direction."""
    rng = np.random.default_rng(6)
    q = record.attitude.values.copy()
    bad = rng.random(len(q)) < 0.05
    way = rng.normal(size=(int(bad.sum()), 3)) + [0.5, 0.3, 0.0]
    way *= np.radians(10) / np.linalg.norm(way, axis=1, keepdims=True)
    q[bad] = multiply(q[bad], exponential(way))
    return replace(record, attitude=Samples(record.attitude.t, q))


def test_robust_fit_stands_outliers():
    """Within 4 sd of the clean record with Huber's loss; more than 8 off without."""
    record, testbed = with_outliers(noisy(clean(), 3)), guessed_wrong(platform())
    sd = sd_of(fit(noisy(clean(), 3), testbed, Params()))
    robust, plain = (fit(record, testbed, Params(robust=r)) for r in (True, False))
    assert np.abs((core(robust) - TRUTH) / sd).max() < 4
    assert np.abs((core(plain) - TRUTH) / sd).max() > 8


def test_robust_costs_little_on_clean_data():
    """Huber at 3 sd of a vector touches 3 % of clean rows: the result moves by less than 1 sd."""
    record, testbed = noisy(clean(), 4), guessed_wrong(platform())
    plain, robust = (fit(record, testbed, Params(robust=r)) for r in (False, True))
    moved = np.abs((core(robust) - core(plain)) / sd_of(plain)).max()
    assert 0 < moved < 1


# --- What is unobservable -------------------------------------------------------------------------


@pytest.mark.parametrize("gyro", [0.0, 20.0], ids=["camera", "camera and gyro"])
def test_free_motion_says_that_the_scale_is_open(gyro):
    """No move, no wheel: no moment and no offset has an interval, but ratios do, with the truth."""
    testbed = guessed_wrong(platform(gyro=gyro > 0))
    found = estimate(noisy(clean(moved=False, gyro=gyro), 1), testbed, Params())
    assert found.outcome.code == "scale_open"
    assert "scale" in [reason.code for reason in found.unobservable]
    assert all(np.isinf(found.parameters[found.index(n)].sd) for n in INERTIA_NAMES[:3])
    assert np.isinf(found.parameters[found.index("com_z")].sd)
    true = dict(zip((*COM_NAMES, *INERTIA_NAMES), (*COM, *INERTIA), strict=True))
    assert len(found.ratios) == 8
    for ratio in found.ratios:
        above, below = ratio.name.split("/")
        assert abs(ratio.value - true[above] / true[below]) < 4 * ratio.sd


def test_rates_are_observable_even_when_the_scale_is_not():
    """Attitude and rate need no scale: finite intervals that hold the truth (4 sd)."""
    found = estimate(noisy(clean(moved=False), 1), guessed_wrong(platform()), Params())
    for name, true in zip(("rate_x", "rate_y", "rate_z"), RATE, strict=True):
        parameter = found.parameters[found.index(name)]
        assert parameter.observable
        assert abs(parameter.value - true) < 4 * parameter.sd < 1e-3


def test_a_held_value_fixes_the_scale():
    """J_zz held at its true value: everything else comes out, with intervals that hold it."""
    found = estimate(noisy(clean(moved=False), 1), platform(), Params(hold=("inertia_P_zz",)))
    assert found.outcome.code == "estimated"
    assert found.parameters[found.index("inertia_P_zz")].value == pytest.approx(
        INERTIA[2], rel=1e-5
    )
    for name, true in zip((*COM_NAMES, *INERTIA_NAMES), (*COM, *INERTIA), strict=True):
        parameter = found.parameters[found.index(name)]
        assert np.isfinite(parameter.sd)
        assert abs(parameter.value - true) < 4 * parameter.sd + 1e-5 * abs(true)


def test_a_value_held_at_zero_leaves_the_scale_open():
    """Zero is zero at any scale: ratios come out, com_y's as nothing, and no size does.

    The true com_y is -0.1 um, less than the record shows.
    """
    testbed = platform()
    body = replace(testbed.body, com=testbed.body.com * [1, 0, 1])
    found = estimate(
        noisy(clean(moved=False), 1), replace(testbed, body=body), Params(hold=("com_y",))
    )
    assert found.outcome.code == "scale_open"
    assert np.isinf(found.parameters[found.index("inertia_P_zz")].sd)
    true = dict(zip((*COM_NAMES, *INERTIA_NAMES), (*COM, *INERTIA), strict=True))
    for ratio in found.ratios:
        above, below = ratio.name.split("/")
        wanted = 0.0 if above == "com_y" else true[above] / true[below]
        assert abs(ratio.value - wanted) <= 4 * ratio.sd + 1e-12


def test_a_held_value_that_is_wrong_stretches_the_rest():
    """Held 10 % high, com and the other moments come out 10 % high: the scale is what was held."""
    testbed = platform()
    body = replace(testbed.body, inertia_P=1.1 * testbed.body.inertia_P)
    wrong = sharp(replace(testbed, body=body))
    fitted = fit(clean(moved=False), wrong, Params(hold=("inertia_P_zz",)))
    np.testing.assert_allclose(core(fitted)[3:], 1.1 * TRUTH[3:], rtol=1e-4)


def test_holding_something_unknown_is_refused():
    """The message names the nearest that there is."""
    with pytest.raises(InputError, match="inertia_P_zz"):
        fit(clean(), platform(), Params(hold=("inertia_P_z",)))


def test_gyro_alone_does_not_see_heading():
    """No camera: the turn about the vertical stays open and is named; J and com are found."""
    testbed = guessed_wrong(replace(platform(gyro=True), attitude=None))
    found = estimate(noisy(clean(gyro=20.0, camera=0.0), 1), testbed, Params())
    assert found.outcome.usable
    assert any(name.endswith("_z") for reason in found.unobservable for name in reason.parameters)
    assert np.isinf(found.parameters[found.index("attitude_z")].sd)
    for name, true in zip((*COM_NAMES, *INERTIA_NAMES), (*COM, *INERTIA), strict=True):
        parameter = found.parameters[found.index(name)]
        assert abs(parameter.value - true) < 4 * parameter.sd < np.inf


def test_gyro_alone_is_of_a_platform_that_stands_upright():
    """m g com x n is the same with both reversed: a search that ended there is turned over."""
    testbed = replace(platform(gyro=True), attitude=None)
    record = noisy(clean(moved=False, gyro=20.0, camera=0.0), 1)
    problem = problem_of(record, testbed, Params(hold=("inertia_P_zz",)))
    truth = fit(record, testbed, Params(hold=("inertia_P_zz",))).point
    over = multiply(exponential(np.array([np.pi, 0.0, 0.0])), truth.q0)
    hanging = settle(problem, replace(truth, q0=over, com=-truth.com))
    assert to_matrix(hanging.point.q0)[2, 2] < -0.9
    found = upright(hanging)
    assert to_matrix(found.point.q0)[2, 2] > 0.9
    np.testing.assert_allclose(found.point.com, truth.com, atol=1e-7)
    assert upright(found) is found


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_an_undeclared_torque_is_found(seed):
    """A constant torque of 2e-4 N m moves com by 1.4 um, seventy sd, if it is left out.

    It is added by itself, reported, and what is said of com is right with it.
    """
    torque = np.zeros(N_TORQUES)
    torque[4] = 2e-4
    record = noisy(recording(120.0, move_at(60.0, 120.0), torque=torque), seed)
    found = estimate(record, platform(), Params())
    added = [r.parameters for r in found.outcome.reasons if r.code == "terms_added"]
    assert "constant" in added[0]
    sd = np.sqrt(np.diag(found.covariance_of(COM_NAMES)))
    assert (np.abs(found.com - COM) < 4 * sd).all()
    assert abs(found.values(("constant_x",))[0] - 2e-4) < 4 * found.parameters[
        found.index("constant_x")
    ].sd  # fmt: skip


def test_too_few_rows_are_an_outcome():
    """Three rows: no numbers and no exception."""
    found = estimate(window(clean(moved=False), 0.0, 0.4), platform(), Params())
    assert not found.outcome.usable
    assert found.parameters == ()


# --- What is reported -------------------------------------------------------------------------


def test_estimate_reports_the_fit():
    """Names, values and 95 % intervals hold the truth; com at the end is where the masses put it.

    (-10, -10, -50) mm of 15.6 g in 14.24 kg: -10.96 um and -54.8 um.
    """
    found = estimate(noisy(clean(), 5), guessed_wrong(platform()), Params())
    assert found.outcome.usable
    assert found.unobservable == ()
    true = [*COM, *INERTIA, *RATE, *logarithm(ATTITUDE)]
    names = (*COM_NAMES, *INERTIA_NAMES, "rate_x", "rate_y", "rate_z")
    names = (*names, "attitude_x", "attitude_y", "attitude_z")
    for name, value in zip(names, true, strict=True):
        parameter = found.parameters[found.index(name)]
        assert abs(parameter.value - value) < 4 * parameter.sd, name
    shift = np.array([-10, -10, -50]) * 1e-3 * 0.0156 / MASS
    end = found.values(("com_end_x", "com_end_y", "com_end_z"))
    np.testing.assert_allclose(end - found.com, shift, atol=1e-15)


def test_residual_is_that_of_the_camera():
    """600 rows of 0.2 deg, fitted and predicted: 4 sd of the rms are 7 % and 15 %."""
    residual = estimate(noisy(clean(), 5), guessed_wrong(platform()), Params()).residual
    assert residual.attitude_rms == pytest.approx(CAMERA_SD, rel=0.07)
    assert residual.rate_rms is None
    assert residual.held_out_rms == pytest.approx(CAMERA_SD, rel=0.15)
    assert residual.held_out_span == (90.0, 120.0)
    assert residual.reduced_chi_square == pytest.approx(1.0, abs=4 * np.sqrt(2 / 1788))
    assert abs(residual.lag_one) < 4 / np.sqrt(1800)
    assert residual.degrees_of_freedom == 3 * 601 - fit_parameters.FIXED - 2  # the camera's lean
    assured = estimate(noisy(clean(), 5), level(guessed_wrong(platform())), Params()).residual
    assert assured.degrees_of_freedom == 3 * 601 - fit_parameters.FIXED


def test_a_part_of_one_row_has_no_rate():
    """A sparse record's first part may hold a single camera row: nothing says how fast it turns."""
    one = Recording(Samples(np.array([0.0]), np.array([[1.0, 0, 0, 0]])))
    assert fastest_rate(one) == 0.0
    two = Recording(Samples(np.array([0.0, 0.5]), np.array([[1.0, 0, 0, 0], [0.0, 0, 0, 1]])))
    assert fastest_rate(two) == pytest.approx(2 * np.pi)
