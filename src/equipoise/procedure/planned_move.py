"""A change of displacements as a Move: how far, how long, and where it should lead."""

import numpy as np

from equipoise.actuators.sliding_masses import com_shift, com_shift_covariance, mass_maps
from equipoise.model.arrays import Floats, Matrix3, Vector3
from equipoise.model.move import Move
from equipoise.model.testbed import Testbed


def planned_move(
    testbed: Testbed, now: Floats, targets: Floats, belief: tuple[Vector3, Matrix3], reason: str
) -> Move:
    """Return the move from displacements ``now`` to ``targets`` (m).

    ``belief`` is the centre of mass as the masses stand and its covariance (m, m^2); what the
    accuracy of the stops adds to it is part of the prediction.
    """
    masses, total, change = testbed.masses, testbed.body.mass, targets - now
    maps = mass_maps(masses)
    speed = np.array([mass.speed for mass in masses])
    accuracy = np.array([mass.accuracy for mass in masses])
    stop = com_shift_covariance(maps, total, accuracy, (change != 0).astype(float))
    return Move(
        targets={mass.name: float(d) for mass, d in zip(masses, targets, strict=True)},
        travel=float(np.abs(change).sum()),
        duration=float((np.abs(change) / speed).max()),
        predicted_com=belief[0] + com_shift(maps, total, change),
        predicted_covariance=belief[1] + stop,
        reason=reason,
    )
