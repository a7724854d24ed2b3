"""Recursive least squares: the same as least squares, forgetting that is safe, live as filed."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.estimation.regression.formulations.rows import Rows
from equipoise.estimation.regression.solvers.recursive import (
    Recursion,
    advance,
    begin,
    begin_with,
    written_out,
)
from tests.estimation.regression.solvers.plain_recursive import plain_rls

NAMES = ("a", "b", "c", "d")
TRUTH = np.array([2.0, -1.0, 0.5, 3.0])
OUTLYING = 1e9  # a limit that nothing reaches


def random_rows(pieces, n=200, m=3, seed=0):
    """Rows of noise in every column, as many free constants as there are pieces."""
    rng = np.random.default_rng(seed)
    A = rng.normal(size=(n, m, 4))
    piece = np.arange(n) * pieces // n if pieces else None
    free = rng.normal(size=(max(pieces, 1), m)) * (5.0 if pieces else 0.0)
    b = A @ TRUTH + free[0 if piece is None else piece] + 0.1 * rng.normal(size=(n, m))
    return Rows(np.cumsum(rng.uniform(0.5, 1.5, n)), A, b, NAMES, piece)


def recursion(m=3, forget=np.inf, still=0.0, limit=OUTLYING):
    """Without guards unless asked."""
    noise = np.array([0.1, 0.2, 0.3])[:m]
    sd = np.array([3.0, 1.0, 2.0, 4.0])
    return Recursion(np.ones(4), sd, noise, 10.0, np.full(4, limit), forget, still)


def whole(rec, rows):
    return advance(rec, begin(rec, rows.piece is not None), rows)


def batch(rec, rows, lam_from=None):
    """Least squares on the rows and the start, each weighing exp(-age / forget)."""
    columns, pieces = written_out(rows)
    age = np.exp(-0.5 * (rows.t[-1] - rows.t) / rec.forget)
    weight = np.repeat(age, rows.b.shape[1]) / np.tile(rec.noise, len(rows.t))
    free = pieces * rows.b.shape[1]
    prior_sd = np.append(rec.sd, np.full(free, rec.free)) / age[0]
    prior = np.append(rec.start, np.zeros(free))
    M = np.vstack([columns * weight[:, None], np.diag(1 / prior_sd)])
    y = np.append(rows.b.reshape(-1) * weight, prior / prior_sd)
    normal = M.T @ M
    return np.linalg.solve(normal, M.T @ y), np.linalg.inv(normal)


def test_one_unknown_by_hand():
    """sd 2, noise 1: K = 4/5, x = 12/5, P = 4/5; then K = 4/9, x = 16/9, P = 4/9."""
    rec = Recursion(np.zeros(1), np.array([2.0]), np.ones(1), 0.0, np.array([OUTLYING]))
    rows = Rows(np.arange(2.0), np.ones((2, 1, 1)), np.array([[3.0], [1.0]]), ("a",))
    state, values, sd = whole(rec, rows)
    np.testing.assert_allclose(values[:, 0], [12 / 5, 16 / 9], rtol=1e-14)
    np.testing.assert_allclose(sd[:, 0] ** 2, [4 / 5, 4 / 9], rtol=1e-14)
    assert state.x.item() == values[-1, 0]


def test_one_unknown_by_hand_with_forgetting():
    """lam = 1/2 at the second row: P = 8/5 before it, K = 8/13, x = 12/5 - 7/5 x 8/13 = 20/13."""
    forget = 1 / np.log(2)
    rec = Recursion(
        np.zeros(1), np.array([2.0]), np.ones(1), 0.0, np.array([OUTLYING]), forget, 0.0
    )
    rows = Rows(np.arange(2.0), np.ones((2, 1, 1)), np.array([[3.0], [1.0]]), ("a",))
    _, values, sd = whole(rec, rows)
    assert values[1, 0] == pytest.approx(20 / 13, rel=1e-14)
    assert sd[1, 0] ** 2 == pytest.approx(8 / 13, rel=1e-14)


@pytest.mark.parametrize("m", [1, 3])
@pytest.mark.parametrize("pieces", [0, 1, 3])
@pytest.mark.parametrize("forget", [np.inf, 30.0])
def test_kernel_is_the_plain_matrix_form(m, pieces, forget):
    rec, rows = recursion(m, forget), random_rows(pieces, m=m)
    state, _, _ = whole(rec, rows)
    x, P = plain_rls(rec, rows)
    np.testing.assert_allclose(state.x, x, rtol=1e-9)
    np.testing.assert_allclose(state.P, P, rtol=1e-7, atol=1e-9 * P.max())


@pytest.mark.parametrize("m", [1, 3])
@pytest.mark.parametrize("pieces", [0, 1, 3])
def test_without_forgetting_it_is_least_squares(m, pieces):
    """With the start as rows of its own; constants of every piece are unknowns of their own."""
    rec, rows = recursion(m), random_rows(pieces, m=m)
    state, _, _ = whole(rec, rows)
    x, P = batch(rec, rows)
    np.testing.assert_allclose(state.x[:4], x[:4], rtol=1e-9)
    np.testing.assert_allclose(state.P[:4, :4], P[:4, :4], rtol=1e-8, atol=1e-8 * P[0, 0])


@pytest.mark.parametrize("pieces", [0, 1])
def test_forgetting_is_weighing_by_age(pieces):
    rec, rows = recursion(forget=20.0), random_rows(pieces)
    state, _, _ = whole(rec, rows)
    x, P = batch(rec, rows)
    np.testing.assert_allclose(state.x[:4], x[:4], rtol=1e-9)
    np.testing.assert_allclose(state.P[:4, :4], P[:4, :4], rtol=1e-8, atol=1e-8 * P[0, 0])


@pytest.mark.parametrize("pieces", [0, 1, 4])
def test_after_a_batch_start_the_initial_value_has_no_influence(pieces):
    """The first 70 rows at once, then one by one: least squares on all, 1e9 of start or not.

    Constants of later pieces begin with an sd of 1000: (0.3 / 1000)^2 / 50 rows = 2e-9.
    """
    rec, rows = replace(recursion(), free=1e3), random_rows(pieces)
    first, others = (part_of(rows, s) for s in (slice(70), slice(70, None)))
    for start in (rec, replace(rec, start=np.full(4, 1e9))):
        state = begin_with(start, first)
        state, _, _ = advance(start, state, others)
        columns, _ = written_out(rows)
        weight = 1 / np.tile(rec.noise, len(rows.t))
        best = np.linalg.lstsq(columns * weight[:, None], rows.b.reshape(-1) * weight)[0]
        np.testing.assert_allclose(state.x[:4], best[:4], rtol=1e-7 if pieces > 1 else 1e-9)


def test_a_batch_that_does_not_see_everything_begins_nothing():
    rows = random_rows(0)
    A = rows.A.copy()
    A[:, :, 3] = 2 * A[:, :, 1]
    assert begin_with(recursion(), replace(rows, A=A)) is None


@pytest.mark.parametrize("pieces", [0, 3])
def test_row_by_row_is_all_at_once(pieces):
    """With forgetting and both guards at work: identical, not only close."""
    rec = recursion(forget=15.0, still=3.0, limit=0.5)
    rows = random_rows(pieces)
    state, values, sd = whole(rec, rows)
    now, live = begin(rec, pieces > 0), []
    for k in range(len(rows.t)):
        now, *after = advance(rec, now, part_of(rows, slice(k, k + 1)))
        live.append(after)
    for a, b in zip(now, state, strict=True):
        assert np.array_equal(a, b)
    assert np.array_equal(np.vstack([v for v, _ in live]), values)
    assert np.array_equal(np.vstack([s for _, s in live]), sd)


def part_of(rows, part):
    piece = None if rows.piece is None else rows.piece[part]
    return Rows(rows.t[part], rows.A[part], rows.b[part], rows.names, piece)


# --- Forgetting ------------------------------------------------------------------------------


def rest(n=3000, seed=1):
    """A swing of 300 rows that shows everything, then rest: one of three directions is observable.

    Columns: a shown by motion alone; b and c by gravity at rest, where only b + c acts (as com at a
    tilt: no single column shows it); d shown throughout.
    """
    rng = np.random.default_rng(seed)
    A = rng.normal(size=(n, 1, 4))
    A[300:, 0, 0] = 0.05 * rng.normal(size=n - 300)  # noise in a regressor: says that a is zero
    A[300:, 0, 1] = A[300:, 0, 2] = 1.0 + 0.5 * rng.normal(size=n - 300)
    quiet = A.copy()
    quiet[300:, 0, 0] = 0.0
    b = quiet @ TRUTH + 0.1 * rng.normal(size=(n, 1))
    return Rows(0.1 * np.arange(n), A, b, NAMES)


def test_plain_forgetting_winds_up():
    """Along b - c P grows as exp(t / forget) at rest: 270 s / 10 s, e^27 in all."""
    _, _, sd = whole(recursion(1, forget=10.0), rest())
    assert sd[-1, 1] > 1e3
    assert sd[-1, 1] / sd[-101, 1] == pytest.approx(np.exp(0.5), rel=0.05)  # 10 s: e in P


def test_guarded_forgetting_stays_bounded():
    rec = recursion(1, forget=10.0, still=3.0, limit=0.3)
    state, values, sd = whole(rec, rest())
    assert np.all(sd[300:] <= 0.3 * (1 + 1e-9))
    assert np.linalg.eigvalsh(state.P).min() > 0
    np.testing.assert_allclose(values[-1], TRUTH, atol=0.6)  # two limits, along b - c


def test_what_rest_does_not_show_is_not_forgotten():
    """a is kept; forgotten (still = 0), noise in its column says that it is near zero."""
    _, values, sd = whole(recursion(1, forget=10.0, still=3.0, limit=0.3), rest())
    assert values[-1, 0] == pytest.approx(TRUTH[0], abs=0.1)
    assert sd[-1, 0] < 0.01
    _, careless, _ = whole(recursion(1, forget=10.0, limit=0.3), rest())
    assert abs(careless[-1, 0]) < 0.5 * TRUTH[0]


def test_with_free_constants_only_what_changes_of_a_column_counts():
    """An unknown whose column stands still is hidden by the constant, however large the column."""
    rows = random_rows(1, n=2000)
    A = rows.A.copy()
    A[300:, :, 0] = 7.0
    b = A @ TRUTH + 0.1 * np.random.default_rng(3).normal(size=rows.b.shape)
    rec = recursion(forget=20.0, still=3.0, limit=2.0)
    _, values, sd = whole(rec, replace(rows, A=A, b=b))
    assert sd[-1, 0] < 2 * sd[299, 0]
    assert values[-1, 0] == pytest.approx(TRUTH[0], abs=5 * sd[299, 0])


def test_an_unknown_that_steps_is_followed_with_forgetting_alone():
    """d steps by 2 half-way: without forgetting the mean of both remains."""
    rows = random_rows(0, n=2000)
    b = rows.b.copy()
    b[1000:] += 2.0 * rows.A[1000:, :, 3]
    rows = replace(rows, b=b)
    _, followed, sd = whole(recursion(forget=50.0, still=3.0, limit=1.0), rows)
    _, mean, _ = whole(recursion(), rows)
    assert followed[-1, 3] == pytest.approx(TRUTH[3] + 2, abs=4 * sd[-1, 3])
    assert followed[999, 3] == pytest.approx(TRUTH[3], abs=4 * sd[999, 3])
    assert mean[-1, 3] == pytest.approx(TRUTH[3] + 1, abs=0.2)
