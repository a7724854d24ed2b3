"""One contribution to what is left of torque, and where its size comes from."""

from dataclasses import dataclass

from equipoise.model.arrays import Matrix3

TESTBED, REQUESTED, PARTLY, ASSUMED = "testbed", "stated", "partly assumed", "assumed"


@dataclass(frozen=True, slots=True, eq=False)
class Line:
    """A contribution; independent of the others."""

    name: str
    cause: str  # begins a sentence about it
    torque: float  # N m, root mean square within the tilt
    moment: Matrix3 | None  # m^2, mean of r r^T, of what is an offset of the centre of mass
    basis: str  # where its size comes from
