"""Magnetorquers: dipoles in a field to torque, and back.

    torque = (sum d_i a_i) x B
    wanted -> m = (B x wanted) / |B|^2,  torque = wanted - B (B . wanted) / |B|^2

Torque along B cannot be made, whatever the coils: that part of the wanted torque is lost, and
missing in the delivered one. The dipoles are the least that come nearest to the torque: for coils
along all directions they sum up to m, for fewer to its part in their span. Beyond a coil's dipole
all are scaled alike. Without a field there is no torque, and no dipole. Lags are not modelled.
"""

from collections.abc import Sequence

import numpy as np

from equipoise.actuators.limiting import Delivered, scaled
from equipoise.actuators.reaction_wheels import axes_of
from equipoise.model.arrays import Floats, Vector3
from equipoise.model.devices import Magnetorquer

FAINT = 1e-6  # -, chosen: of the strongest direction; a weaker one is rounding, or along B


def dipole_of(coils: Sequence[Magnetorquer], dipoles: Floats) -> Floats:
    """Return the sum of dipoles (..., n) A m^2 as a vector (..., 3)."""
    return dipoles @ axes_of(coils)


def magnetic_torque(coils: Sequence[Magnetorquer], dipoles: Floats, field: Floats) -> Floats:
    """Return the torque (..., 3) N m of dipoles (..., n) A m^2 in a field (..., 3) T, body axes."""
    return np.cross(dipole_of(coils, dipoles), field)


def dipoles_for(coils: Sequence[Magnetorquer], wanted: Vector3, field: Vector3) -> Delivered:
    """Return dipoles (n,) A m^2 for a torque (N m) in a field (T), and the torque they give."""
    gives = magnetic_torque(coils, np.eye(len(coils)), field).T
    dipoles = np.linalg.pinv(gives, rcond=FAINT) @ wanted
    dipoles = scaled(dipoles, np.array([coil.max_dipole for coil in coils]))
    return Delivered(dipoles, gives @ dipoles)
