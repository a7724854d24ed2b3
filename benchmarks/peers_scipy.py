"""SciPy: ``solve_ivp`` in stretches between knots, ``least_squares`` on forward differences.

What a careful user writes: J(d), mu(d) and the momentum of the travelling masses are exact, the
integration stops where the displacements have a kink, the tolerances are far below the noise, and
the difference steps far above the tolerances.
"""

import time

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import least_squares

from benchmarks import problem as bench
from benchmarks.problem import Array, PeerFit, Point, Problem

STEP = 0.01  # -, of SCALE, chosen: some 0.01 sd of a parameter; the integrator's noise is far less


def attitudes(problem: Problem, point: Point, method: str, rtol: float, atol: float) -> Array:
    """Return the attitude at the rows, (n, 4)."""
    grid = bench.grid_of(problem, with_rows=False)
    y = bench.first_state(problem, point, grid.d[0], grid.v[0])
    out = [y[None]]
    for start, end, d, v in zip(grid.edges, grid.edges[1:], grid.d, grid.v, strict=False):
        rows = problem.t[(problem.t > start) & (problem.t <= end)] - start
        rate = bench.stretch_rate(problem, point, d, v)
        span = (0.0, end - start)
        run = solve_ivp(rate, span, y, method, np.union1d(rows, span[1]), rtol=rtol, atol=atol)
        out.append(run.y.T[: len(rows)])
        y = run.y[:, -1]
    q = np.concatenate(out)[:, :4]
    return q / np.linalg.norm(q, axis=1, keepdims=True)


def fit(
    problem: Problem, method: str = "DOP853", rtol: float = 1e-8, atol: float = 1e-10
) -> tuple[PeerFit | None, str]:
    """Return the fit and a sentence on how it went."""
    began = time.perf_counter()

    def residual(x: Array) -> Array:
        q = attitudes(problem, bench.point_at(problem.start, x), method, rtol, atol)
        return bench.difference(q, problem.q_meas).ravel() / problem.sigma

    def jacobian(x: Array) -> Array:
        base = residual(x)
        steps = STEP * np.eye(15)
        return np.column_stack([(residual(x + step) - base) / STEP for step in steps])

    found = least_squares(residual, np.zeros(15), jacobian, method="lm", x_scale="jac")
    covariance = np.linalg.inv(found.jac.T @ found.jac)
    seconds = time.perf_counter() - began
    x = found.x
    point = bench.point_at(problem.start, x)
    name = f"SciPy {method}"
    result = PeerFit(name, x, point, found.cost, covariance, seconds, 0.0, found.njev or found.nfev)
    return result, found.message
