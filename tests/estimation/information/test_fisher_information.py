"""What a recording can show: the bound is the inverse information, and behaves as it must."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from equipoise.dynamics.propagation import body_of, propagate
from equipoise.dynamics.regressor import N_TORQUES
from equipoise.dynamics.timeline import timeline
from equipoise.estimation.information import fisher_information, information_matrix
from equipoise.estimation.information.fisher_information import gravity_sweep, information_by
from equipoise.estimation.information.reference_motion import cautions, followed, halfway
from equipoise.estimation.output_error import trajectory
from equipoise.estimation.output_error.fit_estimate import conclude
from equipoise.estimation.output_error.trajectory import Params
from equipoise.maths.attitude import difference, exponential, multiply
from equipoise.maths.linalg import unpack_symmetric
from equipoise.model.errors import InputError
from equipoise.model.estimate import COM as COM_NAMES
from equipoise.model.estimate import INERTIA as INERTIA_NAMES
from equipoise.model.mass_properties import MassProperties
from equipoise.model.observability import Observability
from equipoise.model.recording import Recording, Samples, window
from equipoise.model.testbed import Testbed
from tests.support.builders import (
    CAMERA_SD,
    COM,
    GRAVITY,
    GYRO_SD,
    INERTIA,
    MASS,
    guessed_wrong,
    level,
    maps,
    move_at,
    noisy,
    platform,
    recording,
)

BODY = (*INERTIA_NAMES, *COM_NAMES)
HELD = Params(hold=INERTIA_NAMES)
PRINCIPAL = INERTIA * [1, 1, 1, 0, 0, 0]


@cache
def clean(end: float = 120.0, camera: float = 5.0, gyro: float = 0.0, moved: bool = True):
    return recording(end, move_at(end / 2, end) if moved else None, camera, gyro)


def bound(observed: Observability, *names: str) -> np.ndarray:
    return np.array([observed.sd[observed.names.index(name)] for name in names])


# --- The bound --------------------------------------------------------------------------------


@pytest.mark.parametrize("gyro", [0.0, 20.0], ids=["camera", "camera and gyro"])
def test_the_bound_is_what_a_fit_states(gyro):
    """Of the same record, noisy, at its optimum: stated sd without widening, within 1 %."""
    record, testbed = noisy(clean(gyro=gyro), 5), level(guessed_wrong(platform(gyro=gyro > 0)))
    observed = information_by(record, testbed, Params())
    found = trajectory.fit(record, testbed, Params())
    stated = conclude(found, "fit", record)
    assert stated.outcome.trust == "trustworthy"
    sd = np.sqrt(np.diag(stated.covariance_of(BODY)))
    np.testing.assert_allclose(bound(observed, *BODY), sd, rtol=0.01)


def outputs(record: Recording, x: np.ndarray) -> np.ndarray:
    """Return all rows in sd, for changes x of first turn, first rate, J and com of the truth."""
    rigid = body_of(MASS, GRAVITY, INERTIA + x[6:12], MASS * (COM + x[12:15]))
    line = timeline(record.attitude.t, record.rate.t, record.masses, 3, 0.05)
    q0, w0 = record.attitude.values[0], record.rate.values[0]
    motion = propagate(rigid, maps(), line, multiply(q0, exponential(x[:3])), w0 + x[3:6])
    turn = difference(motion.q[line.attitude_node], record.attitude.values) / CAMERA_SD
    rate = (motion.rate[line.rate_node] - record.rate.values) / GYRO_SD
    return np.append(turn.ravel(), rate.ravel())


def test_the_bound_is_the_inverse_of_information_by_finite_differences():
    """At the truth; the gyro's zero is taken out by hand: each row's mean is free, with its prior.

    A bias b adds to every rate: information 1 / sd_b^2 + n / sd_w^2 of it.
    """
    record = clean(gyro=20.0)
    steps = np.concatenate([np.full(6, 1e-5), np.full(6, 1e-5), np.full(3, 1e-8)])
    S = np.column_stack([
        (outputs(record, h * e) - outputs(record, -h * e)) / (2 * h)
        for h, e in zip(steps, np.eye(15), strict=True)
    ])  # fmt: skip
    n = 3 * len(record.attitude)
    bias = np.vstack([np.zeros((n, 3)), np.tile(np.eye(3), (len(record.rate), 1)) / GYRO_SD])
    S = np.hstack([S, bias])
    prior = np.append(np.zeros(15), np.full(3, 1e-2**-2.0))
    sd = np.sqrt(np.diag(np.linalg.inv(S.T @ S + np.diag(prior))))
    observed = information_by(record, level(platform(gyro=True)), Params())
    np.testing.assert_allclose(observed.sd, sd, rtol=2e-3)


def test_masses_that_may_hang_make_it_as_large_as_a_fit_states():
    """Drives that give way by 0.1 m under gravity: wider than with stiff ones, as the fit's."""
    stiff = level(platform())
    soft = replace(stiff, masses=tuple(replace(mass, sag_sd=0.1) for mass in stiff.masses))
    record = noisy(clean(), 5)
    narrow, wide = (bound(information_by(record, bed, Params()), *BODY) for bed in (stiff, soft))
    assert np.any(wide > 1.01 * narrow)
    stated = conclude(trajectory.fit(record, soft, Params()), "fit", record)
    np.testing.assert_allclose(wide, np.sqrt(np.diag(stated.covariance_of(BODY))), rtol=0.01)


def test_a_dense_record_shows_the_same_as_means_of_its_rows():
    """24 000 rows of a gyro, followed as means: the bound is that of all rows within 2 %."""
    record = noisy(clean(gyro=200.0), 4)
    testbed = level(platform(gyro=True))
    testbed = replace(testbed, gyro=replace(testbed.gyro, rate=200.0))
    motion = followed(record, testbed, Params())
    assert len(motion.fitted.at.left_w) < len(record.rate) / 2
    stated = conclude(trajectory.fit(record, testbed, Params()), "fit", record)
    sd = np.sqrt(np.diag(stated.covariance_of(BODY)))
    np.testing.assert_allclose(
        bound(fisher_information.information_along(motion), *BODY), sd, rtol=0.02
    )


def test_twice_the_rows_make_it_smaller_by_the_square_root_of_two():
    """The same two minutes at 10 instead of 5 Hz: 1201 rows for 601."""
    few, many = (
        information_by(clean(camera=hz), level(platform()), Params()) for hz in (5.0, 10.0)
    )
    np.testing.assert_allclose(bound(few, *BODY) / bound(many, *BODY), 2**0.5, rtol=0.01)


def test_twice_the_noise_makes_it_twice_as_large():
    testbed = level(platform())
    worse = replace(testbed, attitude=replace(testbed.attitude, noise=2 * CAMERA_SD))
    one, two = (information_by(clean(), bed, Params()) for bed in (testbed, worse))
    np.testing.assert_allclose(bound(two, *BODY) / bound(one, *BODY), 2.0, rtol=1e-3)


def test_twice_the_length_makes_it_smaller_by_more_than_that():
    """J known: a pendulum's phase determines its stiffness ever better, as the length to 3/2."""
    record = clean(240.0, moved=False)
    halves = [
        information_by(window(record, 0.0, end), level(platform()), HELD) for end in (120.0, 240.0)
    ]
    shorter, longer = (bound(observed, *COM_NAMES) for observed in halves)
    assert np.all(shorter / longer > 2**0.5)
    assert shorter[2] / longer[2] == pytest.approx(2**1.5, rel=0.25)


def swing(tilt: float) -> Recording:
    """A platform let go at rest, its centre of mass straight below: a swing of that tilt (rad)."""
    t = np.arange(601) / 5.0
    line = timeline(t, np.zeros(0), None, 3, 0.05)
    body = body_of(MASS, GRAVITY, PRINCIPAL, MASS * np.array([0.0, 0.0, -79e-6]))
    q0 = exponential(np.array([tilt, 0.0, 0.0]))
    motion = propagate(body, maps(), line, q0, np.zeros(3))
    return Recording(Samples(t, motion.q[line.attitude_node]))


def swung() -> Testbed:
    """The platform that swings so, its moments known and its camera level."""
    body = MassProperties(MASS, COM, unpack_symmetric(PRINCIPAL))
    return replace(level(platform()), body=body)


def test_the_vertical_offset_is_observable_in_proportion_to_tilt():
    """1, 2 and 4 deg, J known: sd as 4, 2, 1; gravity's sweep as 1, 4, 16."""
    observed = [information_by(swing(np.radians(a)), swung(), HELD) for a in (1.0, 2.0, 4.0)]
    sd = np.array([bound(one, "com_z")[0] for one in observed])
    np.testing.assert_allclose(sd / sd[-1], [4.0, 2.0, 1.0], rtol=0.02)
    sweeps = np.array([one.gravity_sweep for one in observed])
    np.testing.assert_allclose(sweeps / sweeps[0], [1.0, 4.0, 16.0], rtol=0.02)


def test_a_prior_makes_it_smaller_and_never_larger_than_itself():
    testbed = level(platform())
    plain, informed = (information_by(clean(), testbed, Params(use_prior=p)) for p in (False, True))
    assert np.all(bound(informed, *BODY) < bound(plain, *BODY))
    loose = [informed.names.index(name) for name in BODY]
    assert np.all(informed.sd[loose] < informed.before[loose])


def test_what_the_testbed_states_stands_beside_it():
    """com 0.1 mm, moments 10 %; nothing of the first attitude."""
    observed = information_by(clean(), platform(gyro=True), Params())
    before = dict(zip(observed.names, observed.before, strict=True))
    assert before["com_x"] == pytest.approx(1e-4)
    assert before["inertia_P_xx"] == pytest.approx(0.1 * INERTIA[0])
    assert before["inertia_P_xy"] == pytest.approx(0.1 * np.sqrt(INERTIA[0] * INERTIA[1]))
    assert np.isinf(before["attitude_x"])


def test_the_cameras_vertical_is_estimated_only_where_it_may_lean():
    """Where it may, com is known worse."""
    lean, plumb = (
        information_by(clean(), bed, Params()) for bed in (platform(), level(platform()))
    )
    assert "plumb_x" in lean.names
    assert "plumb_x" not in plumb.names
    assert np.all(bound(lean, *COM_NAMES) > bound(plumb, *COM_NAMES))


# --- Rank and condition -----------------------------------------------------------------------


def test_free_motion_leaves_the_scale_and_nothing_else():
    """14 of 15: attitude 3, rate 3, J 6, com 3, but for the scale; ratios are bounded."""
    observed = information_by(clean(moved=False), level(platform()), Params())
    assert (observed.rank, observed.size) == (14, 15)
    assert len(observed.unobservable) == 1
    assert observed.unobservable[0].code == "scale"
    assert np.all(np.isinf(bound(observed, *BODY)))
    assert np.isinf(observed.condition)
    assert len(observed.ratios) == 8
    assert all(np.isfinite(ratio.sd) for ratio in observed.ratios)


def test_the_scale_is_the_null_direction_of_the_information():
    """(J, com) stretched: nothing of it in the information, to rounding."""
    motion = followed(clean(moved=False), level(platform()), Params())
    information = information_matrix.free_information(motion.fitted, np.zeros(15, dtype=bool))
    body = motion.fitted.point.body(MASS)
    xx, yy, zz = np.diag(body.inertia_P)
    (xy, xz), yz = body.inertia_P[0, 1:], body.inertia_P[1, 2]
    stretched = np.concatenate([np.zeros(6), [xx, yy, zz, xy, xz, yz], body.com])
    bent = stretched * np.append(np.ones(14), -1.0)
    quadratic = [float(x @ information @ x) for x in (stretched, bent)]
    assert quadratic[0] < 1e-9 * quadratic[1]


def test_a_known_move_or_a_held_moment_closes_the_scale():
    moved = information_by(clean(), level(platform()), Params())
    assert (moved.rank, moved.size, moved.unobservable) == (15, 15, ())
    assert np.isfinite(moved.condition)
    held = information_by(clean(moved=False), level(platform()), Params(hold=("inertia_P_zz",)))
    assert (held.rank, held.size, held.unobservable) == (14, 14, ())
    assert held.sd[held.names.index("inertia_P_zz")] == 0.0
    assert held.held.sum() == 1


def test_without_tilt_the_offset_along_gravity_is_unobservable():
    """Balanced but for 79 um straight below, let go level: it never tilts."""
    observed = information_by(swing(0.0), swung(), HELD)
    assert observed.hidden[observed.names.index("com_z")]
    assert not observed.hidden[observed.names.index("com_x")]
    assert observed.gravity_sweep == pytest.approx(0.0, abs=1e-9)
    assert any("com_z" in reason.parameters for reason in observed.unobservable)


def test_without_a_camera_heading_is_unobservable():
    record = clean(30.0, camera=0.0, gyro=20.0, moved=False)
    observed = information_by(record, platform(gyro=True), HELD)
    assert observed.hidden[observed.names.index("attitude_z")]
    assert any("attitude_z" in reason.parameters for reason in observed.unobservable)


def test_the_condition_of_a_known_matrix():
    """[4 2; 2 4] is [1 1/2; 1/2 1] with unit diagonal: eigenvalues 3/2 and 1/2; units go."""
    matrix = np.array([[4.0, 2.0], [2.0, 4.0]])
    stretch = np.diag([1.0, 1e6])
    assert fisher_information.condition(matrix) == pytest.approx(3.0)
    assert fisher_information.condition(stretch @ matrix @ stretch) == pytest.approx(3.0)
    assert np.isinf(fisher_information.condition(np.ones((2, 2))))
    assert np.isinf(fisher_information.condition(np.diag([1.0, 0.0])))


def test_the_sweep_of_a_known_motion():
    """On a cone of half angle a: sin^2 a. Half the time along each of two axes: 1/2, so too."""
    t = np.linspace(0.0, 2 * np.pi, 1001)
    a = np.radians(20.0)
    cone = np.column_stack([np.sin(a) * np.cos(t), np.sin(a) * np.sin(t), np.full(1001, np.cos(a))])
    assert gravity_sweep(t, cone) == pytest.approx(np.sin(a) ** 2)
    still = np.tile([0.0, 0.0, -1.0], (1001, 1))
    assert gravity_sweep(t, still) == 0.0
    round_about = np.column_stack([np.cos(t), np.sin(t), 0 * t])
    assert gravity_sweep(t, round_about) == pytest.approx(0.5)


def test_the_tilt_range_is_reported_from_least_to_greatest():
    low, high = information_by(swing(np.radians(4.0)), swung(), HELD).tilt
    assert low < np.radians(0.2)
    assert high == pytest.approx(np.radians(4.0), rel=1e-3)


# --- The motion -------------------------------------------------------------------------------


def test_a_sound_record_needs_no_caution():
    assert information_by(noisy(clean(), 3), guessed_wrong(platform()), Params()).cautions == ()


def test_a_model_that_does_not_explain_the_record_is_reported():
    """A constant torque of 0.2 mN m that nobody asked for; sought, it explains all."""
    torque = np.zeros(N_TORQUES)
    torque[4] = 2e-4
    record = noisy(recording(120.0, move_at(60.0, 120.0), torque=torque), 1)
    plain = information_by(record, platform(), Params())
    assert any(reason.code == "motion_unexplained" for reason in plain.cautions)
    terms = ("constant_x", "constant_y", "constant_z")
    assert information_by(record, platform(), Params(terms)).cautions == ()


def test_a_random_attitude_record_is_reported():
    """Attitudes at random."""
    q = np.random.default_rng(0).normal(size=(200, 4))
    q /= np.linalg.norm(q, axis=1, keepdims=True)
    record = Recording(Samples(np.arange(200) / 5.0, q))
    observed = information_by(record, platform(), Params())
    assert observed.cautions[0].code in ("motion_not_converged", "motion_unexplained")


def test_unrequested_damping_is_reported():
    fitted = followed(clean(), platform(), Params()).fitted
    assert [reason.code for reason in cautions(fitted, damped=True)] == ["damping_added"]
    assert cautions(fitted, damped=False) == ()


def test_masses_are_displaced_to_where_the_fit_found_them():
    """Another 2 mm for the third stop: of z, from its arrival on."""
    motion = followed(clean(), platform(accuracy=3e-4), Params())
    k = motion.fitted.problem.layout.errors.index("error_z_1")
    error = motion.fitted.point.error + 2e-3 * (np.arange(len(motion.fitted.point.error)) == k)
    other = replace(motion.fitted, point=replace(motion.fitted.point, error=error))
    here, there = (halfway(fitted)[0].known for fitted in (motion.fitted, other))
    np.testing.assert_allclose(there[-1, 7:10] - here[-1, 7:10], [0.0, 0.0, 2e-3], atol=1e-12)
    np.testing.assert_allclose(there[0], here[0])


def test_too_few_rows_are_refused():
    with pytest.raises(InputError, match="3 rows"):
        information_by(window(clean(), 0.0, 0.5), platform(), Params())


def test_a_motion_without_end_is_refused():
    """A fit that ended at such a rate that its motion overflows: no eigenvalues of nothing."""
    record, testbed = noisy(recording(20.0), 0), platform()
    motion = followed(record, testbed, Params())
    point = replace(motion.fitted.point, w0=np.full(3, 1e9))
    lost = replace(motion, fitted=replace(motion.fitted, point=point))
    with pytest.raises(InputError, match="a motion that the fit did not find"):
        fisher_information.information_along(lost)
