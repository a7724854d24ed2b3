"""Modes fitted with all that a model of a record holds, as a profile (``profile_descent``).

Each fit takes what modes do to the body as known (``modal_response``), and is repeated until that
follows from the fit's own motion.

Unknowns of a mode are ln W, z, ln |d|, the direction of d, and |d| e and |d| e' at the beginning.
A mode that takes half the part but moves twice as much shakes the platform alike until the motion
changes: |d| itself is then open, all else is not. Its prior is that of a part of some 3 % of the
platform; without one, noise may make a part of most of it. A moment s is not among the unknowns:
within some degrees of level a mode with s moves the platform as one of the coupling

    d + s x g_0 / W^2

does at its frequency, and at low ones as elastic sag (``torque_terms``, sag). The former is what is
reported.
"""

from collections.abc import Sequence

import numpy as np

from equipoise.estimation.events.record_model import RecordModel, refitted
from equipoise.estimation.modes.modal_response import with_response
from equipoise.estimation.modes.profile_descent import Profile, ProfileFit, descended, fit_here
from equipoise.model.arrays import Floats, Matrix3, Series1, Vector3
from equipoise.model.modes import FreeMode

EACH = 7  # unknowns of a mode
ANGLE = 0.01  # rad, chosen: natural size of how a mode moves
SD = (1.0, 5.0, 1.0, 1.0, 1.0, 10.0, 10.0)  # of priors in natural sizes, chosen: wide
SHARE = 0.03  # of the platform's inertia that takes part, chosen: the mean of the prior of ln |d|
BOLD = 1.0  # chosen: of ln |d| in a step
TURNS = 3  # chosen: fits until a motion and its modes agree
LEAST = 1e-9  # sqrt(kg) m, chosen: no coupling


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


def usual_size(moment: float) -> float:
    """Return |d| of a part as large as parts usually are, sqrt(kg) m."""
    return float((SHARE * moment) ** 0.5)


def size_of(mode: FreeMode) -> float:
    """Return |d|, sqrt(kg) m."""
    return max(float(np.linalg.norm(mode.coupling)), LEAST)


def vector_of(modes: Sequence[FreeMode], first: Sequence[FreeMode], moment: float) -> Floats:
    """Return the unknowns of modes.

    Frequency and direction count from those at first, the size of d from the usual one.
    """
    rows, usual = list[Floats](), usual_size(moment)
    for m, one in zip(modes, first, strict=True):
        along, x, y = directions(one) @ m.coupling
        size = size_of(m)
        found = [np.log(m.frequency / one.frequency), m.damping, np.log(size / usual),
                 x / along, y / along, size * m.deflection, size * m.velocity]  # fmt: skip
        rows.append(np.array(found) / sizes(one, moment))
    return np.concatenate(rows)


def modes_at(theta: Floats, first: Sequence[FreeMode], moment: float) -> tuple[FreeMode, ...]:
    """Return the modes of unknowns; a damping below zero is none."""
    found = list[FreeMode]()
    for k, one in enumerate(first):
        x = theta[EACH * k : EACH * (k + 1)] * sizes(one, moment)
        frequency, damping = one.frequency * float(np.exp(x[0])), max(float(x[1]), 0.0)
        size, along = usual_size(moment) * float(np.exp(x[2])), np.array([1.0, x[3], x[4]])
        coupling = size / np.linalg.norm(along) * (along @ directions(one))
        found.append(FreeMode(frequency, damping, coupling, float(x[5]) / size, float(x[6]) / size))
    return tuple(found)


def agreed(model: RecordModel, modes: Sequence[FreeMode]) -> RecordModel:
    """Return the model fitted with modes that follow from its own motion."""
    for _ in range(TURNS):
        model = refitted(with_response(model, modes))
    return model


def profile_of(model: RecordModel, first: Sequence[FreeMode]) -> Profile:
    """Return what is sought of modes, from where they begin."""
    start, end = model.recording.span

    def at(other: RecordModel, theta: Floats) -> RecordModel:
        return agreed(other, modes_at(theta, first, moment_of(model)))

    steps = np.concatenate([first_steps(mode, end - start) for mode in first])
    bold = np.full(EACH, np.inf)
    bold[2] = BOLD
    return Profile(at, np.tile(np.array(SD), len(first)), np.tile(bold, len(first)), steps)


def moment_of(model: RecordModel) -> float:
    """Return the moment of inertia (kg m^2) that natural sizes are taken from."""
    return model.testbed.body.mean_moment


def first_steps(mode: FreeMode, span: float) -> Series1:
    """Return by how much unknowns are varied at first: a mode's phase at the end by 0.05 rad."""
    phase = 0.05 / (2.0 * float(np.pi) * mode.frequency * span)
    return np.array([phase, 100.0 * phase, 0.1, 0.01, 0.01, 0.02, 0.02])


def fit_modes(model: RecordModel, modes: Sequence[FreeMode]) -> ProfileFit:
    """Return the optimum of modes and all else, from first modes."""
    theta = vector_of(modes, modes, moment_of(model))
    return descended(profile_of(model, modes), model, theta)


def fit_at(model: RecordModel) -> ProfileFit:
    """Return what a model says of the modes that it is fitted with."""
    theta = vector_of(model.modes, model.modes, moment_of(model))
    return fit_here(profile_of(model, model.modes), model, theta)
