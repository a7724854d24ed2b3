"""Reaction wheels: speeds to stored momentum, and a wanted torque to torques of the drives.

    h = sum I_i n_i a_i                  a_i axes, n_i speeds against the platform
    I_i n_i' = u_i,  torque on the platform = -h' = -sum a_i u_i
    u = -A^+ wanted                      A = [a_1 .. a_n]; of all that give it, the least |u|

(The platform's inertia counts rotors as locked, so that n_i is the speed against the platform and
no rate of the platform appears.) Torques stay within each drive's, and so small that no wheel
passes its greatest speed before the next step; all are scaled alike, so that the torque keeps its
direction. A wheel at its limit that would have to go on stops them all.

Axes that do not span all directions give the part of the torque in their span. Lags are not
modelled.
"""

from collections.abc import Sequence

import numpy as np

from equipoise.actuators.limiting import Delivered, scaled
from equipoise.model.arrays import Floats, Vector3
from equipoise.model.devices import JetPair, Magnetorquer, ReactionWheel

FLAT = 1e-2  # -, chosen: axes 0.5 deg off a plane are as good as in it


def axes_of(devices: Sequence[ReactionWheel | Magnetorquer | JetPair]) -> Floats:
    """Return the axes of devices, (n, 3)."""
    return np.array([device.axis for device in devices], dtype=np.float64).reshape(-1, 3)


def inertias_of(wheels: Sequence[ReactionWheel]) -> Floats:
    """Return the rotors' inertias about their axes, (n,) kg m^2."""
    return np.array([wheel.inertia for wheel in wheels], dtype=np.float64)


def wheel_momentum(wheels: Sequence[ReactionWheel], speeds: Floats) -> Floats:
    """Return the stored momentum (..., 3) N m s of speeds (..., n) rad/s."""
    return (speeds * inertias_of(wheels)) @ axes_of(wheels)


def span(axes: Floats) -> bool:
    """Say whether unit vectors (n, 3) span all three directions."""
    return len(axes) >= 3 and bool(np.linalg.svd(axes, compute_uv=False)[2] > FLAT)


def room(wheels: Sequence[ReactionWheel], speeds: Floats, torques: Floats, period: float) -> Floats:
    """Return the greatest torques (N m) of these signs that drives and speeds (rad/s) allow."""
    top = np.array([wheel.max_speed for wheel in wheels])
    drive = np.array([wheel.max_torque for wheel in wheels])
    left = (top - np.sign(torques) * speeds) * inertias_of(wheels) / period
    return np.clip(left, 0.0, drive)


def wheel_torques(
    wheels: Sequence[ReactionWheel], wanted: Vector3, speeds: Floats, period: float
) -> Delivered:
    """Return torques on the rotors, held for ``period`` (s), and the torque (N m) they deliver."""
    axes = axes_of(wheels)
    torques = -np.linalg.pinv(axes.T) @ wanted
    torques = scaled(torques, room(wheels, speeds, torques, period))
    return Delivered(torques, -torques @ axes)
