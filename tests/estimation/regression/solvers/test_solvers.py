"""How rows are solved: by hand, against one another, and against noise in the regressor."""

from dataclasses import replace

import clarabel
import numpy as np
import pytest
from scipy import sparse

from equipoise.estimation.regression.formulations.rows import BODY, Rows, centred, held, values_of
from equipoise.estimation.regression.solvers.corrected import corrected
from equipoise.estimation.regression.solvers.instrumental import instrumental
from equipoise.estimation.regression.solvers.least_squares import Aid, least_squares
from equipoise.estimation.regression.solvers.levenberg_marquardt import damped
from equipoise.estimation.regression.solvers.physically_consistent import possible
from equipoise.estimation.regression.solvers.robust import robust
from equipoise.estimation.regression.solvers.weighted import weighted
from equipoise.maths.linalg import unpack_symmetric
from equipoise.model.mass_properties import MassProperties, is_possible, smallest_second_moment
from tests.support.builders import platform

TESTBED = platform()
NO_NOISE = Aid(TESTBED, np.zeros((9, 9)), np.zeros(9))
TRUTH = np.array(list(values_of(TESTBED).values()))
SOLVERS = (least_squares, weighted, robust, corrected, damped, possible, instrumental)


def aid(c):
    return Aid(TESTBED, np.zeros((c, c)), np.zeros(c))


def rows_for(truth, noise=1e-4, pieces=1, seed=0, n=400):
    """Rows of the body's nine numbers, with free constants, of noise in b alone."""
    rng = np.random.default_rng(seed)
    size = np.append(np.ones(6), np.full(3, 1e4))
    A = rng.normal(size=(n, 3, 9)) * size
    piece = np.arange(n) * pieces // n
    constant = rng.normal(size=(pieces, 3))[piece]
    b = A @ truth + constant + noise * rng.normal(size=(n, 3))
    return Rows(np.arange(float(n)), A, b, BODY, piece, A)


def with_columns(names, A, b, **more):
    return Rows(np.arange(float(len(b))), A, b, names, **more)


def test_least_squares_by_hand():
    """x = (1 x 3 + 2 x 4) / (1 + 4) = 11/5 from the rows x = 3 and 2 x = 4."""
    rows = with_columns(("com_x",), np.array([[[1.0]], [[2.0]]]), np.array([[3.0], [4.0]]))
    assert least_squares(rows, aid(1)).item() == pytest.approx(11 / 5, rel=1e-12)


def test_a_free_constant_by_hand():
    """A line through (0, 1), (1, 2), (2, 4): slope 3/2, whatever its height."""
    A, b = np.arange(3.0).reshape(3, 1, 1), np.array([[1.0], [2.0], [4.0]])
    rows = with_columns(("com_x",), A, b, piece=np.zeros(3, np.int64))
    assert least_squares(rows, aid(1)).item() == pytest.approx(1.5, rel=1e-12)


def test_centring_is_what_free_constants_are():
    """Three pieces, nine constants written out as columns of their own: the same solution.

    To rounding: 1e-7 of the sd that rows of this noise give.
    """
    rows = rows_for(TRUTH, 1e-2, pieces=3)
    constants = np.zeros((400, 3, 9))
    for k, piece in enumerate(rows.piece):
        constants[k, :, 3 * piece : 3 * piece + 3] = np.eye(3)
    whole = np.concatenate([rows.A, constants], axis=2).reshape(-1, 18)
    found = np.linalg.lstsq(whole, rows.b.reshape(-1))[0][:9]
    sd = 1e-2 / np.sqrt(1200) / np.append(np.ones(6), np.full(3, 1e4))
    assert np.all(np.abs(least_squares(rows, NO_NOISE) - found) < 1e-7 * sd)


def test_what_is_held_goes_to_the_other_side():
    """J_zz held at the truth: what is left of the rows is the same, with a column less."""
    rows = rows_for(TRUTH, 0.0)
    fewer = held(rows, TESTBED, ("inertia_P_zz",))
    assert fewer.names == tuple(name for name in BODY if name != "inertia_P_zz")
    np.testing.assert_allclose(least_squares(fewer, aid(8)), np.delete(TRUTH, 2), rtol=1e-9)


@pytest.mark.parametrize("solver", SOLVERS)
def test_every_solver_finds_the_truth_of_sound_rows(solver):
    """To 5 of the sd that rows of this noise give: 1e-4 / sqrt(1200), com 1e4 times less."""
    found = solver(rows_for(TRUTH), NO_NOISE)
    sd = 1e-4 / np.sqrt(1200) / np.append(np.ones(6), np.full(3, 1e4))
    assert np.all(np.abs(found - TRUTH) < 5 * sd)


@pytest.mark.parametrize("solver", [damped, possible, corrected])
def test_solvers_agree_where_nothing_binds(solver):
    """Marquardt at its end, possible inside, corrected without noise: least squares, to 1e-6."""
    rows = rows_for(TRUTH, 1e-3, pieces=2)
    np.testing.assert_allclose(solver(rows, NO_NOISE), least_squares(rows, NO_NOISE), rtol=1e-6)


def test_weights_follow_what_is_left():
    """An axis a hundred times as noisy as the others: nearly as if it were not there."""
    rng, rows = np.random.default_rng(1), rows_for(TRUTH, 1e-4)
    noisy = replace(rows, b=rows.b + rng.normal(size=(400, 1)) * [1e-2, 0, 0])
    without = replace(rows, A=rows.A[:, 1:], b=rows.b[:, 1:])
    sd = 1e-4 / np.sqrt(800) / np.append(np.ones(6), np.full(3, 1e4))
    best, plain = weighted(noisy, NO_NOISE), least_squares(noisy, NO_NOISE)
    assert np.all(np.abs(best - least_squares(without, NO_NOISE)) < sd)
    assert np.max(np.abs(plain - TRUTH) / sd) > 10


def test_robust_passes_over_gross_errors():
    """One time in twenty off by ten thousand sd: within 5 sd, least squares hundreds off."""
    rng, rows = np.random.default_rng(2), rows_for(TRUTH, 1e-4)
    odd = (rng.random((400, 1)) < 0.05) * rng.normal(size=(400, 3))
    off = replace(rows, b=rows.b + odd)
    sd = 1e-4 / np.sqrt(1200) / np.append(np.ones(6), np.full(3, 1e4))
    assert np.all(np.abs(robust(off, NO_NOISE) - TRUTH) < 5 * sd)
    assert np.max(np.abs(least_squares(off, NO_NOISE) - TRUTH) / sd) > 100


# --- Noise in the regressor -------------------------------------------------------------------


def noisy_regressor(seed, n=4000):
    """Rows whose columns are measured with noise of 0.5 of their own size."""
    rng = np.random.default_rng(seed)
    truth, clean = np.array([2.0, -1.0]), rng.normal(size=(n, 1, 2))
    b = clean @ truth
    observed, others = (clean + 0.5 * rng.normal(size=clean.shape) for _ in range(2))
    return truth, with_columns(("com_x", "com_y"), observed, b, instruments=others)


def test_noise_pulls_least_squares_towards_zero_by_its_share():
    """By 0.25 / 1.25 = a fifth; corrected and instrumental are right to 5 sd of some 0.02."""
    truth, rows = noisy_regressor(3)
    reported = Aid(TESTBED, 0.25 * 4000 * np.eye(2), np.zeros(2))
    np.testing.assert_allclose(least_squares(rows, reported), 0.8 * truth, atol=0.08)
    np.testing.assert_allclose(corrected(rows, reported), truth, atol=0.1)
    np.testing.assert_allclose(instrumental(rows, reported), truth, atol=0.1)


def test_noise_that_both_sides_share_is_taken_off():
    """b measured with half of A's noise: E[dA^T db] is given, and corrected is right."""
    truth, rows = noisy_regressor(4)
    rng = np.random.default_rng(5)
    dA = 0.5 * rng.normal(size=rows.A.shape)
    clean = rows.b
    both = replace(rows, A=rows.A + dA, b=clean + 0.5 * dA[:, :, 0])
    gram, cross = 4000 * 0.5 * np.eye(2), np.array([4000 * 0.5 * 0.25, 0.0])
    np.testing.assert_allclose(corrected(both, Aid(TESTBED, gram, cross)), truth, atol=0.15)


# --- Bodies that can exist --------------------------------------------------------------------

FLAT = np.array([0.30, 0.30, 0.70, 0.02, -0.01, 0.03, 1e-5, -2e-5, -8e-5])  # Jxx + Jyy < Jzz


def lmi(rows):
    """The same by a conic solver: least |A x - b|^2 with Sigma(J) - m r r^T >= 0.

    [[Sigma, mu], [mu^T, m]] >= 0 is linear in J and mu; the cone wants its upper triangle with
    sqrt(2) off the diagonal.
    """
    rows = centred(rows)
    A, b = rows.A.reshape(-1, 9), rows.b.reshape(-1)
    scale = 1 / np.sqrt(np.sum(A**2, axis=0))
    P, q = 2 * (A * scale).T @ (A * scale), -2 * (A * scale).T @ b
    mass, root, half = TESTBED.body.mass, np.sqrt(2.0), 0.5
    # Sigma = tr(J)/2 E - J by J xx yy zz xy xz yz; columns of the matrix one after the other
    G = np.zeros((10, 9))
    G[0, :3] = -half, half, half
    G[1, 3] = -root
    G[2, :3] = half, -half, half
    G[3, 4], G[4, 5] = -root, -root
    G[5, :3] = half, half, -half
    G[6, 6], G[7, 7], G[8, 8] = (root * mass * 1e2,) * 3
    h = np.zeros(10)
    h[9] = mass * 1e4  # the last row and column in 1e-2 m, for balance
    settings = clarabel.DefaultSettings()
    settings.verbose, settings.tol_gap_abs, settings.tol_gap_rel = False, 1e-14, 1e-14
    settings.tol_feas = 1e-12
    solver = clarabel.DefaultSolver(
        sparse.csc_matrix(np.triu(P)), q, sparse.csc_matrix(-G * scale), h,
        [clarabel.PSDTriangleConeT(4)], settings,
    )  # fmt: skip
    return scale * np.array(solver.solve().x)


def test_an_impossible_solution_is_moved_to_the_border():
    """Jxx + Jyy < Jzz no body has: the answer is a body, and least squares leave more than that."""
    rows = rows_for(FLAT, 1e-3)
    free, found = least_squares(rows, NO_NOISE), possible(rows, NO_NOISE)
    bodies = [MassProperties(TESTBED.body.mass, x[6:], unpack_symmetric(x[:6]))
              for x in (free, found)]  # fmt: skip
    assert not is_possible(bodies[0])
    assert smallest_second_moment(bodies[1].inertia_C) > -1e-9


@pytest.mark.parametrize("truth", [TRUTH, FLAT], ids=["inside", "on the border"])
def test_log_cholesky_agrees_with_the_convex_form(truth):
    """The same minimum as a linear matrix inequality has, to 1e-4 kg m2 and 1e-8 m."""
    rows = rows_for(truth, 1e-3)
    found, convex = possible(rows, NO_NOISE), lmi(rows)
    np.testing.assert_allclose(found[:6], convex[:6], atol=1e-4)
    np.testing.assert_allclose(found[6:], convex[6:], atol=1e-8)
