"""MuJoCo: a model in its engine, fitted by its own system identification, ``mujoco.sysid``.

A ball joint at P carries the body and, on slide joints, the masses. Its modifier of pseudo-inertia
leaves ``iquat`` undefined, so it is set here; the total mass, which a record does not show, is
held by leaving it out of the unknowns. The toolbox has no unknown initial state: ``custom_rollout``
sets it. The residual is the problem's own, from the state, as sensors lag a step.

The engine knows no prescribed motion. A heavy armature resists along its joint alone and adds
nothing to the platform: servos that drive one hold the masses to their displacements, with a sag
of 0.2 um, and a kink is rounded over some 20 ms.
"""

import contextlib
import io
import time
from typing import Any

import numpy as np

from benchmarks import problem as bench
from benchmarks.problem import Array, PeerFit, Point, Problem

try:
    import mujoco
    from mujoco import sysid
    from mujoco.sysid import model_modifier, optimize
except ImportError:  # an extra, and the toolbox an extra of it
    sysid = None

MISSING = "MuJoCo's sysid is not installed; pip install 'equipoise[peers]' would add it."
# Of its solvers and scalings the quickest here: 25 evaluations; its own takes 38 steps or 69.
SOLVER = "scipy_parallel_fd"
STEP = 0.01  # s, chosen: at most; MuJoCo's usual one is 2 ms
SERVO = 100.0  # rad/s, chosen: 1 / STEP, well inside RK4's stability
ARMATURE = 100.0  # kg, chosen: a mass m sags by m g / (ARMATURE SERVO^2)
POINT = 1e-12  # kg m^2, chosen: MuJoCo demands inertia of a moving body
FLAT = 1e-4  # kg m^2, chosen: the least second moment at the start; no flatter body compiles
BOUND = 3.0  # chosen: stretches by e^-6 to e^6; the default of 1/2 to 2 shuts flat bodies out
MODEL = """
<mujoco>
  <option gravity="0 0 -{gravity}" timestep="{step}" integrator="RK4"/>
  <worldbody>
    <body name="platform">
      <joint type="ball"/>
      <inertial pos="0 0 0" mass="{mass}" diaginertia="1 1 1"/>
      {bodies}
    </body>
  </worldbody>
  <actuator>{servos}</actuator>
  <sensor><framequat objtype="xbody" objname="platform"/></sensor>
</mujoco>
"""
BODY = """
<body pos="{home}">
  <joint name="m{i}" type="slide" axis="{axis}" armature="{armature}"/>
  <inertial pos="0 0 0" mass="{mass}" diaginertia="{point} {point} {point}"/>
</body>
"""
DRIVE = '<position joint="m{i}" kp="{kp}" kv="{kv}"/>'


def _words(numbers: Array) -> str:
    return " ".join(map(repr, numbers.tolist()))


def _steps(problem: Problem) -> tuple[int, float]:
    """Return the engine's steps from row to row, and the seconds of each; rows are even."""
    interval = float(problem.t[-1] - problem.t[0]) / (len(problem.t) - 1)
    count = int(np.ceil(interval / STEP - 1e-9))
    return count, interval / count


def _spec(problem: Problem) -> Any:
    """Return the model, masses at home; its inertia is a placeholder."""
    bodies, servos = "", ""
    for i, (m, home, axis) in enumerate(
        zip(problem.slide_mass, problem.slide_home, problem.slide_axis, strict=True)
    ):
        where = {"home": _words(home), "axis": _words(axis)}
        bodies += BODY.format(i=i, mass=float(m), armature=ARMATURE, point=POINT, **where)
        servos += DRIVE.format(i=i, kp=ARMATURE * SERVO**2, kv=2 * ARMATURE * SERVO)
    mass = float(problem.mass - problem.slide_mass.sum())
    known = {"gravity": problem.gravity, "step": _steps(problem)[1], "mass": mass}
    return mujoco.MjSpec.from_string(MODEL.format(bodies=bodies, servos=servos, **known))


# --- unknowns: [turn of the first attitude 3 | rate 3 | pseudo-inertia 9] -------------------------


def _slides(problem: Problem) -> Array:
    """Return the pseudo-inertia of the masses at home, (4, 4)."""
    place = np.column_stack([problem.slide_home, np.ones(len(problem.slide_mass))])
    return (place.T * problem.slide_mass) @ place


def _alpha(problem: Problem) -> float:
    """Return the toolbox's logarithm of the body's mass."""
    return float(np.log(problem.mass - problem.slide_mass.sum()) / 2)


def theta_of(problem: Problem, point: Point) -> Array:
    """Return the toolbox's nine numbers of the body without the masses."""
    J = bench.symmetric(point.inertia)
    second = np.trace(J) / 2 * bench.EYE - J
    first = problem.mass * point.com[:, None]
    whole = np.block([[second, first], [first.T, np.full((1, 1), problem.mass)]])
    body = whole - _slides(problem)
    length, axes = np.linalg.eigh(body[:3, :3])
    body[:3, :3] = (axes * np.maximum(length, FLAT)) @ axes.T
    return model_modifier.theta_from_pseudoinertia(body)[1:]


def point_at(problem: Problem, unknown: Array) -> Point:
    """Return the point that the toolbox's unknowns stand for."""
    turn, rate, theta = unknown[:3], unknown[3:6], unknown[6:]
    pi = model_modifier.pi_from_theta(np.append(_alpha(problem), theta))
    slides = _slides(problem)
    second = slides[:3, :3]
    J = pi[4:].reshape(3, 3) + np.trace(second) * bench.EYE - second
    com = (pi[1:4] + slides[:3, 3]) / problem.mass
    q = bench.product(problem.start.q, bench.rotation(turn))
    return Point(q, rate, J[bench.ROWS, bench.COLUMNS], com)


def unknowns_of(problem: Problem) -> Any:
    """Return the toolbox's parameters, at the start."""

    def apply(spec: Any, parameter: Any) -> None:
        theta = np.append(_alpha(problem), parameter.value)
        model_modifier.apply_body_theta_inertia(spec, "platform", theta)
        spec.body("platform").iquat = [1.0, 0.0, 0.0, 0.0]

    start, out = problem.start, sysid.ParameterDict()
    parts = {"turn": np.zeros(3), "rate": start.rate, "inertia": theta_of(problem, start)}
    for name, at in parts.items():
        modifier = apply if name == "inertia" else None
        out.add(sysid.Parameter(name, at, at - BOUND, at + BOUND, modifier=modifier))
    return out


# --- the residual ---------------------------------------------------------------------------------


def _command(problem: Problem, count: int, step: float) -> Any:
    """Return what the servos are told in each step: displacement and, ahead, speed."""
    n = count * (len(problem.t) - 1) + 1  # the toolbox leaves the last out
    middle = problem.t[0] + step * (np.arange(n) + 0.5)
    near = middle[:, None] + step / 2 * np.array([-1.0, 0.0, 1.0])
    d = np.stack([np.interp(near, problem.knot_t, column) for column in problem.knot_d.T], -1)
    v = (d[:, 2] - d[:, 0]) / step
    return sysid.TimeSeries(step * np.arange(n), d[:, 1] + 2 / SERVO * v)


def residual_function(problem: Problem) -> Any:
    """Return the toolbox's residual: (unknowns, its parameters) -> residuals."""
    count, step = _steps(problem)
    grid = bench.grid_of(problem)
    spec = _spec(problem)
    model = spec.compile()

    def state(parameters: Any) -> Array:
        q = bench.product(problem.start.q, bench.rotation(parameters["turn"].value))
        rate = parameters["rate"].value
        at, moving = np.append(q, grid.d[0]), np.append(rate, grid.v[0])
        return sysid.create_initial_state(model, at, moving)

    def rollout(*, param_dicts: Any, initial_states: Any, **known: Any) -> Any:
        return sysid.sysid_rollout(initial_states=[state(p) for p in param_dicts], **known)

    def residual(  # noqa: PLR0913, PLR0917 - the toolbox calls it
        parameters: Any, predicted: Any, measured: Any, model: Any, everything: bool, state: Array
    ) -> Any:
        q0 = bench.product(problem.start.q, bench.rotation(parameters["turn"].value))
        q = np.vstack([q0, state[count - 1 :: count, 1:5]])
        e = bench.difference(q, measured.data).ravel() / problem.sigma
        return e, measured, measured

    measured = sysid.TimeSeries(problem.t - problem.t[0], problem.q_meas)
    command = _command(problem, count, step)
    first = state(unknowns_of(problem))
    record = sysid.ModelSequences("bench", spec, "record", first, command, measured)
    return sysid.build_residual_fn(
        models_sequences=[record], modify_residual=residual, custom_rollout=rollout,
        resample_true=False,
    )  # fmt: skip


def covariance_of(problem: Problem, unknown: Array, jacobian: Array) -> Array:
    """Return the covariance of x, (15, 15), from the derivatives of residuals by the unknowns."""

    def x(unknown: Array) -> Array:
        return bench.offset_of(problem.start, point_at(problem, unknown))

    steps = 1e-6 * np.eye(15)
    change = np.column_stack([(x(unknown + s) - x(unknown - s)) / 2e-6 for s in steps])
    return change @ np.linalg.inv(jacobian.T @ jacobian) @ change.T


def fit(problem: Problem) -> tuple[PeerFit | None, str]:
    """Return one fit (building apart) and a sentence."""
    if sysid is None:
        return None, MISSING
    began = time.perf_counter()
    residual, start = residual_function(problem), unknowns_of(problem)
    setup = time.perf_counter() - began
    began = time.perf_counter()
    with contextlib.redirect_stdout(io.StringIO()):  # it cannot be told to print nothing
        _, found = optimize(start, residual, SOLVER, verbose=False, x_scale="jac")
    covariance = covariance_of(problem, found.x, found.jac)
    seconds = time.perf_counter() - began
    point = point_at(problem, found.x)
    x = bench.offset_of(problem.start, point)
    name = "MuJoCo sysid"
    result = PeerFit(name, x, point, found.cost, covariance, seconds, setup, found.nfev)
    return result, f"MuJoCo {mujoco.__version__}, built in {setup:.2f} s."
