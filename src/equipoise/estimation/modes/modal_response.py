"""How modes move in a fitted motion, and what they do to the body by that.

The coupled equations (``dynamics.modal_motion``) are followed from the fitted state at the
beginning of each stretch: its total momentum H, which a mode changes slowly and so is the same with
better modes, and the modes as they were at the end of the stretch before. What comes of it is the
known input of the next fit (``dynamics.modal_inputs``). So is the torque of a mass that hangs
(``dynamics.hanging_torque``), by the attitudes of that motion.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from equipoise.dynamics.hanging_torque import HangingTorque, hanging_torque
from equipoise.dynamics.modal_inputs import ModalInputs
from equipoise.dynamics.modal_motion import follow_modes, modes_of, total_momentum
from equipoise.dynamics.propagation import rigid_body, stacked
from equipoise.dynamics.regressor import DRIFT
from equipoise.dynamics.rigid_body import KNOWN_D, ROWS, Body
from equipoise.dynamics.timeline import fill
from equipoise.estimation.events.record_model import RecordModel
from equipoise.estimation.output_error.solution import Fitted
from equipoise.estimation.output_error.trajectory import problem_of
from equipoise.estimation.parameters.fit_parameters import Unknowns, unknowns_of
from equipoise.maths.attitude import to_matrix
from equipoise.maths.linalg import unpack_symmetric
from equipoise.maths.straight_lines import read_at
from equipoise.model.arrays import Floats, Matrix3, Series, Series1, Series3, Square, Vector3
from equipoise.model.modes import FreeMode, Mode, held
from equipoise.model.recording import Samples
from equipoise.model.testbed import Testbed

PHASE = 0.15  # rad of a mode between two nodes, chosen: lines between them err by 2e-3
SLOWEST = 1.0  # rad/s, chosen: nodes where there is no mode


class Response(NamedTuple):
    """The modes along the nodes, and the platform with them."""

    t: Series1  # s
    q: Series  # (n, 4)
    deflection: Floats  # (n, m) sqrt(kg) m, e
    velocity: Floats  # (n, m) sqrt(kg) m/s, e'


class Ground(NamedTuple):
    """The motion that modes are driven by: nodes, what is known there, and where stretches begin.

    None of it depends on the modes.
    """

    t: Series1
    known: Floats
    maps: Floats
    starts: list[int]  # nodes
    bodies: list[Body]
    states: list[Floats]  # q and H at the beginning of each stretch
    inverse: Square  # J^-1 at the beginning
    rate: Vector3  # rad/s, what H comes to at the beginning without any mode


def real_inputs(model: RecordModel) -> tuple[Series1, Floats]:
    """Return nodes and known inputs without modes, masses where the fit has them.

    A mass that hangs remains in them.
    """
    fitted = model.fitted
    bare = replace(model.params, modal=hanging_input(model), jumps=fitted.problem.jumps)
    problem = problem_of(fitted.problem.recording, fitted.problem.testbed, bare)
    line, first = problem.line, KNOWN_D + len(problem.maps.momentum)
    known = line.known[:, :first].copy()
    for j, (mass, error) in enumerate(line.owners):
        known[:, KNOWN_D + mass] += fitted.point.error[error] * line.known[:, first + j]
    return line.t, known


def hanging_input(model: RecordModel) -> ModalInputs | None:
    """Return what a mass that hangs did in the fit; None if there is none in it."""
    hanging = model.hanging
    if hanging is None or hanging.torque is None:
        return None
    torque = hanging.torque
    return ModalInputs(Samples(torque.t, np.zeros_like(torque.values)), torque)


def ground_of(model: RecordModel, frequency: float) -> Ground:
    """Return what drives modes of up to a frequency (rad/s) in the motion of a fit."""
    fitted = model.fitted
    rough, inputs = real_inputs(model)
    t = fill(rough, PHASE / frequency)
    known = read_at(t, rough, inputs)
    maps = stacked(fitted.problem.maps)
    cuts = np.array([jump.t for jump in fitted.problem.jumps])
    starts = [0, *np.searchsorted(t, cuts).tolist()]
    bodies, states, inverse, rate = list[Body](), list[Floats](), np.eye(3), np.zeros(3)
    for at, point in zip(starts, points_of(fitted), strict=True):
        body = body_from(point, fitted, float(t[at] - t[0]))
        H, inner = total_momentum(body, maps, t, known, min(at, len(t) - 2), point.w0)
        momentum = np.array(H) + modal_momentum(fitted, float(t[at]))
        if at == 0:
            inverse = unpack_symmetric(np.array(inner))
            rate = point.w0 + inverse @ modal_momentum(fitted, float(t[0]))
        bodies.append(body)
        states.append(np.append(point.q0, momentum))
    return Ground(t, known, maps, starts, bodies, states, inverse, rate)


def points_of(fitted: Fitted) -> Iterator[Unknowns]:
    """Yield the fitted point at the beginning of each stretch."""
    for row in fitted.at.pieces.points:
        yield unknowns_of(row)


def body_from(point: Unknowns, fitted: Fitted, since: float) -> Body:
    """Return the platform of a stretch that begins so long (s) after the record."""
    problem = fitted.problem
    body = rigid_body(point.body(problem.mass), problem.gravity, point.torque)
    drifted = np.array(body.moment) + problem.mass * since * point.torque[DRIFT : DRIFT + 3]
    x, y, z = drifted
    return body._replace(moment=(float(x), float(y), float(z)))


def modal_momentum(fitted: Fitted, t: float) -> Vector3:
    """Return the momentum (N m s) of modes that a fit took as known, at a time (s)."""
    modal = fitted.problem.modal
    if modal is None:
        return np.zeros(3)
    found: Vector3 = read_at(np.array([t]), modal.momentum.t, modal.momentum.values)[0]
    return found


def begun_in(ground: Ground, modes: Sequence[Mode]) -> Floats:
    """Return e and p of every mode at the beginning, H there being given: p = e' + d.w."""
    h: Vector3 = sum((m.coupling * m.velocity for m in modes), np.zeros(3))
    w = ground.rate - ground.inverse @ h
    return np.array([(m.deflection, m.velocity + m.coupling @ w) for m in modes]).ravel()


def response(ground: Ground, modes: Sequence[Mode], testbed: Testbed) -> Response:
    """Return how modes move in a fitted motion."""
    kernel_modes = modes_of(modes, testbed.up, testbed.gravity)
    y, rate = np.zeros((len(ground.t), ROWS + 2 * len(modes))), np.zeros((len(ground.t), 3))
    own, ends = begun_in(ground, modes), [*ground.starts[1:], len(ground.t) - 1]
    for a, b, body, state in zip(ground.starts, ends, ground.bodies, ground.states, strict=True):
        part = slice(a, b + 1)
        found = follow_modes(body, ground.maps, kernel_modes, np.append(state, own),
                             ground.t[part], ground.known[part])  # fmt: skip
        y[part], rate[part], own = found.y, found.rate, found.y[-1, ROWS:]
    e, p = y[:, ROWS::2], y[:, ROWS + 1 :: 2]
    coupling = np.array([mode.coupling for mode in modes]).reshape(-1, 3)
    return Response(ground.t, y[:, :4], e, p - rate @ coupling.T)


def by_lines(t: Series1, oscillating: Floats, frequency: Floats) -> Floats:
    """Return what lines are drawn through so that they oscillate as much as what they stand for.

    Lines between points of a wave, x = W dt of its phase apart, hold 1 - x^2 / 12 of it.
    """
    dt = np.diff(t)
    square = 0.5 * (np.append(dt[:1], dt) ** 2 + np.append(dt, dt[-1:]) ** 2)
    return oscillating * (1.0 + np.outer(square, frequency**2) / 12.0)


def inputs_of(found: Response, modes: Sequence[Mode], gravity: float) -> ModalInputs:
    """Return what modes do to the body: sum d e', and (sum s e) x g_B."""
    coupling = np.array([mode.coupling for mode in modes]).reshape(-1, 3)
    moment = np.array([mode.moment for mode in modes]).reshape(-1, 3)
    down: Series3 = -gravity * to_matrix(found.q)[:, 2, :]
    frequency = np.array([mode.angular_frequency for mode in modes])
    momentum = Samples(found.t, by_lines(found.t, found.velocity, frequency) @ coupling)
    return ModalInputs(momentum, Samples(found.t, np.cross(found.deflection @ moment, down)))


def inertia_of(model: RecordModel) -> Matrix3:
    """Return the fitted inertia about P, kg m^2."""
    return model.fitted.point.body(model.testbed.body.mass).inertia_P


def with_response(model: RecordModel, modes: Sequence[FreeMode]) -> RecordModel:
    """Return the model with modes as they move in its own fitted motion, not fitted anew yet.

    Their frequency is that of the free platform, which the record shows: a fitted inertia that is
    not yet right leaves the phase of each mode as it is.
    """
    if not modes and model.hanging is None:
        return replace(model, modes=(), params=replace(model.params, modal=None))
    inertia, testbed = inertia_of(model), model.testbed
    real = [held(mode, inertia) for mode in modes]
    fastest = max((2.0 * float(np.pi) * mode.frequency for mode in modes), default=SLOWEST)
    found = response(ground_of(model, fastest), real, testbed)
    modal, hanging = inputs_of(found, real, testbed.gravity), model.hanging
    if hanging is not None:
        torque = hanging_torque(found.q, hanging.mass, testbed.up, testbed.weight)
        hanging = HangingTorque(hanging.mass, Samples(found.t, torque))
        modal = replace(modal, torque=Samples(found.t, modal.torque.values + torque))
    params = replace(model.params, modal=modal)
    return replace(model, modes=tuple(modes), hanging=hanging, params=params)
