"""CasADi: single shooting, exact Jacobian, Levenberg-Marquardt in NumPy.

One RK4 step per interval of ``problem.grid_of`` as an SX function of state, unknowns and interval.
Its derivatives are symbolic, and state and sensitivities go through one ``mapaccum``:
S' = (df/dy) S + df/dx. That is the same exact Jacobian as CasADi's own ``jacobian`` of the chain.
"""

import time
from typing import Any

import numpy as np

from benchmarks import problem as bench
from benchmarks.problem import Array, PeerFit, Problem

try:
    import casadi as ca
except ImportError:  # an extra
    ca = None

MISSING = "CasADi is not installed; pip install 'equipoise[peers]' would add it."
ITERATIONS = 60  # chosen: more than any start that converges has needed
DAMPING = 1.0  # -, at the start; 0.1 and less send 1-2 of 10 starts to a Jzz near zero
SMALL = 1e-6  # -, chosen: stop when a step promises less than this in chi-square (0.001 sd)


def _symmetric(six: Any) -> Any:
    xx, yy, zz, xy, xz, yz = ca.vertsplit(six)
    return ca.vertcat(ca.horzcat(xx, xy, xz), ca.horzcat(xy, yy, yz), ca.horzcat(xz, yz, zz))


def _multiply(p: Any, q: Any) -> Any:
    a, u, b, v = p[0], p[1:], q[0], q[1:]
    return ca.vertcat(a * b - ca.dot(u, v), a * v + b * u + ca.cross(u, v))


def _inertia(problem: Problem, home: Any, d: Any) -> Any:
    first, second = bench.slide_inertia(problem)
    for i in range(len(first)):
        home = home + d[i] * ca.DM(first[i]) + d[i] ** 2 * ca.DM(second[i])
    return home


def _rate(problem: Problem, y: Any, J: Any, h: Any, mu: Any) -> Any:
    q, H = y[:4], y[4:]
    c0, c1, c2 = ca.cross(J[1, :], J[2, :]), ca.cross(J[2, :], J[0, :]), ca.cross(J[0, :], J[1, :])
    b = H - h
    w = (c0 * b[0] + c1 * b[1] + c2 * b[2]).T / ca.dot(J[0, :], c0)
    a, b, c, d = ca.vertsplit(q)
    up = ca.vertcat(2 * (b * d - a * c), 2 * (c * d + a * b), a * a - b * b - c * c + d * d)
    turn = 0.5 * _multiply(q, ca.vertcat(0, w))
    return ca.vertcat(turn, ca.cross(H, w) - problem.gravity * ca.cross(mu, up))


def _step(problem: Problem, y: Any, p: Any, s: Any) -> Any:
    """Return the state after one RK4 step; ``p`` = [J 6, com 3], ``s`` = [dt, d, v]."""
    k = len(problem.slide_mass)
    dt, d, v = s[0], s[1 : 1 + k], s[1 + k :]
    home, mean = _symmetric(p[:6]), problem.mass * p[6:]
    h = ca.DM(np.cross(problem.slide_home, problem.slide_axis).T * problem.slide_mass) @ v
    weight = ca.DM(problem.slide_axis.T * problem.slide_mass)

    def rate(share: float, y: Any) -> Any:
        now = d + v * dt * share
        return _rate(problem, y, _inertia(problem, home, now), h, mean + weight @ now)

    k1 = rate(0.0, y)
    k2 = rate(0.5, y + dt / 2 * k1)
    k3 = rate(0.5, y + dt / 2 * k2)
    k4 = rate(1.0, y + dt * k3)
    return y + dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4)


def _start(problem: Problem, d: Array, v: Array) -> Any:
    """Return a function x -> first state and [J, com]."""
    x, s = ca.SX.sym("x", 15), problem.start
    step = x * ca.DM(bench.SCALE)
    p = ca.vertcat(ca.DM(s.inertia) + step[6:12], ca.DM(s.com) + step[12:])
    h = ca.DM(bench.slide_momentum(problem, v))
    H = _inertia(problem, _symmetric(p[:6]), ca.DM(d)) @ (ca.DM(s.rate) + step[3:6]) + h
    square = ca.dot(step[:3], step[:3])
    small = ca.vertcat(1 - square / 8 + square**2 / 384, step[:3] * (0.5 - square / 48))
    turn = small / ca.norm_2(small)  # the rotation vector's quaternion to the fifth order
    y = ca.vertcat(_multiply(ca.DM(s.q), turn), H)
    return ca.Function("start", [x], [y, p, ca.jacobian(y, x), ca.jacobian(p, x)])


def _chain(problem: Problem, n: int) -> Any:
    """Return the accumulated map of [y, S] over the intervals, S the sensitivities to x."""
    k = len(problem.slide_mass)
    y, p, s = ca.SX.sym("y", 7), ca.SX.sym("p", 9), ca.SX.sym("s", 1 + 2 * k)
    S, P = ca.SX.sym("S", 7, 15), ca.SX.sym("P", 9, 15)
    new = _step(problem, y, p, s)
    S_new = ca.jacobian(new, y) @ S + ca.jacobian(new, p) @ P
    inner = ca.horzcat(y, S)
    step = ca.Function("step", [inner, p, P, s], [ca.horzcat(new, S_new)])
    return step.mapaccum(n)


def _residual_function(n: int) -> Any:
    """Return (q, dq/dx, q_meas) -> rotation vector and its derivative, over the rows."""
    q, m, Q = ca.SX.sym("q", 4), ca.SX.sym("m", 4), ca.SX.sym("Q", 4, 15)
    e = _multiply(ca.vertcat(q[0], -q[1:]), m) / ca.norm_2(q)
    e = e * ca.if_else(e[0] < 0, -1, 1)
    sine = ca.sqrt(ca.dot(e[1:], e[1:]) + 1e-30)
    vector = 2 * ca.atan2(sine, e[0]) / sine * e[1:]
    row = ca.Function("row", [q, Q, m], [vector, ca.jacobian(vector, q) @ Q])
    return row.map(n)


def _build(problem: Problem) -> Any:
    """Return a function x -> residual, Jacobian."""
    grid = bench.grid_of(problem)
    n, rows = len(grid.d), grid.rows
    start, chain = _start(problem, grid.d[0], grid.v[0]), _chain(problem, n)
    observed = _residual_function(len(rows))
    inputs = ca.DM(np.column_stack([np.diff(grid.edges), grid.d, grid.v]).T)
    measured = ca.DM(problem.q_meas.T)

    def evaluate(x: Array) -> tuple[Array, Array]:
        y, p, S, P = start(x)
        first = ca.horzcat(y, S)
        later = chain(first, p, P, inputs)
        states = np.hstack([np.asarray(first), np.asarray(later)]).reshape(7, n + 1, 16)[:4, rows]
        Q = ca.DM(states[:, :, 1:].reshape(4, -1))
        r, A = observed(ca.DM(states[:, :, 0]), Q, measured)
        A = np.asarray(A).reshape(3, len(rows), 15).transpose(1, 0, 2).reshape(-1, 15)
        return np.asarray(r).T.ravel() / problem.sigma, A / problem.sigma

    return evaluate


def _minimise(evaluate: Any) -> tuple[Array, float, Array, int]:
    """Return x, cost, covariance and iterations: Levenberg-Marquardt with Marquardt's scaling."""
    x, damping, count = np.zeros(15), DAMPING, 0
    done = False
    r, A = evaluate(x)
    while count < ITERATIONS and not done:
        count += 1
        N = A.T @ A
        step = -np.linalg.solve(N + damping * np.diag(np.diag(N)), A.T @ r)
        r_new, A_new = evaluate(x + step)
        better = r_new @ r_new < r @ r
        if better:
            x, r, A = x + step, r_new, A_new
        damping = damping / 10 if better else damping * 10
        done = step @ N @ step < SMALL
    return x, 0.5 * float(r @ r), np.linalg.inv(A.T @ A), count


def fit(problem: Problem, repeats: int = 3) -> tuple[PeerFit | None, str]:
    """Return the fit (median of ``repeats``, building apart) and a sentence."""
    if ca is None:
        return None, MISSING
    began = time.perf_counter()
    evaluate = _build(problem)
    setup = time.perf_counter() - began
    spent = []
    for _ in range(repeats):
        began = time.perf_counter()
        x, cost, covariance, count = _minimise(evaluate)
        spent.append(time.perf_counter() - began)
    point = bench.point_at(problem.start, x)
    seconds = float(np.median(spent))
    name = "CasADi single shooting"
    result = PeerFit(name, x, point, cost, covariance, seconds, setup, count)
    return result, f"CasADi {ca.__version__}, built in {setup:.2f} s."
