"""Modes fitted with all that a model of a record holds: a profile likelihood by Gauss-Newton.

All else x is at its optimum x(theta) for every theta of the modes. The residuals there, priors and
jumps among them, have the derivative J by theta, and

    (J^T J + P) step = -J^T r - P (theta - theta_0)

is Gauss-Newton in x and theta together with x taken out (variable projection: Golub and Pereyra
1973). The inverse of J^T J + P is the covariance of theta, x being free, and dx/dtheta carries it
on to x. Each fit takes what modes do to the body as known (``modal_response``), and is repeated
until that follows from the fit's own motion.

Unknowns of a mode are ln W, z, ln |d|, the direction of d, and |d| e and |d| e' at the beginning.
A mode that takes half the part but moves twice as much shakes the platform alike until the motion
changes: |d| itself is then open, all else is not. A moment s is not among the unknowns: within some
degrees of level a mode with s moves the platform as one of the coupling

    d + s x g_0 / W^2

does at its frequency, and at low ones as elastic sag (``torque_terms``, sag). The former is what is
reported.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from equipoise.estimation.events.record_model import RecordModel, refitted
from equipoise.estimation.modes.modal_response import with_response
from equipoise.estimation.output_error.problem import posed
from equipoise.estimation.output_error.solution import Fitted, cost_of
from equipoise.estimation.parameters.fit_parameters import TURN, physical
from equipoise.estimation.search_budget import Stage
from equipoise.model.arrays import Floats, Matrix3, Series1, Square, Vector3
from equipoise.model.modes import FreeMode

EACH = 7  # unknowns of a mode
ANGLE = 0.01  # rad, chosen: natural size of how a mode moves
SD = (1.0, 5.0, 1.5, 1.0, 1.0, 10.0, 10.0)  # of priors in natural sizes, chosen: wide
FINE = 1.0  # sd, chosen: by which the data change in a difference
BOLD = 1.0  # chosen: of ln |d| in a step
COARSEST = 0.2  # natural sizes, chosen: of a difference
TURNS, MOST = 3, 20  # chosen: fits until a motion and its modes agree; steps
SETTLED = 0.1  # of chi-square, chosen
LEAST = 1e-9  # sqrt(kg) m, chosen: no coupling
BOLDEST = 1e4  # chosen: damping of a step at which the search ends


@dataclass(frozen=True, slots=True, eq=False)
class ModalFit:
    """Modes at their optimum."""

    model: RecordModel
    theta: Floats  # natural sizes
    covariance: Square  # of theta

    @property
    def chi_square(self) -> float:
        """Twice the cost, with priors."""
        return total(self.model, self.theta)


def directions(mode: FreeMode) -> Matrix3:
    """Return the direction of d and two across it, as rows."""
    along: Vector3 = mode.coupling / size_of(mode)
    aside = np.eye(3)[int(np.argmin(np.abs(along)))]
    across = np.cross(along, aside).astype(np.float64, copy=False)
    first: Vector3 = across / float(np.linalg.norm(across))
    return np.array([along, first, np.cross(along, first)])


def sizes(mode: FreeMode, moment: float) -> Floats:
    """Return natural sizes of a mode's unknowns: 1, 0.01, 1, 1, 1, and J by 0.01 rad."""
    turn = ANGLE * moment
    speed = 2.0 * float(np.pi) * mode.frequency * turn
    return np.array([1.0, 0.01, 1.0, 1.0, 1.0, turn, speed])


def size_of(mode: FreeMode) -> float:
    """Return |d|, sqrt(kg) m."""
    return max(float(np.linalg.norm(mode.coupling)), LEAST)


def vector_of(modes: Sequence[FreeMode], first: Sequence[FreeMode], moment: float) -> Floats:
    """Return the unknowns of modes; frequency and coupling are relative to those at first."""
    rows = list[Floats]()
    for m, one in zip(modes, first, strict=True):
        along, x, y = directions(one) @ m.coupling
        size = size_of(m)
        found = [np.log(m.frequency / one.frequency), m.damping, np.log(size / size_of(one)),
                 x / along, y / along, size * m.deflection, size * m.velocity]  # fmt: skip
        rows.append(np.array(found) / sizes(one, moment))
    return np.concatenate(rows)


def modes_at(theta: Floats, first: Sequence[FreeMode], moment: float) -> tuple[FreeMode, ...]:
    """Return the modes of unknowns; a damping below zero is none."""
    found = list[FreeMode]()
    for k, one in enumerate(first):
        x = theta[EACH * k : EACH * (k + 1)] * sizes(one, moment)
        frequency, damping = one.frequency * float(np.exp(x[0])), max(float(x[1]), 0.0)
        size, along = size_of(one) * float(np.exp(x[2])), np.array([1.0, x[3], x[4]])
        coupling = size / np.linalg.norm(along) * (along @ directions(one))
        found.append(FreeMode(frequency, damping, coupling, float(x[5]) / size, float(x[6]) / size))
    return tuple(found)


def weights(theta: Floats) -> Floats:
    """Return the diagonal of P."""
    return np.tile(np.array(SD) ** -2.0, len(theta) // EACH)


def agreed(model: RecordModel, modes: Sequence[FreeMode]) -> RecordModel:
    """Return the model fitted with modes that follow from its own motion."""
    for _ in range(TURNS):
        model = refitted(with_response(model, modes))
    return model


def total(model: RecordModel, theta: Floats) -> float:
    """Return the chi-square, with priors."""
    return 2.0 * cost_of(model.fitted) + float(weights(theta) @ theta**2)


def residuals(fitted: Fitted) -> Floats:
    """Return all residuals of a fit in sd: of rows, priors and jumps."""
    problem, at = fitted.problem, fitted.at
    x = physical(fitted.point, problem.mass, problem.layout)
    off = np.sqrt(problem.prior.weight) * (x - problem.prior.mean)
    off[TURN] = 0.0  # of which a point counts from itself
    off[problem.prior.held] = 0.0
    jumped = fitted.jumps * np.sqrt(posed(problem).cuts.weight)
    return np.concatenate([np.ravel(part) for part in (at.left_q, at.left_w, at.left_v)]
                          + [off, np.ravel(jumped)])  # fmt: skip


class Search:
    """A descent: where modes began, and by how much each unknown is varied."""

    def __init__(self, model: RecordModel, modes: Sequence[FreeMode]) -> None:
        self.first = tuple(modes)
        self.moment = model.testbed.body.mean_moment
        start, end = model.recording.span
        self.varied: Floats = np.concatenate(
            [first_steps(mode, end - start) for mode in self.first]
        )

    def at(self, model: RecordModel, theta: Floats) -> RecordModel:
        """Return the model with the modes of unknowns."""
        return agreed(model, modes_at(theta, self.first, self.moment))

    def derivative(self, model: RecordModel, theta: Floats) -> Floats:
        """Return J by differences, and vary less or more by what it says."""
        r = residuals(self.at(model, theta).fitted)  # gone as long a way as the others
        found = np.zeros((len(r), len(theta)))
        for k, h in enumerate(self.varied):
            ahead = theta + h * (np.arange(len(theta)) == k)
            found[:, k] = (residuals(self.at(model, ahead).fitted) - r) / h
        size = np.linalg.norm(found, axis=0)
        self.varied = np.clip(FINE / np.maximum(size, 1e-12), 0.01 * self.varied, 3 * self.varied)
        self.varied = np.minimum(self.varied, COARSEST)
        return found


def first_steps(mode: FreeMode, span: float) -> Series1:
    """Return by how much unknowns are varied at first: a mode's phase at the end by 0.05 rad."""
    phase = 0.05 / (2.0 * float(np.pi) * mode.frequency * span)
    return np.array([phase, 100.0 * phase, 0.1, 0.01, 0.01, 0.02, 0.02])


def tried_step(by_theta: Floats, r: Floats, theta: Floats, damping: float) -> tuple[Floats, float]:
    """Return the damped step of Gauss-Newton, and by how much chi-square should fall."""
    P = weights(theta)
    normal, descent = by_theta.T @ by_theta + np.diag(P), -(by_theta.T @ r) - P * theta
    damped = normal + damping * np.diag(np.diag(normal))
    step = np.linalg.solve(damped, descent).astype(np.float64, copy=False)
    step *= min(1.0, BOLD / max(float(np.abs(step[2::EACH]).max()), 1e-9))
    return step, float(step @ (2.0 * descent - normal @ step))


def fit_modes(model: RecordModel, modes: Sequence[FreeMode]) -> ModalFit:
    """Return the optimum of modes and all else, from first modes."""
    search, damping = Search(model, modes), 1e-3
    theta = vector_of(modes, search.first, search.moment)
    here = search.at(model, theta)
    by_theta = search.derivative(here, theta)
    for _ in range(MOST):
        step, promised = tried_step(by_theta, residuals(here.fitted), theta, damping)
        if promised < SETTLED or damping > BOLDEST or not model.may(Stage.TERMS):
            break
        there = search.at(here, theta + step)
        if total(there, theta + step) < total(here, theta):
            theta, here, damping = theta + step, there, max(0.1 * damping, 1e-6)
            by_theta = search.derivative(here, theta)
        else:
            damping *= 10.0
    return ModalFit(here, theta, covariance_of(by_theta, theta))


def covariance_of(by_theta: Floats, theta: Floats) -> Square:
    """Return (J^T J + P)^-1."""
    information = by_theta.T @ by_theta + np.diag(weights(theta))
    return np.linalg.inv(information).astype(np.float64, copy=False)


def fit_at(model: RecordModel) -> ModalFit:
    """Return what a model says of the modes that it is fitted with."""
    search = Search(model, model.modes)
    theta = vector_of(model.modes, search.first, search.moment)
    search.derivative(model, theta)  # so that unknowns are varied as the record shows them
    return ModalFit(model, theta, covariance_of(search.derivative(model, theta), theta))
