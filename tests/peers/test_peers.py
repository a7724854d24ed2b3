"""Every peer reaches the same optimum of the same problem, with the same covariance."""

from dataclasses import replace

import numpy as np
import pytest

from benchmarks import peers_casadi, peers_jax, peers_mujoco, peers_scipy
from benchmarks import problem as bench

OTHERS = {"jax": peers_jax.fit, "casadi": peers_casadi.fit}


@pytest.fixture(scope="module")
def short():
    """15 s at 4 Hz, a good camera: 61 rows see all fifteen unknowns."""
    return bench.make_problem(0, duration=15.0, rate=4.0, noise=np.deg2rad(0.002), spread=0.05)


@pytest.fixture(scope="module")
def scipy_fit(short):
    return peers_scipy.fit(short)[0]


def newton_step(problem, fit):
    """Return where a Newton step on central differences of the cost would go, in sd."""

    def cost(x):
        q = bench.simulate(problem, bench.point_at(problem.start, x), 0.1)
        return 0.5 * np.sum((bench.difference(q, problem.q_meas) / problem.sigma) ** 2)

    one = 1 / np.sqrt(np.diag(np.linalg.inv(fit.covariance)))  # sd with the others held
    slope = [(cost(fit.x + s) - cost(fit.x - s)) / (2 * s.sum()) for s in np.diag(0.1 * one)]
    return fit.covariance @ np.array(slope) / fit.sd


def test_scipy_ends_at_a_stationary_point(short, scipy_fit):
    """By another integrator and another slope, the optimum is less than 0.1 sd away."""
    assert np.abs(newton_step(short, scipy_fit)).max() < 0.1


def test_scipy_explains_the_noise_and_finds_the_truth(short, scipy_fit):
    freedom = 3 * len(short.t) - 15
    assert 2 * scipy_fit.cost == pytest.approx(freedom, abs=4 * np.sqrt(2 * freedom))
    error = scipy_fit.x - bench.offset_of(short.start, short.truth)
    assert error @ np.linalg.solve(scipy_fit.covariance, error) < 37.7  # 99.9 % of chi-square, 15


@pytest.mark.parametrize("name", OTHERS)
def test_the_others_reach_the_same_optimum(name, short, scipy_fit):
    """Within 0.1 sd, cost within 0.01, standard deviations within 1 %."""
    found, sentence = OTHERS[name](short, repeats=1)
    if found is None:
        pytest.skip(sentence)
    assert np.abs((found.x - scipy_fit.x) / scipy_fit.sd).max() < 0.1
    assert found.cost == pytest.approx(scipy_fit.cost, abs=0.01)
    np.testing.assert_allclose(found.sd, scipy_fit.sd, rtol=0.01)
    assert found.seconds > 0


needs_mujoco = pytest.mark.skipif(peers_mujoco.sysid is None, reason=peers_mujoco.MISSING)


@needs_mujoco
@pytest.mark.parametrize("away", [0.0, 1.0, 4.0])
def test_mujocos_residual_is_that_of_the_problems_own_model(short, away):
    """Masses are held by servos: attitudes agree within 1 urad, while the move turns by 30 mrad."""
    point = bench.point_at(short.truth, away * np.resize([1.0, -1.0, -0.5], 15))  # less flat
    turn, theta = bench.difference(short.start.q, point.q), peers_mujoco.theta_of(short, point)
    unknown = np.concatenate([turn, point.rate, theta])
    residual = peers_mujoco.residual_function(short)
    found = residual(unknown, peers_mujoco.unknowns_of(short))[0][0]
    own = bench.difference(bench.simulate(short, point, 0.1), short.q_meas).ravel()
    np.testing.assert_allclose(found * short.sigma, own, rtol=0, atol=1e-6)


@needs_mujoco
def test_mujocos_unknowns_and_points_are_a_pair(short):
    truth = short.truth
    turn, theta = bench.difference(short.start.q, truth.q), peers_mujoco.theta_of(short, truth)
    point = peers_mujoco.point_at(short, np.concatenate([turn, truth.rate, theta]))
    np.testing.assert_allclose(bench.offset_of(truth, point), np.zeros(15), atol=1e-7)


@needs_mujoco
def test_mujocos_fit_reaches_the_same_optimum():
    """From 2 in Mahalanobis distance; from the bench's start it takes a minute.

    Seed 7: at its optimum the body without masses is a possible one, which MuJoCo demands.
    """
    problem = bench.make_problem(7, duration=15.0, rate=4.0, noise=np.deg2rad(0.002), spread=0.05)
    own, _ = peers_scipy.fit(problem)
    aside = np.linalg.cholesky(own.covariance) @ np.full(15, 0.5)
    found, _ = peers_mujoco.fit(replace(problem, start=bench.point_at(own.point, aside)))
    assert np.abs((found.x + aside) / own.sd).max() < 0.1
    assert found.cost == pytest.approx(own.cost, abs=0.01)
    np.testing.assert_allclose(found.sd, own.sd, rtol=0.01)
    assert found.seconds > 0


@needs_mujoco
def test_mujoco_starts_at_a_body_that_can_be_compiled(short):
    """Jzz of more than Jxx + Jyy belongs to no body: the start is the nearest that can be."""
    flat = replace(short.start, inertia=np.array([0.3, 0.3, 0.7, 0.0, 0.0, 0.0]))
    problem = replace(short, start=flat)
    residual = peers_mujoco.residual_function(problem)
    unknowns = peers_mujoco.unknowns_of(problem)
    assert np.isfinite(residual(unknowns.as_vector(), unknowns)[0][0]).all()


def test_a_batch_is_its_fits_one_by_one(short):
    other = replace(short, q_meas=bench.product(short.q_meas, bench.rotation(np.full(3, 1e-6))))
    found, sentence = peers_jax.fit_batch([short, other], repeats=1)
    if found is None:
        pytest.skip(sentence)
    for problem, one in zip([short, other], found, strict=True):
        alone, _ = peers_jax.fit(problem, repeats=1)
        assert np.abs((one.x - alone.x) / alone.sd).max() < 1e-3


@pytest.mark.parametrize(
    ("peer", "library"), [(peers_jax, "jax"), (peers_casadi, "ca"), (peers_mujoco, "sysid")]
)
def test_a_missing_library_is_a_sentence(peer, library, short, monkeypatch):
    monkeypatch.setattr(peer, library, None)
    assert peer.fit(short) == (None, peer.MISSING)
    assert "not installed" in peer.MISSING


@pytest.mark.parametrize("method", ["DOP853", "RK45"])
def test_solve_ivp_and_runge_kutta_agree(method):
    """Knots need not fall on rows: 3 Hz against a move at 7.5 s that ends at 8.5 and 12.5 s."""
    problem = bench.make_problem(1, duration=15.0, rate=3.0)
    q = peers_scipy.attitudes(problem, problem.truth, method, 1e-8, 1e-10)
    assert len(q) == len(problem.t)
    assert np.abs(bench.difference(q, bench.simulate(problem, problem.truth))).max() < 1e-7


def test_unknowns_and_points_are_a_pair():
    problem = bench.make_problem(2, duration=4.0)
    x = np.linspace(-3.0, 3.0, 15)
    there_and_back = bench.offset_of(problem.start, bench.point_at(problem.start, x))
    np.testing.assert_allclose(there_and_back, x, atol=1e-7)


def test_one_seed_is_one_problem():
    first, again, other = (bench.make_problem(seed, duration=4.0) for seed in (5, 5, 6))
    np.testing.assert_array_equal(first.q_meas, again.q_meas)
    assert np.abs(first.q_meas - other.q_meas).max() > 1e-3


def test_the_full_problem_is_the_papers():
    problem = bench.make_problem(0)
    assert len(problem.t) == 601
    np.testing.assert_allclose(problem.knot_t, [60.0, 61.0, 65.0])
    np.testing.assert_allclose(problem.knot_d[-1], [-0.010, -0.010, -0.050])
    np.testing.assert_array_equal(problem.knot_d[0], 0.0)
    tilt = np.arccos(1 - 2 * np.sum(problem.truth.q[1:3] ** 2))
    assert np.rad2deg(tilt) == pytest.approx(4.0)
