"""Planar feedback: masses integrate the tilt away, coils damp the swing.

With n the vertical in body axes and n_p its part across ``up``,

    s'  = k_i n_p                       speed of the shift
    tau = -k_d w                        torque on the platform, by coils

A centre of mass that hangs by lambda below the pivot leans the platform until n_p = -(r + s)_p /
lambda. So at rest the masses creep to where it is level, (r + s)_p' = -w_i (r + s)_p with
w_i = k_i / lambda. With swing and damping about one axis,

    J theta'' + k_d theta' + m g lambda theta = m g (r + s),      s' = -k_i theta

is stable for k_d lambda > J k_i, that is for w_i < w_d = k_d / J (Routh). Masses are slow, so
gains keep w_i well below both w_d and the swing w_n = sqrt(m g lambda / J).

Coils are weak: full, they are worth the integral of a swing of A_s = tau_max / (m g lambda) w_n /
w_i, and beyond that the integral would drive the swing on. So in a swing of amplitude A it creeps
slower, by MARGIN A_s / A: the platform calms down first and is levelled then.

(Bahu and Modenini 2020, and their note of 2022, in which coils damp and masses integrate; the split
of the two is ours.)

Coils give the part of tau across the field. That takes energy out at any rate, even limited axis by
axis, only if all of the rate is damped: with w across the vertical alone, as published, a tilted
field spins the platform up about the vertical.

r along the vertical is unobservable. Coils give torque across the field only: a swing about a
horizontal field is not damped, and one about a tilted field in part.
"""

from typing import NamedTuple

import numpy as np

from equipoise.model.arrays import Vector3

DAMPING = 0.7  # chosen: of critical, where coils are not saturated
MARGIN = 0.5  # chosen: fields lean, and A is a running mean
SEPARATION = 0.2  # chosen: w_i of w_n, which is a seventh of where it is unsettled


class Plant(NamedTuple):
    """The platform and coils that the loop is designed for."""

    inertia: float  # kg m^2, the greatest about a horizontal axis
    weight: float  # N, m g
    coils: float  # N m, that they give across the field


class Loop(NamedTuple):
    """The gains, and the swing that they are for."""

    damping: float  # N m s, k_d
    integral: float  # m/s, k_i
    swing: float  # rad/s, w_n
    depth: float  # m, lambda
    calm: float  # rad, the amplitude up to which the integral may have its whole gain


def loop_for(plant: Plant, depth: float) -> Loop:
    """Return the gains for a centre of mass ``depth`` (m) below the pivot."""
    w_n = (plant.weight * depth / plant.inertia) ** 0.5
    calm = MARGIN / SEPARATION * plant.coils / (plant.weight * depth)
    k_d = 2 * DAMPING * w_n * plant.inertia
    return Loop(k_d, SEPARATION * w_n * depth, w_n, depth, calm)


def lean(gravity: Vector3, up: Vector3) -> Vector3:
    """Return n_p: the vertical's part across ``up``, its length the sine of the tilt."""
    n = -gravity / float(np.linalg.norm(gravity))
    return n - (n @ up) * up


def creep(gravity: Vector3, up: Vector3, swing: float, loop: Loop) -> Vector3:
    """Return the speed (m/s) of the shift for the present tilt, in a swing of some rad."""
    return loop.integral * min(1.0, loop.calm / max(swing, 1e-12)) * lean(gravity, up)


def damping_torque(rate: Vector3, loop: Loop) -> Vector3:
    """Return the torque on the platform (N m) that damps swing and spin."""
    return -loop.damping * rate
