"""JAX: ``lax.scan`` over RK4 steps from row to row, ``jacfwd``, Levenberg-Marquardt, all under jit.

One step per interval of ``problem.grid_of`` (0.2 s at 5 Hz; its error is 1e-8 rad, the bench's
``simulate`` says so), double precision, and a closed-form solution of the 3 x 3 system: with
``jnp.linalg.inv`` there a batch is nine times slower.
"""

import time
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from benchmarks import problem as bench
from benchmarks.problem import PeerFit, Problem

try:
    import jax
    import jax.numpy as jnp
    from jax import lax
except ImportError:  # an extra
    jax = None

MISSING = "JAX is not installed; pip install 'equipoise[peers]' would add it."
ITERATIONS = 60  # chosen: more than any start that converges has needed
DAMPING = 1.0  # -, at the start; 0.1 and less send 1-2 of 10 starts to a Jzz near zero
SMALL = 1e-6  # -, chosen: stop when a step promises less than this in chi-square (0.001 sd)


def _known(problem: Problem) -> dict[str, Any]:
    """Return what does not depend on the unknowns, as arrays along the intervals."""
    grid = bench.grid_of(problem)
    dt = np.diff(grid.edges)
    knots = grid.d[:, None] + np.array([0, 0.5, 1.0])[:, None] * (dt[:, None] * grid.v)[:, None]
    first, second = bench.slide_inertia(problem)
    change = np.einsum("nsk,kij->nsij", knots, first) + np.einsum("nsk,kij->nsij", knots**2, second)
    weight = problem.slide_mass[:, None] * problem.slide_axis
    h = np.array([bench.slide_momentum(problem, v) for v in grid.v])
    stages = {"dt": dt, "J": change, "mu": knots @ weight, "h": h}
    return {"stages": stages, "rows": grid.rows, "mass": problem.mass, "g": problem.gravity}


def _own(problem: Problem) -> dict[str, Any]:
    """Return what differs from record to record."""
    s = problem.start
    return {
        "q_meas": problem.q_meas,
        "sigma": problem.sigma,
        "start": np.concatenate([s.q, s.rate, s.inertia, s.com]),
    }


def _solve(J: Any, b: Any) -> Any:
    """Return J^-1 b of a symmetric 3 x 3 by cofactors."""
    r0, r1, r2 = jnp.cross(J[1], J[2]), jnp.cross(J[2], J[0]), jnp.cross(J[0], J[1])
    return (r0 * b[0] + r1 * b[1] + r2 * b[2]) / (J[0] @ r0)


def _multiply(p: Any, q: Any) -> Any:
    a, u, b, v = p[..., :1], p[..., 1:], q[..., :1], q[..., 1:]
    scalar = a * b - jnp.sum(u * v, axis=-1, keepdims=True)
    return jnp.concatenate([scalar, a * v + b * u + jnp.cross(u, v)], axis=-1)


def _turn(v: Any) -> Any:
    """Return the unit quaternion of a rotation vector; smooth at zero."""
    square = v @ v
    small = square < 1e-8
    angle = jnp.sqrt(jnp.where(small, 1.0, square))
    sine = jnp.where(small, 0.5 - square / 48, jnp.sin(angle / 2) / angle)
    cosine = jnp.where(small, 1 - square / 8, jnp.cos(angle / 2))
    return jnp.concatenate([cosine[None], sine * v])


def _vector(e: Any) -> Any:
    """Return rotation vectors of unit quaternions (n, 4), the shorter way; smooth at zero."""
    e = jnp.where(e[:, :1] < 0, -e, e)
    square = jnp.sum(e[:, 1:] ** 2, axis=1, keepdims=True)
    small = square < 1e-12
    sine = jnp.sqrt(jnp.where(small, 1.0, square))
    factor = 2 * jnp.arctan2(sine, e[:, :1]) / sine
    return jnp.where(small, 2 / e[:, :1], factor) * e[:, 1:]


def _rate(y: Any, J: Any, h: Any, mu: Any, g: Any) -> Any:
    q, H = y[:4], y[4:]
    w = _solve(J, H - h)
    a, b, c, d = q
    up = jnp.array([2 * (b * d - a * c), 2 * (c * d + a * b), a * a - b * b - c * c + d * d])
    turn = 0.5 * _multiply(q, jnp.concatenate([jnp.zeros(1), w]))
    return jnp.concatenate([turn, jnp.cross(H, w) - g * jnp.cross(mu, up)])


def _attitudes(known: dict[str, Any], start: Any, x: Any) -> Any:
    step = jnp.asarray(bench.SCALE) * x
    xx, yy, zz, xy, xz, yz = start[7:13] + step[6:12]
    home = jnp.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    mean, stages = known["mass"] * (start[13:] + step[12:]), known["stages"]
    H = (home + stages["J"][0, 0]) @ (start[4:7] + step[3:6]) + stages["h"][0]
    y = jnp.concatenate([_multiply(start[:4], _turn(step[:3])), H])

    def advance(y: Any, s: dict[str, Any]) -> tuple[Any, Any]:
        J, mu, dt = home + s["J"], mean + s["mu"], s["dt"]
        k1 = _rate(y, J[0], s["h"], mu[0], known["g"])
        k2 = _rate(y + dt / 2 * k1, J[1], s["h"], mu[1], known["g"])
        k3 = _rate(y + dt / 2 * k2, J[1], s["h"], mu[1], known["g"])
        k4 = _rate(y + dt * k3, J[2], s["h"], mu[2], known["g"])
        y = y + dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        return y, y[:4]

    _, q = lax.scan(advance, y, stages)
    q = jnp.concatenate([y[None, :4], q])[known["rows"]]
    return q / jnp.linalg.norm(q, axis=1, keepdims=True)


def _residual(known: dict[str, Any], own: dict[str, Any], x: Any) -> Any:
    q = _attitudes(known, own["start"], x) * jnp.array([1.0, -1.0, -1.0, -1.0])
    return _vector(_multiply(q, own["q_meas"])).ravel() / own["sigma"]


def _minimise(known: dict[str, Any], own: dict[str, Any]) -> Any:
    """Return x, cost, covariance and iterations: Levenberg-Marquardt with Marquardt's scaling."""

    def residual(x: Any) -> Any:
        return _residual(known, own, x)

    def linearise(x: Any) -> Any:
        A, r = jax.jacfwd(lambda x: (residual(x),) * 2, has_aux=True)(x)
        return A.T @ A, A.T @ r, 0.5 * r @ r

    def unfinished(s: Any) -> Any:
        return (s[-1] < ITERATIONS) & ~s[-2]

    def improve(s: Any) -> Any:
        x, (N, b, cost), damping, _, count = s
        step = -jnp.linalg.solve(N + damping * jnp.diag(jnp.diag(N)), b)
        trial = linearise(x + step)  # most steps are taken: cheaper than the residual alone first
        better = trial[2] < cost
        done = step @ N @ step < SMALL
        best = jax.tree.map(lambda n, o: jnp.where(better, n, o), trial, (N, b, cost))
        damping = jnp.where(better, damping / 10, damping * 10)
        return jnp.where(better, x + step, x), best, damping, done, count + 1

    x = jnp.zeros(15)
    begin = (x, linearise(x), jnp.asarray(DAMPING), jnp.asarray(False), jnp.asarray(0))
    x, (N, _, cost), _, _, count = lax.while_loop(unfinished, improve, begin)
    return x, cost, jnp.linalg.inv(N), count


def _timed(call: Callable[[], Any]) -> tuple[Any, float]:
    began = time.perf_counter()
    result = jax.block_until_ready(call())
    return result, time.perf_counter() - began


def _peer(problem: Problem, name: str, found: Any, seconds: float, setup: float) -> PeerFit:
    x, cost, covariance, count = (np.asarray(part) for part in found)
    point = bench.point_at(problem.start, x)
    return PeerFit(name, x, point, float(cost), covariance, seconds, setup, int(count))


def fit(problem: Problem, repeats: int = 5) -> tuple[PeerFit | None, str]:
    """Return the fit (median of ``repeats``, compiling apart) and a sentence."""
    if jax is None:
        return None, MISSING
    jax.config.update("jax_enable_x64", True)
    known, own = _known(problem), _own(problem)
    solver, setup = _timed_compile(lambda own: _minimise(known, own), own)
    runs = [_timed(lambda: solver(own)) for _ in range(repeats)]
    seconds = float(np.median([spent for _, spent in runs]))
    result = _peer(problem, "JAX scan + jacfwd", runs[0][0], seconds, setup)
    return result, f"JAX {jax.__version__}, compiled in {setup:.1f} s."


def fit_batch(problems: Sequence[Problem], repeats: int = 3) -> tuple[list[PeerFit] | None, str]:
    """Return the fits of records that share rows and knots, all at once; seconds are per fit."""
    if jax is None:
        return None, MISSING
    jax.config.update("jax_enable_x64", True)
    known = _known(problems[0])
    each = [_own(p) for p in problems]
    own = {key: np.stack([one[key] for one in each]) for key in each[0]}
    solver, setup = _timed_compile(jax.vmap(lambda own: _minimise(known, own)), own)
    runs = [_timed(lambda: solver(own)) for _ in range(repeats)]
    seconds = float(np.median([spent for _, spent in runs])) / len(problems)
    cut = [[part[i] for part in runs[0][0]] for i in range(len(problems))]
    fits = [
        _peer(p, "JAX vmap", found, seconds, setup) for p, found in zip(problems, cut, strict=True)
    ]
    return fits, f"JAX {jax.__version__}, {len(problems)} at once, compiled in {setup:.1f} s."


def _timed_compile(function: Callable[..., Any], own: dict[str, Any]) -> tuple[Any, float]:
    began = time.perf_counter()
    solver = jax.jit(function).lower(own).compile()
    return solver, time.perf_counter() - began
