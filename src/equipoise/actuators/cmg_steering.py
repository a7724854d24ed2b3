"""Gimbal rates that give a wanted torque on the platform, u = -D x' (Lee: h' = -u).

    pseudo-inverse       x' = -D^+ u                            exact; without bound near m = 0
    singularity-robust   x' = -D^T (D D^T + l E)^-1 u           Nakamura and Hanafusa 1986
                         l = 0.01 (1 - m / 0.4)^2 where m < 0.4, else 0
    generalised          x' = -D^T (D D^T + l E_d)^-1 u         Wie, Bailey and Heiberg 2001
                         l = 0.01 exp(-10 m^2),  E_d = [1 e3 e2; e3 1 e1; e2 e1 1],
                         e_i = 0.01 sin(pi t / 2 + f_i),  f = (0, pi / 2, pi)

with D in units of the mean momentum of a rotor and m its measure (``control_moment_gyros``).

The robust inverses trade torque for rates: |x'| is at most |u| / (2 sqrt(l)) in these units. With
u along a direction in which D has nothing, the singularity-robust inverse gives no rates at all:
at an internal elliptic singularity it stays there (gimbal lock), and no null motion leads out.
The dither of E_d does.

What is delivered is -D x', not u: whoever identifies takes it from measured angles
(``stored_momentum``). The gimbals' own momentum (gimbal_inertia x') is left out here: its torque
follows changes of the rates and is gone when they are steady.
"""

import numpy as np

from equipoise.actuators.control_moment_gyros import (
    Gyros,
    momenta_of,
    singularity_measure,
    unit_jacobian,
)
from equipoise.actuators.limiting import scaled
from equipoise.model.arrays import Floats, Matrix3, Vector3

WEIGHT = 0.01  # -, of both robust inverses (Wie); rates are then at most 5 |u| / momentum
NEAR = 0.4  # -, chosen: a measure of a quarter of the best, below which torque is traded for rates
STEEPNESS = 10.0  # -, Wie 2001
DITHER, PACE, PHASES = 0.01, np.pi / 2, np.array([0.0, np.pi / 2, np.pi])  # Wie 2001; rad/s, rad


def weighted_inverse(cmgs: Gyros, D: Floats, weight: Matrix3, torque: Vector3) -> Floats:
    """Return -D^T (D D^T + weight)^-1 torque, rad/s; D in units of the mean momentum."""
    return -D.T @ np.linalg.solve(D @ D.T + weight, torque) / momenta_of(cmgs).mean()


def pseudo_inverse(cmgs: Gyros, angles: Floats, torque: Vector3) -> Floats:
    """Return the least rates (k,) rad/s that give the torque (N m) exactly, where any do."""
    return -np.linalg.pinv(unit_jacobian(cmgs, angles)) @ torque / momenta_of(cmgs).mean()


def singularity_robust(cmgs: Gyros, angles: Floats, torque: Vector3) -> Floats:
    """Return rates (k,) rad/s that give the torque (N m), and less of it near singularities."""
    weight = WEIGHT * max(1.0 - singularity_measure(cmgs, angles) / NEAR, 0.0) ** 2
    if weight == 0.0:
        return pseudo_inverse(cmgs, angles, torque)
    return weighted_inverse(cmgs, unit_jacobian(cmgs, angles), weight * np.eye(3), torque)


def dithered_weight(cmgs: Gyros, angles: Floats, t: float) -> Matrix3:
    """Return l E_d at time t (s)."""
    e1, e2, e3 = DITHER * np.sin(PACE * t + PHASES)
    mixed = np.array([[1.0, e3, e2], [e3, 1.0, e1], [e2, e1, 1.0]])
    return WEIGHT * np.exp(-STEEPNESS * singularity_measure(cmgs, angles) ** 2) * mixed


def generalised_robust(cmgs: Gyros, angles: Floats, torque: Vector3, t: float) -> Floats:
    """Return rates (k,) rad/s that leave singularities by a dither in time t (s)."""
    weight = dithered_weight(cmgs, angles, t)
    return weighted_inverse(cmgs, unit_jacobian(cmgs, angles), weight, torque)


def limited_rates(cmgs: Gyros, rates: Floats) -> Floats:
    """Return the rates (rad/s) scaled within what the gimbals can do; torque keeps direction."""
    return scaled(rates, np.array([cmg.max_rate for cmg in cmgs]))
