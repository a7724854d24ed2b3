"""The problem every peer is given: a paper-like record, camera only, masses moved half-way.

    H = J(d) w + h,    H' = -w x H + mu(d) x g_B,    q' = 1/2 q (0, w)

Displacements d are straight lines between knots, so h is constant between them and jumps there
with w, while q and H stay continuous. Unknown are fifteen numbers

    x = [attitude 3 | rate 3 | Jxx Jyy Jzz Jxy Jxz Jyz | com 3],    unknown = start (+) SCALE x

and the residual is the rotation vector of q_pred^-1 q_meas over sigma. The data are made here by a
plain RK4 in NumPy, so that the bench needs no physics engine; ``tests/oracle`` holds this model
against MuJoCo. Nothing is taken from ``equipoise``.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

# chosen: about one to a few standard deviations of each unknown, so that x is of order one
SCALE = np.repeat([1e-3, 1e-4, 5e-3, 1e-7], [3, 3, 6, 3])  # rad, rad/s, kg m^2, m
ROWS, COLUMNS = (0, 1, 2, 0, 0, 1), (0, 1, 2, 1, 2, 2)  # xx yy zz xy xz yz
EYE = np.eye(3)

# Ivanov 2021, the published platform; homes of the masses are assumed.
MASS = 14.24  # kg
INERTIA = np.array([0.3565, 0.5301, 0.8782, -0.0078, 0.0314, 0.0113])  # kg m^2, about P
COM = np.array([-0.92e-6, -0.1e-6, -79e-6])  # m
RATE = np.array([-0.010, -0.004, 0.011])  # rad/s
SLIDE_MASS = np.full(3, 0.0156)  # kg
SLIDE_HOME = np.array([[0.2, 0.0, 0.05], [0.0, 0.2, 0.05], [0.0, 0.0, 0.25]])  # m
DISPLACEMENT = np.array([-0.010, -0.010, -0.050])  # m
SPEED = 0.010  # m/s
TILT = np.deg2rad(4.0)


@dataclass(frozen=True, slots=True, eq=False)
class Point:
    """One choice of the fifteen unknowns."""

    q: Array  # attitude at the first row, scalar first, body to laboratory
    rate: Array  # rad/s, body axes, just after the first row
    inertia: Array  # kg m^2, about P, masses at home: xx yy zz xy xz yz
    com: Array  # m, masses at home


@dataclass(frozen=True, slots=True, eq=False)
class Problem:
    """A record, what is known, and where to start."""

    t: Array  # s, (n,), growing
    q_meas: Array  # (n, 4)
    sigma: float  # rad, one sd per axis and row
    mass: float  # kg, everything that floats
    gravity: float  # m/s^2
    slide_mass: Array  # kg, (k,)
    slide_home: Array  # m, (k, 3)
    slide_axis: Array  # unit vectors, (k, 3)
    knot_t: Array  # s, (m,), growing
    knot_d: Array  # m, (m, k), straight lines between the knots, constant outside
    start: Point
    truth: Point | None = None


@dataclass(frozen=True, slots=True, eq=False)
class PeerFit:
    """Where a peer ended, and how long it took."""

    name: str
    x: Array  # (15,), in units of SCALE from the start
    point: Point
    cost: float  # half the sum of squares
    covariance: Array  # (15, 15) of x
    seconds: float  # one fit, covariance included
    setup_seconds: float  # building and compiling, once per shape of the problem
    iterations: int

    @property
    def sd(self) -> Array:
        """Return one standard deviation of x."""
        return np.sqrt(np.diag(self.covariance))


@dataclass(frozen=True, slots=True, eq=False)
class Grid:
    """Intervals between neighbouring rows or knots: displacements are straight within each."""

    edges: Array  # s, (N + 1,)
    d: Array  # m, at each interval's start, (N, k)
    v: Array  # m/s, within each, (N, k)
    rows: NDArray[np.int64]  # (n,), which edges are rows of the record


# --- quaternions ----------------------------------------------------------------------------------


def rotation(vector: Array) -> Array:
    """Return the unit quaternions of rotation vectors, (..., 3)."""
    angle = np.linalg.norm(vector, axis=-1, keepdims=True)
    return np.concatenate([np.cos(angle / 2), np.sinc(angle / (2 * np.pi)) / 2 * vector], axis=-1)


def product(p: Array, q: Array) -> Array:
    """Return the quaternion products, (..., 4)."""
    a, u, b, v = p[..., :1], p[..., 1:], q[..., :1], q[..., 1:]
    scalar = a * b - np.sum(u * v, axis=-1, keepdims=True)
    return np.concatenate([scalar, a * v + b * u + np.cross(u, v)], axis=-1)


def difference(p: Array, q: Array) -> Array:
    """Return the rotation vectors of p^-1 q, the shorter way, (..., 3)."""
    e = product(p * np.array([1.0, -1.0, -1.0, -1.0]), q)
    e = np.where(e[..., :1] < 0, -e, e)
    sine = np.linalg.norm(e[..., 1:], axis=-1, keepdims=True)
    safe = np.where(sine < 1e-12, 1.0, sine)
    return np.where(sine < 1e-12, 2.0, 2 * np.arctan2(sine, e[..., :1]) / safe) * e[..., 1:]


# --- unknowns -------------------------------------------------------------------------------------


def point_at(start: Point, x: Array) -> Point:
    """Return start (+) SCALE x."""
    step = SCALE * x
    q = product(start.q, rotation(step[:3]))
    return Point(q, start.rate + step[3:6], start.inertia + step[6:12], start.com + step[12:])


def offset_of(start: Point, point: Point) -> Array:
    """Return x such that point = start (+) SCALE x: the inverse of ``point_at``."""
    turn = difference(start.q, point.q)
    rest = [point.rate - start.rate, point.inertia - start.inertia, point.com - start.com]
    return np.concatenate([turn, *rest]) / SCALE


def symmetric(six: Array) -> Array:
    """Return the matrix of xx yy zz xy xz yz."""
    out = np.zeros((3, 3))
    out[ROWS, COLUMNS] = six
    out[COLUMNS, ROWS] = six
    return out


# --- the model ------------------------------------------------------------------------------------


def grid_of(problem: Problem, with_rows: bool = True) -> Grid:
    """Return the intervals from the first to the last row, cut at knots and (or not) at rows."""
    t, knots = problem.t, problem.knot_t
    known = t if with_rows else t[[0, -1]]
    separation = (
        np.min(np.abs(knots[:, None] - known), axis=1) > 1e-9
    )  # s, else they are the same edge
    edges = np.union1d(known, knots[separation & (knots > t[0]) & (knots < t[-1])])
    d = np.stack([np.interp(edges, knots, column) for column in problem.knot_d.T], axis=-1)
    v = np.diff(d, axis=0) / np.diff(edges)[:, None]
    return Grid(edges, d[:-1], v, np.searchsorted(edges, known))


def slide_inertia(problem: Problem) -> tuple[Array, Array]:
    """Return (k, 3, 3) twice: J(d) = J(0) + sum of d_i first_i + d_i^2 second_i, kg m, kg."""
    m, home, axis = problem.slide_mass, problem.slide_home, problem.slide_axis
    mixed = np.einsum("ki,kj->kij", home, axis)
    dot = np.einsum("ki,ki->k", home, axis)[:, None, None]
    first = m[:, None, None] * (2 * dot * EYE - mixed - mixed.transpose(0, 2, 1))
    second = m[:, None, None] * (EYE - np.einsum("ki,kj->kij", axis, axis))
    return first, second


def inertia_at(problem: Problem, home: Array, d: Array) -> Array:
    """Return J(d), kg m^2."""
    first, second = slide_inertia(problem)
    return home + np.tensordot(d, first, 1) + np.tensordot(d**2, second, 1)


def slide_momentum(problem: Problem, v: Array) -> Array:
    """Return h of masses travelling at ``v`` (m/s): it does not depend on where they are."""
    return (problem.slide_mass * v) @ np.cross(problem.slide_home, problem.slide_axis)


def derivative(y: Array, J: Array, h: Array, mu: Array, gravity: float) -> Array:
    """Return the rate of y = [q, H]; ``J`` and ``mu`` as they are now."""
    a, b, c, d, H1, H2, H3 = y
    w1, w2, w3 = np.linalg.solve(J, y[4:] - h)
    m1, m2, m3 = mu
    g1, g2, g3 = (  # R^T (0, 0, -g)
        -gravity * 2 * (b * d - a * c),
        -gravity * 2 * (c * d + a * b),
        -gravity * (a * a - b * b - c * c + d * d),
    )
    return np.array(
        [
            0.5 * (-b * w1 - c * w2 - d * w3),
            0.5 * (a * w1 + c * w3 - d * w2),
            0.5 * (a * w2 + d * w1 - b * w3),
            0.5 * (a * w3 + b * w2 - c * w1),
            H2 * w3 - H3 * w2 + m2 * g3 - m3 * g2,
            H3 * w1 - H1 * w3 + m3 * g1 - m1 * g3,
            H1 * w2 - H2 * w1 + m1 * g2 - m2 * g1,
        ]
    )


def stretch_rate(
    problem: Problem, point: Point, d: Array, v: Array
) -> Callable[[float, Array], Array]:
    """Return (time since the start of a stretch, y) -> dy/dt, masses travelling from d at v."""
    home, mean = symmetric(point.inertia), problem.mass * point.com
    weight = problem.slide_mass[:, None] * problem.slide_axis
    h, gravity = slide_momentum(problem, v), problem.gravity
    if not v.any():
        J, mu = inertia_at(problem, home, d), mean + d @ weight
        return lambda s, y: derivative(y, J, h, mu, gravity)
    first, second = slide_inertia(problem)

    def moving(s: float, y: Array) -> Array:
        now = d + v * s
        J = home + np.tensordot(now, first, 1) + np.tensordot(now**2, second, 1)
        return derivative(y, J, h, mean + now @ weight, gravity)

    return moving


def first_state(problem: Problem, point: Point, d: Array, v: Array) -> Array:
    """Return y = [q, H] at the first row."""
    J = inertia_at(problem, symmetric(point.inertia), d)
    return np.concatenate([point.q, J @ point.rate + slide_momentum(problem, v)])


def simulate(problem: Problem, point: Point, step: float = 0.02) -> Array:
    """Return the attitude at the rows, (n, 4), by RK4 with steps of at most ``step`` (s)."""
    grid = grid_of(problem)
    y = first_state(problem, point, grid.d[0], grid.v[0])
    out = [y]
    for length, d, v in zip(np.diff(grid.edges), grid.d, grid.v, strict=True):
        rate = stretch_rate(problem, point, d, v)
        n = max(int(np.ceil(length / step - 1e-9)), 1)
        for i in range(n):
            y = _rk4(rate, length * i / n, y, length / n)
        out.append(y)
    return np.array(out)[grid.rows, :4]


def _rk4(rate: Callable[[float, Array], Array], s: float, y: Array, dt: float) -> Array:
    k1 = rate(s, y)
    k2 = rate(s + dt / 2, y + dt / 2 * k1)
    k3 = rate(s + dt / 2, y + dt / 2 * k2)
    k4 = rate(s + dt, y + dt * k3)
    y = y + dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
    y[:4] /= np.linalg.norm(y[:4])
    return y


# --- the data -------------------------------------------------------------------------------------


def make_problem(
    seed: int,
    duration: float = 120.0,
    rate: float = 5.0,
    noise: float = np.deg2rad(0.2),
    spread: float = 0.20,
) -> Problem:
    """Return a paper-like record: masses moved by (-10, -10, -50) mm at 10 mm/s, half-way.

    The start: moments wrong by up to ``spread``, no products, com (0, 0, -100) um, the first
    attitude as measured and the mean rate of the first 3 s.
    """
    rng = np.random.default_rng(seed)
    knot_t, knot_d = _knots(duration / 2)
    way, heading = rng.uniform(0, 2 * np.pi, 2)
    lean = rotation(TILT * np.array([np.cos(way), np.sin(way), 0.0]))
    truth = Point(product(lean, rotation(np.array([0.0, 0.0, heading]))), RATE, INERTIA, COM)
    t = np.arange(round(duration * rate) + 1) / rate
    problem = Problem(
        t=t,
        q_meas=np.zeros((len(t), 4)),
        sigma=noise,
        mass=MASS,
        gravity=9.81,
        slide_mass=SLIDE_MASS,
        slide_home=SLIDE_HOME,
        slide_axis=EYE,
        knot_t=knot_t,
        knot_d=knot_d,
        start=truth,
        truth=truth,
    )
    clean = simulate(problem, truth)
    q_meas = product(clean, rotation(rng.normal(0.0, noise, (len(t), 3))))
    guess = INERTIA * np.append(1 + rng.uniform(-spread, spread, 3), np.zeros(3))
    start = Point(q_meas[0], _first_rate(t, q_meas), guess, np.array([0.0, 0.0, -100e-6]))
    return replace(problem, q_meas=q_meas, start=start)


def _knots(at: float) -> tuple[Array, Array]:
    """Return the displacement record: all masses set off at ``at`` (s) with the same speed."""
    t = at + np.append(0.0, np.unique(np.abs(DISPLACEMENT)) / SPEED)
    travelled = np.minimum(SPEED * (t - at)[:, None], np.abs(DISPLACEMENT))
    return t, np.sign(DISPLACEMENT) * travelled


def _first_rate(t: Array, q: Array) -> Array:
    """Return the slope of the rotation since the first row, over the first 3 s, rad/s."""
    early = t <= t[0] + 3.0
    turn = difference(q[0], q[early])
    return np.polynomial.polynomial.polyfit(t[early] - t[0], turn, 1)[1]
