"""A point of the search and what a step makes of it, compiled.

A point is one flat array

    [ q0 (4) | w0 (3) | six (6) | com (3) | torque (19) | sensors (40) | displacement errors
      | gyro bias (3) ]

with the inertia as the six numbers of ``maths.pseudo_inertia``, so that it is a body that can
exist. A step is in physical coordinates (``fit_parameters``), where the residuals are nearly
linear. One that would leave the possible bodies is sought again along their boundary

    v.Sigma_C v = floor,      d(v.Sigma_C v) = 1/2 tr dJ_P - v.dJ_P v - 2 m (v.r) v.dr

(steps in the six numbers themselves crawl when the body is nearly flat: see docs/decisions/0008).
"""

from typing import NamedTuple

import numpy as np

from equipoise.dynamics.regressor import N_TORQUES
from equipoise.dynamics.rigid_body import Body, times
from equipoise.maths.eigen import eigen
from equipoise.maths.kernels.compiled import kernel, part
from equipoise.maths.pseudo_inertia import FLOOR, exceeds, inertia_of, second_moments_of, six_of
from equipoise.maths.scaled_solve import factorise, solve
from equipoise.maths.turns import turned
from equipoise.model.arrays import Floats, Ints, Six, Triple
from equipoise.sensors.camera import N_SENSOR

W, SIX, COM, TORQUE = 4, 7, 13, 16  # where a point keeps what is behind q0
SENSOR = TORQUE + N_TORQUES
ERROR = SENSOR + N_SENSOR
J, R, BEHIND = 6, 12, 15  # first coordinate of J_P, of com, of what is behind it
ATTEMPTS = 8  # chosen: at steps along a boundary that is bent


class StepWork(NamedTuple):
    """Arrays in which a step is sought, made once."""

    free: Floats  # (n,) the step without a boundary
    scale: Floats  # (n,)
    factors: Floats  # (n, n)
    rows: Floats  # (3, n) C
    gaps: Floats  # (3,) d
    toward: Floats  # (3, n) A^-1 C^T, one row a boundary
    crossed: Floats  # (3, 3) C A^-1 C^T
    crossed_scale: Floats  # (3,)
    crossed_factors: Floats  # (3, 3)
    lacking: Floats  # (3,) d - C step
    pull: Floats  # (3,)


@kernel
def step_work_for(unknowns: int) -> StepWork:
    """Return the arrays for so many unknowns."""
    n = unknowns
    return StepWork(np.empty(n), np.empty(n), np.empty((n, n)), np.empty((3, n)), np.empty(3),
                    np.empty((3, n)), np.empty((3, 3)), np.empty(3), np.empty((3, 3)),
                    np.empty(3), np.empty(3))  # fmt: skip


@part
def com_of(point: Floats) -> Triple:
    """Return the centre of mass, m."""
    return (point[COM], point[COM + 1], point[COM + 2])


@part
def away(mass: float, r: Triple) -> Six:
    """Return m (|r|^2 E - r r^T): the inertia of a point mass at r."""
    x, y, z = r
    return (mass * (y * y + z * z), mass * (x * x + z * z), mass * (x * x + y * y),
            -mass * x * y, -mass * x * z, -mass * y * z)  # fmt: skip


@part
def plus(a: Six, b: Six, weight: float) -> Six:
    """Return a + weight b."""
    return (a[0] + weight * b[0], a[1] + weight * b[1], a[2] + weight * b[2],
            a[3] + weight * b[3], a[4] + weight * b[4], a[5] + weight * b[5])  # fmt: skip


@part
def six_at(values: Floats, first: int) -> Six:
    """Return six numbers of an array."""
    k = first
    return (values[k], values[k + 1], values[k + 2], values[k + 3], values[k + 4], values[k + 5])


@part
def inertia_C(point: Floats) -> Six:
    """Return J_C, masses at home."""
    return inertia_of(six_at(point, SIX))


@part
def inertia_P(point: Floats, mass: float) -> Six:
    """Return J_P, masses at home."""
    return plus(inertia_C(point), away(mass, com_of(point)), 1.0)


@part
def body_at_point(point: Floats, mass: float, gravity: float) -> Body:
    """Return the platform of a point as the propagator sees it."""
    x, y, z = com_of(point)
    c = point[TORQUE:SENSOR]
    torque = (c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7], c[8], c[9], c[10], c[11], c[12],
              c[13], c[14], c[15], c[16], c[17], c[18])  # fmt: skip
    torqued = False
    for k in range(SENSOR - TORQUE):
        torqued |= c[k] != 0.0
    moment = (mass * x, mass * y, mass * z)
    return Body(mass, gravity, inertia_P(point, mass), moment, torqued, torque)


@part
def coordinates_of(point: Floats, mass: float, slots: Ints, out: Floats) -> None:
    """Write the physical coordinates; ``slots`` says where a point keeps each, -1: not at all."""
    inertia = inertia_P(point, mass)
    for k in range(slots.shape[0]):
        out[k] = point[slots[k]] if slots[k] >= 0 else 0.0
    for k in range(6):
        out[J + k] = inertia[k]


@kernel
def coordinates(point: Floats, mass: float, slots: Ints) -> Floats:
    """Return the physical coordinates; the turn of the first attitude is zero at the point."""
    out = np.empty(slots.shape[0])
    coordinates_of(point, mass, slots, out)
    return out


@part
def retract(point: Floats, step: Floats, mass: float, slots: Ints, out: Floats) -> None:
    """Write the point after a step in physical coordinates."""
    for k in range(point.shape[0]):
        out[k] = point[k]
    for k in range(step.shape[0]):
        if slots[k] >= 0:
            out[slots[k]] += step[k]
    w, x, y, z = turned(point, step[0], step[1], step[2])
    norm = (w * w + x * x + y * y + z * z) ** -0.5
    out[0], out[1], out[2], out[3] = norm * w, norm * x, norm * y, norm * z
    moved = plus(inertia_P(point, mass), six_at(step, J), 1.0)
    six = six_of(plus(moved, away(mass, com_of(out)), -1.0))
    for k in range(6):
        out[SIX + k] = six[k]


@part
def boundary(point: Floats, mass: float, step: Floats, rows: Floats, gaps: Floats) -> int:
    """Write rows C and gaps d with C step = d on the boundary; return how many there are.

    One for each moment that a step takes below the floor; none when the step leads to a possible
    body.
    """
    r, inertia = com_of(point), inertia_P(point, mass)
    there = (r[0] + step[R], r[1] + step[R + 1], r[2] + step[R + 2])
    moved = plus(plus(inertia, six_at(step, J), 1.0), away(mass, there), -1.0)
    sigma, floor = second_moments_of(moved), FLOOR * (inertia[0] + inertia[1] + inertia[2])
    if exceeds(sigma, floor):
        return 0
    values, vectors = eigen(sigma)
    now, count = second_moments_of(inertia_C(point)), 0
    for k in range(3):
        if values[k] < floor:
            v = vectors[k]
            write_row(v, mass, r, rows[count])
            s = times(now, v)
            gaps[count] = 2.0 * floor - (v[0] * s[0] + v[1] * s[1] + v[2] * s[2])
            count += 1
    return count


@part
def write_row(v: Triple, mass: float, r: Triple, row: Floats) -> None:
    """Write d(v.Sigma_C v) by every coordinate."""
    row[:] = 0.0
    for k in range(3):
        row[J + k] = 0.5 - v[k] * v[k]
        row[R + k] = -2.0 * mass * (v[0] * r[0] + v[1] * r[1] + v[2] * r[2]) * v[k]
    row[J + 3], row[J + 4], row[J + 5] = -2.0 * v[0] * v[1], -2.0 * v[0] * v[2], -2.0 * v[1] * v[2]


@part
def stride(step: Floats, trace: float) -> float:
    """Return the length of a step in units beyond which no local model holds.

    These are a radian, a radian a second, the body's own inertia, the trace of J_P.
    """
    total = 0.0
    for k in range(6):
        size = step[J + k] / trace
        total += step[k] * step[k] + size * size
    return total**0.5


@part
def shorten(step: Floats, trace: float) -> None:
    """Cut a step that is too long for the local model."""
    length = stride(step, trace)
    if length > 1.0:
        for k in range(step.shape[0]):
            step[k] /= length


@part
def meet(count: int, work: StepWork, step: Floats) -> None:
    """Write the step nearest to the free one, by the local model, that meets C step = d."""
    free, rows, toward, crossed = work.free, work.rows, work.toward, work.crossed
    lacking, pull, n = work.lacking[:count], work.pull[:count], step.shape[0]
    for a in range(count):
        solve(work.scale, work.factors, rows[a], toward[a])
        lacking[a] = work.gaps[a]
        for k in range(n):
            lacking[a] -= rows[a, k] * free[k]
    for a in range(count):
        for b in range(count):
            crossed[a, b] = 0.0
            for k in range(n):
                crossed[a, b] += rows[a, k] * toward[b, k]
    factorise(crossed[:count, :count], 0.0, work.crossed_scale, work.crossed_factors)
    solve(work.crossed_scale, work.crossed_factors, lacking, pull)
    for k in range(n):
        step[k] = free[k]
        for a in range(count):
            step[k] += pull[a] * toward[a, k]


@part
def possible_step(
    point: Floats, mass: float, normal: Floats, descent: Floats, damping: float, work: StepWork,
    step: Floats,
) -> None:  # fmt: skip
    """Write the damped step to the least of the local model among possible bodies."""
    inertia = inertia_P(point, mass)
    trace = inertia[0] + inertia[1] + inertia[2]
    factorise(normal, damping, work.scale, work.factors)
    solve(work.scale, work.factors, descent, work.free)
    shorten(work.free, trace)
    for k in range(step.shape[0]):
        step[k] = work.free[k]
    for _ in range(ATTEMPTS):
        count = boundary(point, mass, step, work.rows, work.gaps)
        if count == 0:
            break
        meet(count, work, step)
    shorten(step, trace)
