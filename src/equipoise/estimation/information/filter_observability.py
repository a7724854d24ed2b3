"""What filters can see of their own state along a motion.

The first state determines all that a filter measures. Its outputs' sensitivities to it, row upon
row along the motion, have the rank that the filter can see:

    S' = A(t) S,  S(0) = E,     y_k = C S(t_k) dx0,     rank [C S(t_0); C S(t_1); ...]

A(t) is in ``linearised_filters``; S is integrated by Runge-Kutta of order 4. S is about the
first state, not about corrections from row to row: the rank is that of the empirical observability
Gramian, and along a motion of some length that of the Lie derivatives. With sensors of no noise
every singular value counts that is not rounding; with the testbed's, every direction that the rows
show to half a natural size or better, as in ``observability``.

    kf [w, r]              simplified, gyro, attitude given      6 takes two attitudes
    ekf [w, r]             gyro, attitude given
    ekf [attitude, w, r]   camera alone
    ekf [w, J, mu]         gyro, attitude given                  free motion: 11 of 12
    reduced [w, r_z]       gyro, attitude given                  3 of 4 where g is along z

Where small changes of the state grow without bound, as those of a spin that the given attitude does
not steady, the sensitivities are restarted each time they have grown ten thousandfold, and what
one such stretch shows of the next by way of the state is given up. That may take something from a
rank with noise, and nothing from one without.

In free motion (J, mu) and (c J, c mu) move alike, and no momentum exchange device as such changes
that (da Silva 2021 after Eq. 38, R19): its momentum or torque must be known and the motion rich, or
a known move of a mass must stretch what cannot stretch along.

Cannot see how good a filter is: noise of the process, tuning and first guess are not asked about.
Attitude that is given counts as exact, and the gyro's zero as known.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from equipoise.estimation.information.linearised_filters import (
    Course,
    attitude_rate_com,
    course_of,
    rate_com,
    rate_inertia_moment,
    rate_vertical,
    simplified_stack,
)
from equipoise.estimation.information.reference_motion import Followed, halfway
from equipoise.estimation.parameters.fit_parameters import CORE, JP, RATE, TURN, Layout, R, core_of
from equipoise.estimation.parameters.observability import ALONG, OBSERVABLE, describe, natural_sizes
from equipoise.model.arrays import Floats, Series1
from equipoise.model.estimate import COM, INERTIA
from equipoise.model.observability import FilterView
from equipoise.model.reasons.data_reasons import Unobservable
from equipoise.model.reasons.reason import Reason

GROWN = 1e4  # chosen: growth behind which rounding does not hide what came before it
ROUNDING = 1e-9  # of the largest singular value, chosen: integration errs by less
SCALE = Reason(Unobservable.SCALE_OF_MOMENT)
TURNS, RATES = Layout().names[TURN], Layout().names[RATE]
MOMENT = ("moment_x", "moment_y", "moment_z")


@dataclass(frozen=True, slots=True)
class Model:
    """The model of a filter: its state, the first three of which it measures."""

    name: str
    states: tuple[str, ...]
    slopes: Callable[[Course], Floats] | None = None  # None: the simplified one
    camera: bool = False  # what it measures with; else a gyro


MODELS = (
    Model("kf [w, r]", (*RATES, *COM)),
    Model("ekf [w, r]", (*RATES, *COM), rate_com),
    Model("ekf [attitude, w, r]", (*TURNS, *RATES, *COM), attitude_rate_com, camera=True),
    Model("ekf [w, J, mu]", (*RATES, *INERTIA, *MOMENT), rate_inertia_moment),
    Model("reduced [w, r_z]", (*RATES, COM[2]), rate_vertical),
)


class Outputs(NamedTuple):
    """Sensitivities along a motion, to the state at the beginning of each stretch."""

    stack: Floats  # (n + 1, rows, s)
    starts: tuple[int, ...]  # nodes at which stretches begin
    moving: int  # k, how many of the states move; the others are constant


def transitions(slopes: Floats, step: Series1) -> Floats:
    """Return the moving rows of S from the start of each step to its end, (n, k, s)."""
    k = slopes.shape[2]

    def ahead(at: Floats, by: Floats, before: Floats) -> Floats:
        return at + by * (at[:, :, :k] @ before)

    h = step[:, None, None]
    first, middle, last = slopes[:, 0], slopes[:, 1], slopes[:, 2]
    second = ahead(middle, h / 2, first)
    third = ahead(middle, h / 2, second)
    fourth = ahead(last, h, third)
    return np.eye(k, slopes.shape[3]) + h / 6 * (first + 2 * second + 2 * third + fourth)


def state_sensitivities(slopes: Floats, step: Series1) -> Outputs:
    """Return the moving rows of S at every node, (n + 1, k, s); the others stay those of E.

    Where they have ``GROWN``, a new stretch begins.
    """
    parts = transitions(slopes, step)
    k = parts.shape[1]
    fresh = np.eye(*parts.shape[1:])
    out, starts = np.zeros((len(parts) + 1, *fresh.shape)), [0]
    out[0] = fresh
    for i, part in enumerate(parts):
        out[i + 1] = part[:, :k] @ out[i]
        out[i + 1, :, k:] += part[:, k:]
        if np.abs(out[i + 1, :, :k]).max() > GROWN:
            out[i + 1] = fresh
            starts.append(i + 1)
    return Outputs(out, tuple(starts), k)


def output_sensitivities(model: Model, course: Course) -> Outputs:
    """Return C S at every node, (n + 1, 3, s), in SI units."""
    if model.slopes is None:
        gravity = np.append(course.gravity[:, 0], course.gravity[-1:, 2], axis=0)
        stack = simplified_stack(gravity, course.inertia[0, 0], course.mass, course.step)
        return Outputs(stack, (0,), 3)
    found = state_sensitivities(model.slopes(course), course.step)
    return found._replace(stack=found.stack[:, :3])


def joined(outputs: Outputs, weight: Series1, size: Floats) -> Floats:
    """Return one stack (N, 3, s) for the first state, rows weighted, states in natural sizes.

    Of a stretch behind the first only that counts which no state at its own beginning explains.
    """
    k, width = outputs.moving, outputs.stack.shape[-1]
    rows = outputs.stack * weight[:, None, None] * size
    first, *others = np.split(rows, outputs.starts[1:])
    found = [first]
    for part in others:
        flat = part.reshape(-1, width)
        by_state = np.linalg.lstsq(flat[:, :k], flat[:, k:])[0]
        rest = np.hstack([0.0 * flat[:, :k], flat[:, k:] - flat[:, :k] @ by_state])
        found.append(rest.reshape(part.shape))
    return np.concatenate(found)


def unseen_of(stack: Floats, least: float) -> Floats:
    """Return the directions (s, u) along which a stack (N, 3, s) has at most ``least``."""
    rows = stack.reshape(-1, stack.shape[-1])
    _, values, vectors = np.linalg.svd(rows, full_matrices=len(rows) < rows.shape[1])
    short = np.append(values, np.zeros(len(vectors) - len(values))) <= least
    return vectors[short].T


def exactly_unseen(stack: Floats) -> Floats:
    """Return the directions (s, u) along which nothing changes but by rounding."""
    return unseen_of(stack, ROUNDING * float(np.linalg.norm(stack.reshape(-1, stack.shape[-1]), 2)))


def spelled(unseen: Floats, scale: Floats) -> list[Floats]:
    """Return directions that span the unobservable ones, the scale first, then few states each.

    A basis as it comes mixes what is equally unobservable. ``scale`` is of unit length, or zero.
    """
    found: list[Floats] = []
    left = unseen @ unseen.T
    for turn in range(unseen.shape[1]):
        along = left @ scale
        if turn or float(np.linalg.norm(along)) <= ALONG:
            along = left[:, int(np.argmax(np.diag(left)))]
        direction = along / np.linalg.norm(along)
        found.append(direction)
        left = left - np.outer(direction, direction)
    return found


def directions(unseen: Floats, scale: Floats, names: tuple[str, ...]) -> tuple[Reason, ...]:
    """Return each direction that is not observable, named by its parameters."""
    return tuple(
        SCALE if abs(float(direction @ scale)) > ALONG else describe(direction, names)
        for direction in spelled(unseen, scale)
    )


def sizes_of(model: Model, motion: Followed) -> Floats:
    """Return the natural size of each state, SI."""
    fitted = motion.fitted
    mass, layout = fitted.problem.mass, fitted.problem.layout
    size = dict(zip(layout.names, natural_sizes(fitted.point, mass, layout), strict=True))
    moments = {name: mass * size[com] for name, com in zip(MOMENT, COM, strict=True)}
    return np.array([(size | moments)[name] for name in model.states])


def scale_in(model: Model, motion: Followed) -> Floats:
    """Return the direction that stretches J and mu alike, in natural sizes; zero without J."""
    if INERTIA[0] not in model.states:
        return np.zeros(len(model.states))
    mass = motion.fitted.problem.mass
    core = core_of(motion.fitted.point.body(mass))
    inertia, com = core[: JP.stop - JP.start], core[R.start - CORE.start :]
    values = np.concatenate([np.zeros(3), inertia, mass * com])
    stretched = values / sizes_of(model, motion)
    return stretched / np.linalg.norm(stretched)


def view_of(model: Model, course: Course, motion: Followed) -> FilterView:
    """Return what one filter sees along a motion."""
    observed = motion.fitted.problem.observed
    nodes, sd = (
        (observed.attitude_node, observed.attitude_sd)
        if model.camera
        else (observed.rate_node, observed.rate_sd)
    )
    outputs, size = output_sensitivities(model, course), sizes_of(model, motion)
    count = len(outputs.stack)
    unseen, rank = exactly_unseen(joined(outputs, np.ones(count), size)), None
    possible = len(size) - unseen.shape[1]
    if len(nodes):
        rows = np.bincount(nodes, minlength=count)  # at each node, or in the step behind it
        weight = np.sqrt(rows.astype(np.float64)) / sd
        unseen = unseen_of(joined(outputs, weight, size), OBSERVABLE**0.5)
        rank = len(size) - unseen.shape[1]
    unobservable = directions(unseen, scale_in(model, motion), model.states)
    measures = "camera" if model.camera else "gyro"
    return FilterView(model.name, len(size), measures, possible, rank, unobservable)


def filters_along(motion: Followed) -> tuple[FilterView, ...]:
    """Return what each filter sees along a motion that was followed."""
    problem, point = motion.fitted.problem, motion.fitted.point
    line, path = halfway(motion.fitted)
    course = course_of(line, path, point.body(problem.mass), problem.maps, problem.gravity)
    return tuple(view_of(model, course, motion) for model in MODELS)
