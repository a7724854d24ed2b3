"""The one propagator: a body along a timeline by classical Runge-Kutta of order 4.

It gives the trajectory, or the trajectory with its sensitivities, or (for the fit) the normal
equations of the residuals without ever storing the sensitivities, so that memory grows with the
data and not with data times parameters.
"""

from typing import NamedTuple

import numpy as np

from equipoise.actuators.sliding_masses import MassMaps
from equipoise.dynamics.forcing import forcing, groups_of
from equipoise.dynamics.rigid_body import (
    NO_TORQUE,
    ROWS,
    Body,
    Now,
    body_at,
    body_within,
    drifts,
    gravity_of,
    motion,
    rate_of,
    times,
)
from equipoise.dynamics.sensitivities import (
    ERROR,
    INERTIA,
    LANES,
    RATE,
    TURN,
    Columns,
    Groups,
    Inputs,
    Work,
    linearise,
    place,
    room_for,
    sensitivity_rates,
    work_for,
)
from equipoise.dynamics.timeline import Timeline
from equipoise.maths.kernels.compiled import kernel, part
from equipoise.maths.kernels.copying import copy_values
from equipoise.maths.linalg import pack_symmetric
from equipoise.model.arrays import Floats, Ints, Quaternion, Triple, Vector3, Vector6
from equipoise.model.mass_properties import MassProperties


class Motion(NamedTuple):
    """A trajectory at every node of the timeline."""

    q: Floats  # (n+1, 4)
    momentum: Floats  # (n+1, 3) N m s, total about P, body axes
    rate: Floats  # (n+1, 3) rad/s
    turn_by: Floats  # (n+1, 3, columns) d(rotation vector)/dp
    rate_by: Floats  # (n+1, 3, columns) d(rate)/dp


def body_of(
    mass: float, gravity: float, inertia: Vector6, moment: Vector3, torque: Floats | None = None
) -> Body:
    """Return the platform as the kernels see it; ``torque`` are the 16 coefficients."""
    six = tuple(float(x) for x in inertia)
    three = tuple(float(x) for x in moment)
    terms = NO_TORQUE if torque is None else tuple(float(x) for x in torque)
    torqued = any(x != 0 for x in terms)
    return Body(float(mass), float(gravity), six, three, torqued, terms)  # pyright: ignore


def rigid_body(body: MassProperties, gravity: float, torque: Floats | None = None) -> Body:
    """Return the same from mass properties."""
    return body_of(body.mass, gravity, pack_symmetric(body.inertia_P), body.first_moment, torque)


@part
def evaluate(
    body: Body, now: Now, inputs: Inputs, i: int, share: float, y: Floats, work: Work
) -> tuple[Triple, Triple]:
    """Return rate and gravity at ``share`` of step i; write the forcing."""
    w, g = rate_of(now, y), gravity_of(y, body.gravity)
    if work.fb.shape[0]:
        forcing(body, now, inputs, i, share, w, g, work)
    return w, g


@part
def start(
    body: Body, now: Now, inputs: Inputs, i: int, share: float, q: Floats, w: Floats, y: Floats,
    work: Work,
) -> None:  # fmt: skip
    """Write q, H = J w + h and their sensitivities at ``share`` of step i."""
    columns, fb = inputs.columns, work.fb
    H = times(now.inertia, (w[0], w[1], w[2]))
    y[:] = 0.0
    for j in range(4):
        y[j] = q[j]
    for j in range(3):
        y[4 + j] = H[j] + now.momentum[j]
    evaluate(body, now, inputs, i, share, y, work)
    for c in range(columns.kinds.shape[0]):
        kind, k, first = columns.kinds[c], columns.indices[c], place(c)
        if kind == TURN:
            y[ROWS + first + k * LANES] = 1.0
        unit = times(now.inertia, (1.0 * (k == 0), 1.0 * (k == 1), 1.0 * (k == 2)))
        for j in range(3):
            if kind == RATE:
                y[ROWS + first + (3 + j) * LANES] = unit[j]
            elif kind in (INERTIA, ERROR):
                y[ROWS + first + (3 + j) * LANES] = fb[first + j * LANES]


@part  # apart from ``slope_at``, as compiled results depend on how kernels are cut
def slope(body: Body, now: Now, w: Triple, g: Triple, y: Floats, work: Work, dy: Floats) -> None:
    """Write y' from the rate and the forcing of ``evaluate``."""
    motion(body, now, y, w, g, work.regress, dy)
    if work.fb.shape[0]:
        by_rate, by_turn = linearise(body, now, y, w, g)
        sensitivity_rates(now.inverse, w, by_rate, by_turn, work.fb, y, dy)


@part
def slope_at(
    body: Body, now: Now, inputs: Inputs, i: int, share: float, y: Floats, work: Work, dy: Floats
) -> None:
    """Write y' at ``share`` of step i, the platform being as it is ``now``."""
    w, g = evaluate(body, now, inputs, i, share, y, work)
    slope(body, now, w, g, y, work, dy)


@part
def step_from(
    body: Body, here: Now, fixed: bool, inputs: Inputs, i: int, y: Floats, first: Floats, work: Work
) -> None:
    """Take y over step i, in place; ``first`` is the slope at its beginning, ``here``."""
    t, at, dy, total = inputs.t, work.at, work.dy, work.total
    h, m = t[i + 1] - t[i], y.shape[0]
    for j in range(m):
        total[j] = first[j]
        at[j] = y[j] + 0.5 * h * first[j]
    for k in range(1, 4):
        share, weight = (1.0, 1.0) if k == 3 else (0.5, 2.0)
        ahead = h if k == 2 else 0.5 * h
        now = body_within(body, inputs.maps, t, inputs.known, i, share, fixed, here)
        slope_at(body, now, inputs, i, share, at, work, dy)
        for j in range(m):
            total[j] += weight * dy[j]
            at[j] = y[j] + ahead * dy[j]
    for j in range(m):
        y[j] += h / 6 * total[j]
    to_unit(y)


@part
def advance(
    body: Body, here: Now, fixed: bool, sloped: bool, inputs: Inputs, i: int, y: Floats,
    ends: tuple[Floats, Floats, Floats], work: Work,
) -> Now:  # fmt: skip
    """Take y over step i, in place, and return the platform as it is at its end.

    Write what ``interpolate`` takes: y at the beginning, and the slopes at both ends. ``sloped``:
    the last of ``ends`` is the slope at the beginning already, that at the end of the step before.
    """
    y0, dy0, dy1 = ends
    if not sloped:
        slope_at(body, here, inputs, i, 0.0, y, work, dy1)
    for j in range(y.shape[0]):
        y0[j], dy0[j] = y[j], dy1[j]
    step_from(body, here, fixed, inputs, i, y, dy0, work)
    now = body_within(body, inputs.maps, inputs.t, inputs.known, i, 1.0, fixed, here)
    slope_at(body, now, inputs, i, 1.0, y, work, dy1)
    return now


@part
def to_unit(y: Floats) -> None:
    """Bring the quaternion to unit length."""
    norm = (y[0] * y[0] + y[1] * y[1] + y[2] * y[2] + y[3] * y[3]) ** -0.5
    for j in range(4):
        y[j] *= norm


@part
def step(body: Body, inputs: Inputs, i: int, y: Floats, work: Work) -> None:
    """Take y over step i, in place."""
    here = body_at(body, inputs.maps, inputs.t, inputs.known, i, 0.0)
    fixed = steady(inputs.known, i) and not drifts(body)
    slope_at(body, here, inputs, i, 0.0, y, work, work.total)
    step_from(body, here, fixed, inputs, i, y, work.total, work)


@part
def steady(known: Floats, i: int) -> bool:
    """Say whether no known input changes over step i."""
    for j in range(known.shape[1]):  # noqa: SIM110 - the compiler takes no generator
        if known[i, j] != known[i + 1, j]:
            return False
    return True


@part
def hermite(h: float, share: float, spread: float) -> tuple[float, float, float, float]:
    """Return the weights of both ends of a step of h seconds, each with its slope behind it.

    They give the mean of the cubic over moments around ``share`` whose variance is ``spread``
    (s^2): f + 1/2 spread f'', exact for a cubic and moments that lie evenly on both sides.
    """
    s, r, v = share, 1.0 - share, 0.5 * spread / (h * h)
    return (
        (1 + 2 * s) * r * r + v * (12 * s - 6),
        h * (s * r * r + v * (6 * s - 4)),
        s * s * (3 - 2 * s) + v * (6 - 12 * s),
        h * (v * (6 * s - 2) - s * s * r),
    )


@part
def interpolate(
    y0: Floats, dy0: Floats, y1: Floats, dy1: Floats, h: float, share: float, spread: float,
    out: Floats,
) -> None:  # fmt: skip
    """Write the state within a step of h seconds: the cubic through both ends and their slopes.

    As much of it as ``out`` has room for. It errs by (w h)^4 / 384 of a motion's amplitude, w
    being its frequency. A ``spread`` makes it a mean, as ``hermite`` says.
    """
    a, b, c, d = hermite(h, share, spread)
    for j in range(out.shape[0]):
        out[j] = a * y0[j] + b * dy0[j] + c * y1[j] + d * dy1[j]
    to_unit(out)


@part
def rate_sensitivity(now: Now, y: Floats, fb: Floats, out: Floats) -> None:
    """Write dw = J^-1 (dH - f) of every column."""
    for c in range(out.shape[1]):
        i = place(c)
        k = ROWS + i + 3 * LANES
        dw = times(now.inverse, (y[k] - fb[i], y[k + LANES] - fb[i + LANES],
                                 y[k + 2 * LANES] - fb[i + 2 * LANES]))  # fmt: skip
        for j in range(3):
            out[j, c] = dw[j]


@kernel
def _run(
    body: Body, maps: Floats, t: Floats, known: Floats, owners: Ints, columns: Columns, q0: Floats,
    w0: Floats, out: Motion,
) -> None:  # fmt: skip
    inputs, n = Inputs(maps, t, known, owners, columns, groups_of(columns)), columns.kinds.shape[0]
    y, work, last = np.empty(ROWS + room_for(n)), work_for(n), t.shape[0] - 2
    for node in range(t.shape[0]):
        # at a corner of the inputs, as the step that leaves it sees them
        i, share = (last, 1.0) if node > last else (node, 0.0)
        now = body_at(body, inputs.maps, t, inputs.known, i, share)
        if node == 0:
            start(body, now, inputs, i, share, q0, w0, y, work)
        rate, _ = evaluate(body, now, inputs, i, share, y, work)
        copy_values(y[:4], out.q[node])
        copy_values(y[4:7], out.momentum[node])
        for j in range(3):
            out.rate[node, j] = rate[j]
            for c in range(n):
                out.turn_by[node, j, c] = y[ROWS + place(c) + j * LANES]
        rate_sensitivity(now, y, work.fb, out.rate_by[node])
        if node <= last:
            step(body, inputs, node, y, work)


NO_COLUMNS = Columns(np.zeros(0, dtype=np.int64), np.zeros(0, dtype=np.int64))
NO_GROUPS = Groups(-1, -1, False)  # of these


def stacked(maps: MassMaps) -> Floats:
    """Return the mass maps side by side, one row a mass."""
    return np.hstack([maps.first_moment, maps.inertia_1, maps.inertia_2, maps.momentum])


def propagate(
    body: Body,
    maps: MassMaps,
    line: Timeline,
    q0: Quaternion,
    w0: Vector3,
    columns: Columns = NO_COLUMNS,
) -> Motion:
    """Return the motion at every node, with its sensitivities to ``columns``."""
    n, c = len(line.t), len(columns.kinds)
    out = Motion(*[np.zeros((n, *s)) for s in ((4,), (3,), (3,), (3, c), (3, c))])
    _run(body, stacked(maps), line.t, line.known, line.owners, columns, q0, w0, out)
    return out
