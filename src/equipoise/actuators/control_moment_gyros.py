"""Control moment gyros: gimbal angles to stored momentum, its slope, and the change of inertia.

    s_i(x) = cos(x_i) s0_i + sin(x_i) n_i,     n_i = g_i x s0_i
    h      = sum momentum_i s_i + gimbal_inertia_i x_i' g_i
    D      = dh/dx = [momentum_i g_i x s_i]    (3, n)
    m      = sqrt(det(D D^T)) / mean(momentum)^3

(Lee; Wie 2001. For equal gyros m is the measure of the papers with D in units of the rotors'
momentum: a pure number, 0 where some direction has no torque, 1.54 for four that stand best.)
Gimbal with rotor has inertia diag(along s, third, along g), so that turning it changes the
platform's by asymmetry (s s^T - s0 s0^T), which is linear in two functions of the angle:

    s s^T - s0 s0^T = sin cos (s0 n^T + n s0^T) + sin^2 (n n^T - s0 s0^T)

The propagator models masses on rails, whose displacement changes mu, J and h. Three coordinates of
a gyro, x, sin x cos x and sin^2 x, without first moment, represent all but the rotor's momentum:
x carries the gimbal's (gimbal_inertia x' g), the others the inertia. Where
``gimbal_maps`` are given, stored momentum is the rotors' alone. The coordinates are straight lines
between nodes: these must be close to one another while a gimbal turns.

Gimbals whose centre of mass is off their axis, or whose products of inertia matter, are not
modelled.
"""

from collections.abc import Sequence

import numpy as np

from equipoise.actuators.reaction_wheels import span
from equipoise.actuators.sliding_masses import MassMaps
from equipoise.maths.linalg import PAIRS
from equipoise.model.arrays import Floats
from equipoise.model.devices import ControlMomentGyro

Gyros = Sequence[ControlMomentGyro]
COORDINATES = 3  # of a gyro: x, sin x cos x, sin^2 x


def momenta_of(cmgs: Gyros) -> Floats:
    """Return the rotors' momenta, (k,) N m s."""
    return np.array([cmg.momentum for cmg in cmgs], dtype=np.float64)


def frame(cmgs: Gyros) -> tuple[Floats, Floats, Floats]:
    """Return gimbal axes g, spin axes s0 at angle zero and n = g x s0, (k, 3) each."""
    g = np.array([cmg.gimbal_axis for cmg in cmgs], dtype=np.float64).reshape(-1, 3)
    s0 = np.array([cmg.spin_axis for cmg in cmgs], dtype=np.float64).reshape(-1, 3)
    return g, s0, np.cross(g, s0)


def spin_axes(cmgs: Gyros, angles: Floats) -> Floats:
    """Return the spin axes (..., k, 3) at gimbal angles (..., k) rad."""
    _, s0, n = frame(cmgs)
    return np.cos(angles)[..., None] * s0 + np.sin(angles)[..., None] * n


def rotor_momentum(cmgs: Gyros, angles: Floats) -> Floats:
    """Return the momentum of the rotors (..., 3) N m s at gimbal angles (..., k) rad."""
    return momenta_of(cmgs) @ spin_axes(cmgs, angles)


def gimbal_momentum(cmgs: Gyros, rates: Floats) -> Floats:
    """Return the momentum (..., 3) N m s of gimbals that turn at ``rates`` (..., k) rad/s."""
    inertia = np.array([cmg.gimbal_inertia for cmg in cmgs], dtype=np.float64)
    return (rates * inertia) @ frame(cmgs)[0]


def jacobian(cmgs: Gyros, angles: Floats) -> Floats:
    """Return D = dh/dangles (..., 3, k), N m s; torque on the platform is -D rates."""
    _, s0, n = frame(cmgs)
    across = np.cos(angles)[..., None] * n - np.sin(angles)[..., None] * s0
    return np.swapaxes(momenta_of(cmgs)[:, None] * across, -1, -2)


def unit_jacobian(cmgs: Gyros, angles: Floats) -> Floats:
    """Return D (3, k) in units of the mean momentum of a rotor."""
    return jacobian(cmgs, angles) / momenta_of(cmgs).mean()


def singularity_measure(cmgs: Gyros, angles: Floats) -> float:
    """Return m at gimbal angles (k,) rad: 0 where a direction has no torque."""
    D = unit_jacobian(cmgs, angles)
    return float(max(np.linalg.det(D @ D.T), 0.0)) ** 0.5


def gyros_span(cmgs: Gyros) -> bool:
    """Say whether there are gimbal angles at which the gyros give a torque along every direction.

    Three gyros do unless all gimbal axes are parallel.
    """
    _, s0, n = frame(cmgs)
    return len(cmgs) >= 3 and span(np.vstack([s0, n]))


def gimbal_coordinates(cmgs: Gyros, angles: Floats) -> Floats:
    """Return x, sin x cos x and sin^2 x of every gyro, (n, 3 k), at gimbal angles (n, k) rad."""
    sine, cosine = np.sin(angles), np.cos(angles)
    each = np.stack([angles, sine * cosine, sine**2], axis=-1)
    return each.reshape(-1, COORDINATES * len(cmgs))


def gimbal_maps(cmgs: Gyros) -> MassMaps:
    """Return the effect of ``gimbal_coordinates`` on inertia and momentum, three rows a gyro."""
    g, s0, n = frame(cmgs)
    i, j = np.array(PAIRS).T
    asymmetry = np.array([cmg.asymmetry for cmg in cmgs]).reshape(-1, 1)
    inertia, momentum = np.zeros((len(cmgs), 3, 6)), np.zeros((len(cmgs), 3, 3))
    inertia[:, 1] = asymmetry * (s0[:, i] * n[:, j] + n[:, i] * s0[:, j])
    inertia[:, 2] = asymmetry * (n[:, i] * n[:, j] - s0[:, i] * s0[:, j])
    momentum[:, 0] = np.array([cmg.gimbal_inertia for cmg in cmgs]).reshape(-1, 1) * g
    rows = COORDINATES * len(cmgs)
    none3, none6 = np.zeros((rows, 3)), np.zeros((rows, 6))
    return MassMaps(none3, inertia.reshape(-1, 6), none6, momentum.reshape(-1, 3))
