"""A move: where the masses are to go, and what that should do to the centre of mass."""

from collections.abc import Mapping
from dataclasses import dataclass

from equipoise.model.arrays import Matrix3, Vector3
from equipoise.model.reasons.step_reasons import MoveReason


@dataclass(frozen=True, slots=True, eq=False)
class Move:
    """A prediction that the next measurement tests."""

    targets: Mapping[str, float]  # m, displacement from home by mass
    travel: float  # m, the sum over the masses
    duration: float  # s, until the last one has stopped
    predicted_com: Vector3  # m, afterwards
    predicted_covariance: Matrix3  # m^2, of the estimate and of where the masses stop
    reason: MoveReason
