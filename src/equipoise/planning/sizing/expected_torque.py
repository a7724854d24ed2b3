"""What an uncertain centre of mass leaves of torque within a tilt of level, root mean square.

    tau^2 = (m g)^2 mean over n of E|r x n|^2 = (m g)^2 tr( S mean(E - n n^T) ),     S = E[r r^T]

n is gravity's direction, each direction within the tilt counting alike (``dynamics.sag_trim``).
Near level an offset aside counts in full and a height by the sine of the tilt.
"""

import numpy as np

from equipoise.dynamics.sag_trim import residual_torque
from equipoise.model.arrays import Matrix3
from equipoise.model.testbed import Testbed

STIFF = np.zeros((3, 3))


def expected_torque(testbed: Testbed, moment: Matrix3, tilt: float) -> float:
    """Return the torque (N m) for the mean of r r^T (m^2) and a tilt (rad)."""
    values, vectors = np.linalg.eigh(moment)
    arms = [residual_torque(v, STIFF, testbed.up, tilt) for v in vectors.T]
    squares = np.maximum(values, 0.0) @ np.square(arms)
    return testbed.body.mass * testbed.gravity * float(np.sqrt(squares))
