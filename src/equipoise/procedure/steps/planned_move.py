"""A change of displacements as a Move: how far, how long, and where it should lead.

    r after = r + sum g_i (D_i + e_i' - e_i),     g_i = (m_i / M) u_i

e_i' is by how much mass i stops elsewhere, and e_i by how much it did so before: that error is part
of where the centre of mass is found to be, and leaves with the mass. A mass at home has none.
"""

import numpy as np

from equipoise.actuators.sliding_masses import com_shift_covariance, mass_maps, shift_by
from equipoise.model.arrays import Bools, Floats, Matrix3, Vector3
from equipoise.model.move import Move
from equipoise.model.reasons.step_reasons import MoveReason
from equipoise.model.testbed import Testbed


def planned_move(
    testbed: Testbed,
    now: Floats,
    targets: Floats,
    posterior: tuple[Vector3, Matrix3],
    reason: MoveReason,
) -> Move:
    """Return the move from displacements ``now`` to ``targets`` (m).

    ``posterior`` is the centre of mass as the masses stand, less the errors e_i of those that move,
    and its covariance (m, m^2); what the accuracy of the new stops adds is part of the prediction.
    """
    change = targets - now
    speed = np.array([mass.speed for mass in testbed.masses])
    return Move(
        targets=by_name(testbed, targets),
        travel=float(np.abs(change).sum()),
        duration=float((np.abs(change) / speed).max()),
        predicted_com=posterior[0] + shift_by(testbed, change),
        predicted_covariance=posterior[1] + stops_covariance(testbed, change != 0),
        reason=reason,
    )


def by_name(testbed: Testbed, displacement: Floats) -> dict[str, float]:
    """Return displacements (m) by mass."""
    return dict(zip(testbed.mass_names, map(float, displacement), strict=True))


def stops_covariance(testbed: Testbed, which: Bools) -> Matrix3:
    """Return the covariance (m^2) of what one stop of each of these masses does."""
    accuracy = np.array([mass.accuracy for mass in testbed.masses])
    maps = mass_maps(testbed.masses)
    return com_shift_covariance(maps, testbed.body.mass, accuracy, which.astype(float))
