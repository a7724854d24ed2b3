"""The motion over a step in which the platform meets its stop, or is pressed on it.

A step that ends beyond the stop is taken again: to the moment at which it is met, where the
platform is laid down (``stop.land``), and from there on pressed. A step under pressure has a push p
at its start, such that it ends at the limit, and at its end loses what still tilts outwards. These
are the two halves of a step's pressure (as in the RATTLE method): energy errs by the square of the
step, and does not grow.
"""

from typing import NamedTuple

from equipoise.dynamics.propagation import step
from equipoise.dynamics.rigid_body import Body, body_at
from equipoise.dynamics.sensitivities import Inputs, Work
from equipoise.maths.kernels.compiled import kernel, part
from equipoise.maths.kernels.copying import copy_values
from equipoise.model.arrays import Floats
from equipoise.simulation.stop import (
    STILL,
    Stop,
    excess,
    is_beyond,
    land,
    lies,
    note,
    push,
    yielding,
)

HALVINGS = 20  # of the step in which it is met, chosen: to 1e-7 s
TRIES = 3  # of the push that ends a step at the limit, chosen: the third changes nothing


class Course(NamedTuple):
    """What the motion follows: the platform, its stop, and inputs at the nodes."""

    body: Body
    stop: Stop
    t: Floats  # s, of the nodes
    known: Floats
    inputs: Inputs  # row 0 is time zero, from which drift counts; rows 1 and 2 the ends of a step
    work: Work


@part
def lay(
    t: Floats, known: Floats, node: int, first: float, last: float, t3: Floats, known3: Floats
) -> None:
    """Write times and inputs at two shares of a gap into rows 1 and 2."""
    for row in range(1, 3):
        share = first if row == 1 else last
        t3[row] = t[node] + share * (t[node + 1] - t[node])
        for c in range(known.shape[1]):
            known3[row, c] = known[node, c] + share * (known[node + 1, c] - known[node, c])


@kernel
def advance(course: Course, node: int, first: float, last: float, y: Floats) -> None:
    """Take y from one share of a gap to another, in place."""
    body, _, t, known, inputs, work = course
    lay(t, known, node, first, last, inputs.t, inputs.known)
    step(body, inputs, 1, y, work)


@part
def lay_down(course: Course, y: Floats, touch: Floats) -> None:
    """Lay the platform on the stop at the end of a step."""
    body, stop, _, _, inputs, _ = course
    now = body_at(body, inputs.maps, inputs.t, inputs.known, 1, 1.0)
    land(stop, now, inputs.t[2], y, touch)


@kernel
def strike(
    course: Course, node: int, first: float, last: float, before: Floats, y: Floats, touch: Floats
) -> None:
    """Take y again over a step at whose end it was beyond the stop, from ``before``."""
    stop, met = course.stop, first
    if not lies(stop, before):
        met = meeting(course, node, first, last, before, y)
        copy_values(before, y)
        advance(course, node, first, met, y)
        lay_down(course, y, touch)
        copy_values(y, before)
    if met < last:
        press(course, node, met, last, before, y, touch)


@kernel
def meeting(
    course: Course, node: int, first: float, last: float, before: Floats, y: Floats
) -> float:
    """Return the share of a gap at which the stop is met, just after it."""
    early, late = first, last
    for _ in range(HALVINGS):
        middle = 0.5 * (early + late)
        copy_values(before, y)
        advance(course, node, first, middle, y)
        early, late = (early, middle) if is_beyond(course.stop, y) else (middle, late)
    return late


@kernel
def press(
    course: Course, node: int, first: float, last: float, before: Floats, y: Floats, touch: Floats
) -> None:
    """Take y over a step from ``before``, on the stop; it leaves it where nothing presses."""
    body, stop, t, known, inputs, work = course
    lay(t, known, node, first, last, inputs.t, inputs.known)
    start = body_at(body, inputs.maps, inputs.t, inputs.known, 1, 0.0)
    span, yields = inputs.t[2] - inputs.t[1], yielding(stop, start, before)
    p = pushed = 0.0
    for _ in range(TRIES):
        pushed = p
        copy_values(before, y)
        push(stop, pushed, y)
        step(body, inputs, 1, y, work)
        p += excess(stop, y) / (span * yields)
        if p <= 0.0:
            return
    if pushed * yields > STILL:
        note(stop, pushed, inputs.t[1], before, touch)
    if is_beyond(stop, y):
        lay_down(course, y, touch)
