"""What filters can see of their state: Jacobians, sensitivities, and ranks that can be known."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from equipoise.dynamics import sensitivities
from equipoise.dynamics.propagation import NO_COLUMNS, Columns, body_of, propagate
from equipoise.dynamics.timeline import timeline
from equipoise.estimation.information import filter_observability
from equipoise.estimation.information.filter_observability import (
    MODELS,
    SCALE,
    Outputs,
    directions,
    exactly_unseen,
    filters_along,
    joined,
    output_sensitivities,
    spelled,
    state_sensitivities,
)
from equipoise.estimation.information.linearised_filters import (
    Course,
    acceleration,
    by_inertia,
    by_moment,
    by_rate,
    by_turn,
    course_of,
    rate_inertia_moment,
    simplified_stack,
)
from equipoise.estimation.information.reference_motion import followed, halved
from equipoise.estimation.output_error.trajectory import Params
from equipoise.maths.attitude import exponential
from equipoise.maths.linalg import skew, unpack_symmetric
from equipoise.model.mass_properties import MassProperties
from equipoise.model.recording import Samples
from tests.support.builders import (
    ATTITUDE,
    COM,
    GRAVITY,
    INERTIA,
    MASS,
    RATE,
    maps,
    move_at,
    platform,
    recording,
)

KF, EKF, CAMERA, WHOLE, REDUCED = MODELS
PRINCIPAL = INERTIA * [1, 1, 1, 0, 0, 0]
BELOW = np.array([0.0, 0.0, -79e-6])
LEVEL = np.array([1.0, 0.0, 0.0, 0.0])
SIZE = {"rate": 0.1, "attitude": 1.0, "com": 79e-6, "moment": 79e-6 * MASS, "inertia": 0.6}


def path(end=60.0, start=(ATTITUDE, RATE), of=(INERTIA, COM), columns=NO_COLUMNS, **known):
    """Return a timeline at half steps, the motion along it and the body that moves so."""
    t = np.arange(int(5 * end) + 1) / 5.0
    track, (inertia, com) = known.pop("track", None), of
    line = halved(timeline(t, np.zeros(0), track, 3, 0.1, **known))
    rigid = body_of(MASS, GRAVITY, inertia, MASS * com)
    motion = propagate(rigid, maps(), line, *start, columns)
    return line, motion, MassProperties(MASS, com, unpack_symmetric(inertia))


def course(**what) -> Course:
    line, motion, body = path(**what)
    return course_of(line, motion, body, maps(), GRAVITY)


def square_wave(end=60.0) -> Samples:
    """10 mN m about each axis in turn, there and back, 5 s each."""
    t = np.arange(0.0, end, 0.1)
    k = (t // 5).astype(int)
    return Samples(t, 0.01 * np.eye(3)[k % 3] * np.where(k // 3 % 2, -1.0, 1.0)[:, None])


def wheels(end=60.0) -> Samples:
    """Wheels that run up slowly, each its own way."""
    t = np.array([0.0, end / 2, end])
    return Samples(t, np.array([[0.0, 0.0, 0.02], [0.02, 0.0, 0.02], [0.02, 0.02, -0.02]]))


@cache
def free() -> Course:
    return course()


@cache
def moved() -> Course:
    return course(track=move_at(30.0, 60.0))


def in_sizes(model) -> np.ndarray:
    return np.array([SIZE[name.split("_")[0]] for name in model.states])


def unseen(model, along: Course) -> np.ndarray:
    outputs = output_sensitivities(model, along)
    return exactly_unseen(joined(outputs, np.ones(len(outputs.stack)), in_sizes(model)))


def rank_by_rows(stack: np.ndarray) -> list[int]:
    """The rank of the first row, the first two, ... of a stack (N, 3, s)."""
    size = stack.shape[-1]
    return [size - exactly_unseen(stack[: k + 1]).shape[1] for k in range(len(stack))]


def rank(model, along: Course) -> int:
    return len(model.states) - unseen(model, along).shape[1]


# --- The simplified model ---------------------------------------------------------------------


def test_a_single_phi_by_hand():
    """g = (0, 0, -10), m = 10 kg, T = 0.1 s, J = diag(1, 2, 4): m T g = 10.

    Phi r = m T J^-1 r x g: of r = e_x it is J^-1 (0, 10, 0), of e_y J^-1 (-10, 0, 0), of e_z 0.
    So of rank 2, and the stack of two rows of rank 5.
    """
    gravity = np.tile([0.0, 0.0, -10.0], (2, 1))
    inertia = np.diag([1.0, 2.0, 4.0])
    stack = simplified_stack(gravity, inertia, 10.0, np.array([0.1]))
    phi = stack[1, :, 3:]
    np.testing.assert_allclose(phi, [[0, -10, 0], [5, 0, 0], [0, 0, 0]], atol=1e-12)
    np.testing.assert_array_equal(stack[:, :, :3], np.tile(np.eye(3), (2, 1, 1)))
    assert np.linalg.matrix_rank(phi) == 2
    assert rank_by_rows(stack) == [3, 5]


def test_a_single_phi_has_rank_two_whatever_the_attitude():
    rng = np.random.default_rng(1)
    for _ in range(20):
        gravity = np.tile(rng.normal(size=3), (2, 1))
        stack = simplified_stack(gravity, np.diag(rng.uniform(1, 2, 3)), 10.0, np.array([0.1]))
        assert rank_by_rows(stack) == [3, 5]


def down(tilt: float, heading: np.ndarray) -> np.ndarray:
    """Gravity in a body that leans by ``tilt`` (rad) towards its own heading (rad)."""
    lean = np.column_stack([np.cos(heading), np.sin(heading), np.zeros(len(heading))])
    return GRAVITY * (np.sin(tilt) * lean - np.cos(tilt) * np.array([0.0, 0.0, 1.0]))


def simplified_ranks(gravity: np.ndarray) -> list[int]:
    steps = np.full(len(gravity) - 1, 0.1)
    return rank_by_rows(simplified_stack(gravity, unpack_symmetric(INERTIA), MASS, steps))


def test_two_attitudes_give_all_six():
    """Gravity turns by 10 deg between the first mean and the second: rank 3, 5, 6."""
    assert simplified_ranks(down(0.2, np.radians([0.0, 10.0, 30.0, 60.0]))) == [3, 5, 6, 6]


@pytest.mark.parametrize("tilt", [0.0, 0.3])
def test_spin_about_the_vertical_does_not_help(tilt):
    """However the platform leans, gravity stays where it is in the body: 5 for ever."""
    assert simplified_ranks(down(tilt, np.zeros(6))) == [3, 5, 5, 5, 5, 5]


# --- Jacobians --------------------------------------------------------------------------------


def slope(w, body, g, turn, drive):
    """w' of the filters' model; every operation may be complex."""
    (p, mu), (h, rise, torque) = body, drive
    J = unpack_symmetric(p)
    g = g + np.cross(g, turn)
    return np.linalg.solve(J, np.cross(mu, g) + torque - rise - np.cross(w, J @ w + h))


def complex_step(function, x: np.ndarray) -> np.ndarray:
    """Return the derivative: Im f(x + i h e) / h, h = 1e-20 (da Silva 2021 Eq. 38 with R18)."""
    return np.column_stack([np.imag(function(x + 1e-20j * e)) / 1e-20 for e in np.eye(len(x))])


@pytest.mark.parametrize("share", [0, 1, 2], ids=["start", "middle", "end"])
def test_jacobians_are_those_of_the_model(share):
    """With wheels, outside torque and masses off home; by complex step."""
    along = course(track=move_at(20.0, 60.0), momentum=wheels(), torque=square_wave())
    where = (200, share)
    w, g, mu = along.rate[where], along.gravity[where], along.moment[where]
    J = along.inertia[where]
    p = np.array([J[0, 0], J[1, 1], J[2, 2], J[0, 1], J[0, 2], J[1, 2]])
    h, torque, rise = along.momentum[where], along.torque[where], along.momentum_rate[200, 0]
    assert np.linalg.norm(rise) > 1e-4
    assert np.linalg.norm(torque) > 1e-3
    still, drive = np.zeros(3), (h, rise, torque)
    for found, function, at in (
        (by_rate, lambda x: slope(x, (p, mu), g, still, drive), w),
        (by_inertia, lambda x: slope(w, (x, mu), g, still, drive), p),
        (by_moment, lambda x: slope(w, (p, x), g, still, drive), mu),
        (by_turn, lambda x: slope(w, (p, mu), g, x, drive), still),
    ):
        expected = complex_step(function, at.astype(complex))
        np.testing.assert_allclose(found(along)[where], expected, rtol=1e-9, atol=1e-12)
    expected = slope(w, (p, mu), g, still, drive)
    np.testing.assert_allclose(acceleration(along)[where], expected, rtol=1e-9, atol=1e-14)


def test_the_models_acceleration_is_that_of_the_motion():
    """Of a driven platform with wheels, where nothing jumps: differences over a step."""
    along = course(momentum=wheels(), torque=square_wave())
    measured = (along.rate[:, 2] - along.rate[:, 0]) / along.step[:, None]
    calm = np.all(along.torque[:, 0] == along.torque[:, 2], axis=1)
    middle = acceleration(along)[:, 1]
    np.testing.assert_allclose(middle[calm], measured[calm], atol=5e-6)
    assert np.abs(middle).max() > 0.01


def test_a_move_changes_what_the_filters_know():
    """15.6 g by (-10, -10, -50) mm: the first moment by (-0.156, -0.156, -0.78) kg mm."""
    along = moved()
    shift = along.moment[-1, 2] - along.moment[0, 0]
    np.testing.assert_allclose(shift, 0.0156 * np.array([-0.01, -0.01, -0.05]), atol=1e-12)
    assert np.abs(along.inertia[-1, 2] - along.inertia[0, 0]).max() > 1e-4


# --- Sensitivities ----------------------------------------------------------------------------


def test_with_the_attitude_in_the_state_they_are_the_propagators():
    """Turn, rate and com of the compiled propagator: an independent integration."""
    kinds = [sensitivities.TURN] * 3 + [sensitivities.RATE] * 3 + [sensitivities.MOMENT] * 3
    columns = Columns(np.array(kinds), np.array([0, 1, 2] * 3))
    line, motion, body = path(columns=columns)
    found = state_sensitivities(CAMERA.slopes(course_of(line, motion, body, maps(), GRAVITY)),
                                line.t[2::2] - line.t[:-2:2]).stack  # fmt: skip
    per = np.array([1.0] * 6 + [MASS] * 3)
    expected = np.concatenate([motion.turn_by[::2], motion.rate_by[::2]], axis=1) * per
    scale = np.abs(expected).max(axis=(0, 1))
    np.testing.assert_allclose(found / scale, expected / scale, atol=1e-5)


def ended(along: Course, x: np.ndarray) -> np.ndarray:
    """Return the last rate of [w, J, mu] + x, attitude given: Runge-Kutta by hand."""
    w = along.rate[0, 0] + x[:3]
    dJ, dmu = unpack_symmetric(x[3:9]), x[9:]

    def rise(w, i, share):
        J, g = along.inertia[i, share] + dJ, along.gravity[i, share]
        total = J @ w + along.momentum[i, share]
        weight = np.cross(along.moment[i, share] + dmu, g)
        driven = along.torque[i, share] - along.momentum_rate[i, 0]
        return np.linalg.solve(J, weight + driven - np.cross(w, total))

    for i, h in enumerate(along.step):
        a = rise(w, i, 0)
        b = rise(w + h / 2 * a, i, 1)
        c = rise(w + h / 2 * b, i, 1)
        d = rise(w + h * c, i, 2)
        w = w + h / 6 * (a + 2 * b + 2 * c + d)
    return w


def test_with_the_attitude_given_they_are_finite_differences():
    """[w, J, mu] through a known move, wheels running up: central differences after 20 s."""
    along = course(end=20.0, track=move_at(8.0, 20.0), momentum=wheels(20.0))
    found = output_sensitivities(WHOLE, along).stack[-1]
    size = in_sizes(WHOLE)
    expected = np.column_stack([
        (ended(along, 1e-5 * e * size) - ended(along, -1e-5 * e * size)) / 2e-5
        for e in np.eye(12)
    ])  # fmt: skip
    np.testing.assert_allclose(found * size, expected, atol=2e-4 * np.abs(expected).max())


# --- Ranks ------------------------------------------------------------------------------------


def stretched() -> np.ndarray:
    """(J, mu) of the platform with masses at home, in natural sizes."""
    way = np.concatenate([np.zeros(3), INERTIA, MASS * COM]) / in_sizes(WHOLE)
    return way / np.linalg.norm(way)


def test_free_motion_shows_eleven_of_twelve_and_not_the_scale():
    null = unseen(WHOLE, free())
    assert null.shape == (12, 1)
    assert abs(null[:, 0] @ stretched()) == pytest.approx(1.0, abs=1e-9)


@pytest.mark.parametrize(
    "known",
    [{"track": move_at(30.0, 60.0)}, {"torque": square_wave()}, {"momentum": wheels()}],
    ids=["move", "torque", "wheels"],
)
def test_what_is_known_to_change_shows_all_twelve(known):
    assert rank(WHOLE, course(**known)) == 12


def test_a_drive_that_is_not_known_does_not_show_the_scale():
    """Momentum exchange devices move the platform, but the filter has no record of it (R19)."""
    driven = course(torque=square_wave(), momentum=wheels())
    untold = driven._replace(
        torque=0 * driven.torque,
        momentum=0 * driven.momentum,
        momentum_rate=0 * driven.momentum_rate,
    )
    null = unseen(WHOLE, untold)
    assert null.shape == (12, 1)
    assert abs(null[:, 0] @ stretched()) == pytest.approx(1.0, abs=1e-9)


def spinning() -> Course:
    """Level, centre of mass straight below, 6 deg/s about the vertical: nothing else moves."""
    w0 = np.array([0.0, 0.0, 0.1])
    return course(start=(LEVEL, w0), of=(PRINCIPAL, BELOW))


def test_spin_about_the_vertical_alone_shows_five_of_twelve():
    """w, and two sums: g mu_y - w^2 J_yz and w^2 J_xz - g mu_x (the inertia columns by hand)."""
    null = unseen(WHOLE, spinning())
    assert null.shape == (12, 7)
    names = list(WHOLE.states)
    size = in_sizes(WHOLE)
    for moment, product in (("moment_x", "inertia_P_xz"), ("moment_y", "inertia_P_yz")):
        alike = np.zeros(12)
        alike[names.index(moment)], alike[names.index(product)] = 0.1**2, GRAVITY
        alike /= size
        alike /= np.linalg.norm(alike)
        assert np.linalg.norm(null.T @ alike) == pytest.approx(1.0, abs=1e-6)


@pytest.mark.parametrize(
    ("model", "expected"), [(KF, 5), (EKF, 5), (CAMERA, 8), (REDUCED, 3)], ids=lambda x: str(x)[:0]
)
def test_spin_about_the_vertical_hides_the_vertical_offset(model, expected):
    """g_x = g_y = 0 (da Silva 2021 section 4.1): one short of full, and that is com_z."""
    null = unseen(model, spinning())
    assert rank(model, spinning()) == expected
    assert abs(null[model.states.index("com_z"), 0]) == pytest.approx(1.0, abs=1e-9)


@pytest.mark.parametrize("model", [KF, EKF, CAMERA, REDUCED], ids=lambda m: m.name)
def test_a_swing_shows_the_centre_of_mass_to_all_filters_that_know_the_inertia(model):
    assert unseen(model, free()).shape[1] == 0


# --- Stretches --------------------------------------------------------------------------------


def test_of_a_further_stretch_counts_what_its_own_state_does_not_explain():
    """One state, one constant, rows [1 a]: of a = 1, 2, 6 behind the start -2, -1, 3 are left."""
    stack = np.array([[1, 0], [1, 1], [1, 1], [1, 2], [1, 6]], dtype=float)[:, None]
    found = joined(Outputs(stack, (0, 2), 1), np.ones(5), np.ones(2))
    np.testing.assert_allclose(found[:2], stack[:2])
    np.testing.assert_allclose(found[2:, 0], [[0, -2], [0, -1], [0, 3]], atol=1e-12)


def tumbling(**known) -> Course:
    """3.6 rad/s about the middle axis for a minute: given the attitude, errors grow as e^70."""
    start = (exponential(np.array([np.pi / 2, 0, 0])), np.array([0.0, 3.6, 0.02]))
    return course(start=start, of=(INERTIA, np.array([0.0, -2e-2, 0.0])), **known)


def test_a_swing_is_one_stretch():
    assert output_sensitivities(WHOLE, moved()).starts == (0,)


@pytest.mark.parametrize("grown", [10.0, filter_observability.GROWN])
def test_the_rank_of_an_unstable_motion_is_independent_of_restarts(monkeypatch, grown):
    """However often sensitivities are restarted."""
    monkeypatch.setattr(filter_observability, "GROWN", grown)
    along = tumbling()
    assert len(output_sensitivities(EKF, along).starts) > 2
    assert rank(EKF, along) == 6
    assert rank(REDUCED, along) == 4
    assert rank(WHOLE, along) == 11
    assert rank(WHOLE, tumbling(track=move_at(30.0, 60.0))) == 12


# --- Words ------------------------------------------------------------------------------------


def test_unobservable_directions_are_expressed_in_the_fewest_states():
    """e_0 and e_1, mixed: they come apart; and the scale comes first, as a whole."""
    mixed = np.array([[1.0, 1.0], [1.0, -1.0], [0.0, 0.0]]) / 2**0.5
    separation = np.abs(spelled(mixed, np.zeros(3)))
    np.testing.assert_allclose(sorted(map(tuple, separation)), [(0, 1, 0), (1, 0, 0)], atol=1e-12)
    scale = np.array([0.6, 0.8, 0.0])
    first, second = spelled(mixed, scale)
    np.testing.assert_allclose(first, scale, atol=1e-12)
    assert second @ scale == pytest.approx(0.0, abs=1e-12)
    assert directions(mixed, scale, ("a", "b", "c"))[0] == SCALE


def test_a_single_state_is_named_alone():
    words = directions(np.eye(6)[:, 5:], np.zeros(6), EKF.states)
    assert [each.sentence for each in words] == ["the data do not determine com_z"]


# --- Along a recording ------------------------------------------------------------------------


@cache
def views(moved: bool, gyro: float = 20.0, noise: float = 1.0):
    record = recording(60.0, move_at(30.0, 60.0) if moved else None, 5.0, gyro)
    testbed = platform(gyro=gyro > 0)
    if testbed.gyro is not None:
        testbed = replace(testbed, gyro=replace(testbed.gyro, noise=noise * testbed.gyro.noise))
    return {v.name: v for v in filters_along(followed(record, testbed, Params()))}


def test_a_free_recording_shows_all_but_the_scale():
    found = views(moved=False)
    whole = found[WHOLE.name]
    assert (whole.possible, whole.rank, whole.size) == (11, 11, 12)
    assert whole.unobservable == (SCALE,)
    for name in (KF.name, EKF.name, CAMERA.name, REDUCED.name):
        view = found[name]
        assert view.possible == view.rank == view.size
        assert view.unobservable == ()


def test_a_recording_with_a_move_shows_all_twelve():
    whole = views(moved=True)[WHOLE.name]
    assert (whole.possible, whole.rank, whole.unobservable) == (12, 12, ())


def test_noise_hides_what_exact_sensors_would_show():
    """A gyro a thousand times worse: fewer directions, and they are named."""
    whole = views(moved=True, noise=1000.0)[WHOLE.name]
    assert whole.possible == 12
    assert whole.rank < 12
    assert len(whole.unobservable) == 12 - whole.rank


def test_without_a_gyro_filters_that_need_one_have_no_rank():
    found = views(moved=True, gyro=0.0)
    assert found[EKF.name].rank is None
    assert found[EKF.name].possible == 6
    assert found[CAMERA.name].rank == 9


def test_a_filter_without_its_sensor_is_evaluated_at_every_node():
    """Rates of a camera-only record are none: possible ranks are the same as with a gyro."""
    without, having = views(moved=False, gyro=0.0), views(moved=False)
    assert [v.possible for v in without.values()] == [v.possible for v in having.values()]


def test_slopes_are_those_of_published_filters():
    """F - E over T of the 6-state filter: J^-1([Jw x] - [w x]J) and -m J^-1 [g x]."""
    along = free()
    J, w, g = along.inertia[0, 0], along.rate[0, 0], along.gravity[0, 0]
    found = EKF.slopes(along)[0, 0]
    np.testing.assert_allclose(found[:, :3], np.linalg.solve(J, skew(J @ w) - skew(w) @ J))
    np.testing.assert_allclose(found[:, 3:], -MASS * np.linalg.solve(J, skew(g)))
    assert rate_inertia_moment(along).shape[-2:] == (3, 12)
