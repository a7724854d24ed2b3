"""Steps of the search: consistent coordinates, and never out of the bodies that can exist."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from equipoise.dynamics.regressor import N_TORQUES
from equipoise.estimation.parameters import retraction
from equipoise.estimation.parameters.fit_parameters import (
    JP,
    Layout,
    R,
    Unknowns,
    physical,
    unknowns_of,
)
from equipoise.maths.attitude import difference, exponential, multiply
from equipoise.maths.levenberg_marquardt import promise
from equipoise.maths.linalg import pack_symmetric, unpack_symmetric
from equipoise.maths.pseudo_inertia import FLOOR, from_inertia
from equipoise.maths.scaled_solve import scaled_solve
from equipoise.model.mass_properties import parallel_axis, second_moments, smallest_second_moment
from equipoise.sensors.camera import N_SENSOR
from tests.support.builders import ATTITUDE, COM, INERTIA, MASS, RATE

LAYOUT = Layout(("viscous_y", "sag_xz"), ("error_x_1",), bias=True)
FLAT = np.array([0.4, 0.5, 0.899, 0.0, 0.0, 0.0])  # least second moment (0.4 + 0.5 - 0.899) / 2
# J by 5e-4 kg m2: the platform is flat, its least second moment is 4e-3
SIZES = np.repeat([0.03, 0.02, 5e-4, 1e-5, 1e-4, 1e-6, 1e-3], [3, 3, 6, 3, 1, 1, 4])
steps = arrays(np.float64, LAYOUT.size, elements=st.floats(-1.0, 1.0)).map(lambda s: s * SIZES)


def point(inertia=INERTIA, com=COM) -> Unknowns:
    six = from_inertia(unpack_symmetric(inertia) - parallel_axis(MASS, com))
    return Unknowns(
        ATTITUDE, RATE, six, com, np.zeros(N_TORQUES), np.zeros(N_SENSOR), np.zeros(1), np.zeros(3)
    )


def local(seed: int, pull: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A and b with the free optimum at ``pull`` and correlated unknowns."""
    mix = np.random.default_rng(seed).normal(size=(40, LAYOUT.size)) / SIZES
    normal = mix.T @ mix
    return normal, normal @ pull


def retract(start, step, layout=LAYOUT) -> Unknowns:
    out = np.empty_like(start.flat)
    retraction.retract(start.flat, step, MASS, layout.slots, out)
    return unknowns_of(out)


def boundary(start, step):
    """Return the rows and gaps that there are."""
    rows, gaps = np.full((3, LAYOUT.size), np.nan), np.full(3, np.nan)
    count = retraction.boundary(start.flat, MASS, step, rows, gaps)
    return rows[:count], gaps[:count]


def possible_step(start, model, damping):
    step, work = np.empty(LAYOUT.size), retraction.step_work_for(LAYOUT.size)
    retraction.possible_step(start.flat, MASS, *model, damping, work, step)
    return step


# --- Plain twins ------------------------------------------------------------------------------


def plain_retract(start, step):
    """The same by matrices and quaternions, for a possible body."""
    torque = start.torque.copy()
    torque[[1, 11]] += step[15:17]
    com = start.com + step[R]
    inertia_P = start.body(MASS).inertia_P + unpack_symmetric(step[JP])
    six = from_inertia(inertia_P - parallel_axis(MASS, com))
    q0 = multiply(start.q0, exponential(step[:3]))
    error, bias = start.error + step[17:18], start.bias + step[18:]
    return Unknowns(q0, start.w0 + step[3:6], six, com, torque, np.zeros(N_SENSOR), error, bias)


def plain_boundary(start, step):
    """Rows and gaps from LAPACK's eigenvectors."""
    inertia, com = start.body(MASS).inertia_P, start.com + step[R]
    there = second_moments(inertia + unpack_symmetric(step[JP]) - parallel_axis(MASS, com))
    floor = FLOOR * np.trace(inertia)
    values, vectors = np.linalg.eigh(there)
    rows, gaps = [], []
    for v in vectors[:, values < floor].T:
        row = np.zeros(LAYOUT.size)
        row[JP] = [0.5, 0.5, 0.5, 0, 0, 0] - pack_symmetric(np.outer(v, v)) * [1, 1, 1, 2, 2, 2]
        row[R] = -2 * MASS * (v @ start.com) * v
        rows.append(row)
        gaps.append(2 * floor - v @ second_moments(start.body(MASS).inertia_C) @ v)
    return np.array(rows).reshape(-1, LAYOUT.size), np.array(gaps)


def plain_stride(step):
    return np.linalg.norm([*step[:6], *(step[JP] / np.trace(unpack_symmetric(FLAT)))])


def plain_step(start, model, damping):
    """By constrained normal equations, all at once."""
    free = scaled_solve(*model, damping)
    free = step = free / max(1.0, plain_stride(free))
    for _ in range(8):
        rows, gaps = plain_boundary(start, step)
        if not len(rows):
            break
        damped = model[0] + damping * np.diag(np.diag(model[0]))
        zero = np.zeros((len(rows), len(rows)))
        scale = np.append(SIZES, np.ones(len(rows)))
        both = np.block([[damped, rows.T], [rows, zero]]) * np.outer(scale, scale)
        step = (scale * np.linalg.solve(both, scale * np.append(damped @ free, gaps)))[: len(free)]
    return step / max(1.0, plain_stride(step))


@given(steps)
def test_retract_agrees_with_a_plain_twin(step):
    """Every part of the point; the six numbers by 1e-10, the body being flat."""
    found, expected = retract(point(), step), plain_retract(point(), step)
    np.testing.assert_allclose(found.flat, expected.flat, rtol=0, atol=1e-10)


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("size", [0.5, 1.0, 30.0])
def test_possible_step_agrees_with_a_plain_twin(seed, size):
    """Across one boundary or two, with and without damping, in units of the steps' own sizes."""
    rng = np.random.default_rng(seed)
    start = point(FLAT, np.array([5e-3, -2e-3, 4e-3]))
    pull = size * outward() + rng.normal(size=LAYOUT.size) * SIZES
    for damping in (0.0, 1e-3):
        model = local(seed, pull)
        found, expected = possible_step(start, model, damping), plain_step(start, model, damping)
        np.testing.assert_allclose(found / SIZES, expected / SIZES, rtol=1e-6, atol=1e-6)


def test_two_boundaries_at_once():
    """A step that would take both small moments of a rod away meets two of them."""
    rod = np.array([0.5, 0.5, 0.004, 0.0, 0.0, 0.0])
    step = np.zeros(LAYOUT.size)
    step[JP] = 0.0, 0.0, -0.01, 0.001, 0.0, 0.002
    rows, gaps = boundary(point(rod), step)
    by_hand = plain_boundary(point(rod), step)
    assert len(rows) == 2
    order = np.argsort(rows[:, JP.start])
    other = np.argsort(by_hand[0][:, JP.start])
    np.testing.assert_allclose(rows[order], by_hand[0][other], rtol=0, atol=1e-12)
    np.testing.assert_allclose(gaps[order], by_hand[1][other], rtol=0, atol=1e-15)
    model = local(1, step)
    after = retract(point(rod), possible_step(point(rod), model, 0.0)).body(MASS)
    assert smallest_second_moment(after.inertia_C) > 0


# --- Coordinates ------------------------------------------------------------------------------


def test_a_point_is_kept_flat_and_found_again():
    """The order is that of the record's fields."""
    error = 16 + N_TORQUES + N_SENSOR
    numbers = np.arange(error + 4.0)
    parts = unknowns_of(numbers)
    assert parts.flat.tolist() == numbers.tolist()
    assert (parts.q0[0], parts.w0[0], parts.six[0], parts.com[0]) == (0.0, 4.0, 7.0, 13.0)
    assert (parts.torque[0], parts.error.tolist(), parts.bias[0]) == (16.0, [error], error + 1)


def test_names_units_and_coordinates_have_one_length():
    """Optional unknowns come in the order: torques, errors, bias."""
    assert LAYOUT.size == 15 + 2 + 1 + 3
    assert len(LAYOUT.names) == len(LAYOUT.units) == LAYOUT.size
    assert LAYOUT.names[15:19] == ("viscous_y", "sag_xz", "error_x_1", "gyro_bias_x")
    assert len(physical(point(), MASS, LAYOUT)) == LAYOUT.size


@given(steps)
def test_a_step_adds_to_the_coordinates(step):
    """Each coordinate moves by its own part, to rounding; the first attitude turns by it."""
    before = point()
    after = retract(before, step)
    moved = physical(after, MASS, LAYOUT) - physical(before, MASS, LAYOUT)
    np.testing.assert_allclose(moved[3:], step[3:], rtol=0, atol=1e-15)
    np.testing.assert_allclose(difference(after.q0, before.q0), step[:3], atol=1e-14)


def test_each_torque_goes_to_its_own_place():
    """viscous_y is the second of the sixteen, sag_xz the twelfth."""
    step = np.zeros(LAYOUT.size)
    step[15:17] = 1.0, 2.0
    found = retract(point(), step).torque
    assert np.flatnonzero(found).tolist() == [1, 11]
    assert found[[1, 11]].tolist() == [1.0, 2.0]


def test_without_bias_the_bias_stays():
    """A layout without gyro has no place for it."""
    start, layout = point(), Layout(errors=("error_x_1",))
    start.bias[:] = 1.0
    after = retract(start, np.ones(layout.size), layout)
    assert after.error.tolist() == [1.0]
    assert after.bias.tolist() == [1.0] * 3


def outward() -> np.ndarray:
    """A step that takes zz beyond xx + yy."""
    step = np.zeros(LAYOUT.size)
    step[JP] = 0.003, -0.004, 0.004, 0.001, -0.002, 0.001
    step[R] = 2e-6, -3e-6, 1e-6
    return step


def second_moment_along(v, start, step):
    com = start.com + step[R]
    inertia = start.body(MASS).inertia_P + unpack_symmetric(step[JP])
    return v @ second_moments(inertia - parallel_axis(MASS, com)) @ v


def test_boundary_rows_are_the_derivative_of_the_second_moment():
    """d(v.Sigma_C v) by central differences of 1e-4, along the direction in which it gets lost."""
    start, step = point(FLAT, np.array([5e-3, -2e-3, 4e-3])), outward()
    rows, gaps = boundary(start, step)
    assert len(rows) == 1
    com = start.com + step[R]
    there = start.body(MASS).inertia_P + unpack_symmetric(step[JP]) - parallel_axis(MASS, com)
    v = np.linalg.eigh(second_moments(there))[1][:, 0]
    numeric = [
        (second_moment_along(v, start, e) - second_moment_along(v, start, -e)) / 2e-4
        for e in 1e-4 * np.eye(LAYOUT.size)
    ]
    np.testing.assert_allclose(rows[0], numeric, atol=1e-10)
    floor = gaps[0] + second_moment_along(v, start, np.zeros(LAYOUT.size))
    trace = np.trace(unpack_symmetric(FLAT))
    assert FLOOR * trace <= floor <= 10 * FLOOR * trace  # just inside what is kept possible


def test_a_possible_step_meets_no_boundary():
    """Well inside, nothing is in the way."""
    rows, gaps = boundary(point(), 0.1 * outward())
    assert rows.shape == (0, LAYOUT.size)
    assert gaps.shape == (0,)


@pytest.mark.parametrize("seed", range(3))
def test_inside_the_step_is_the_free_one(seed):
    """The optimum of the local model, damped as asked."""
    model = local(seed, 0.1 * outward())
    for damping in (1e-6, 0.5):
        found = possible_step(point(), model, damping)
        free = scaled_solve(*model, damping)
        np.testing.assert_allclose(found, free, rtol=1e-12)


@pytest.mark.parametrize("seed", range(3))
def test_at_the_boundary_the_step_is_the_best_possible(seed):
    """It ends on the boundary, and no change along the boundary lowers the local model."""
    start, model = point(FLAT), local(seed, outward())
    free = scaled_solve(*model, 0.0)
    assert len(boundary(start, free)[0]) == 1
    step = possible_step(start, model, 0.0)
    after = retract(start, step).body(MASS)
    least, trace = smallest_second_moment(after.inertia_C), np.trace(after.inertia_P)
    assert 0 < least < 1e-4 * trace  # the boundary is bent: its tangent leaves it a little
    rows, _ = boundary(start, free)
    left = (model[1] - model[0] @ step) * SIZES
    along = rows[0] * SIZES / np.linalg.norm(rows[0] * SIZES)
    across = left - along * (along @ left)
    assert np.linalg.norm(across) < 0.05 * np.linalg.norm(left)
    assert promise(*model, step) > 0


@pytest.mark.parametrize("name", ["attitude_y", "rate_z", "inertia_P_xx"])
def test_no_step_exceeds_the_step_limit(name):
    """A radian, a radian a second, the trace of J: a hundred times that is cut to one."""
    pull = np.zeros(LAYOUT.size)
    k = LAYOUT.names.index(name)
    pull[k] = 100.0 * (np.trace(unpack_symmetric(INERTIA)) if name.startswith("inertia") else 1.0)
    step = possible_step(point(), (np.eye(LAYOUT.size), pull), 0.0)
    trace = np.trace(unpack_symmetric(INERTIA))
    assert 0 < np.linalg.norm([*step[:6], *(step[JP] / trace)]) <= 1 + 1e-12


@given(steps, st.sampled_from([INERTIA, FLAT]))
def test_no_step_leaves_the_possible_bodies(step, inertia):
    """Even one that asks for it."""
    after = retract(point(inertia), 200 * step).body(MASS)
    assert smallest_second_moment(after.inertia_C) > 0
