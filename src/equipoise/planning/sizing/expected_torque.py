"""Contributions to the residual torque within a tilt of level, root mean square.

An uncertain centre of mass leaves

    tau^2 = (m g)^2 mean over n of E|r x n|^2 = (m g)^2 tr( S mean(E - n n^T) ),     S = E[r r^T]

n is gravity's direction, each direction within the tilt counting alike (``dynamics.sag_trim``).
Near level a sideways offset counts in full and a height by the sine of the tilt.
"""

from dataclasses import dataclass

import numpy as np

from equipoise.dynamics.sag_trim import residual_torque
from equipoise.model.arrays import Matrix3
from equipoise.model.testbed import Testbed

STIFF = np.zeros((3, 3))
TESTBED, REQUESTED, PARTLY, ASSUMED = "testbed", "stated", "partly assumed", "assumed"


@dataclass(frozen=True, slots=True, eq=False)
class Line:
    """A contribution; independent of the others."""

    name: str
    cause: str  # begins a sentence about it
    torque: float  # N m, root mean square within the tilt
    moment: Matrix3 | None  # m^2, mean of r r^T, of what is an offset of the centre of mass
    basis: str  # where its size comes from


def expected_torque(testbed: Testbed, moment: Matrix3, tilt: float) -> float:
    """Return the torque (N m) for the mean of r r^T (m^2) and a tilt (rad)."""
    values, vectors = np.linalg.eigh(moment)
    arms = [residual_torque(v, STIFF, testbed.up, tilt) for v in vectors.T]
    squares = np.maximum(values, 0.0) @ np.square(arms)
    return testbed.weight * float(np.sqrt(squares))
