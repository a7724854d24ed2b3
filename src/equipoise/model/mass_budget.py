"""Parts of a platform, swings of it about known axes, and the mass properties that follow.

Positions are from P in body axes; an sd is of one component.
"""

from dataclasses import dataclass
from typing import Literal

from equipoise.model.arrays import Floats, Matrix3, Vector3
from equipoise.model.estimate import Estimate, Parameter
from equipoise.model.mass_properties import MassProperties
from equipoise.model.presentation import Plotted

Shape = Literal["point", "box", "plate", "cylinder", "tube", "sphere", "tensor", "unknown"]
DIMENSIONS: dict[Shape, tuple[str, ...]] = {
    "point": (),
    "box": ("edge along x", "edge along y", "edge along z"),
    "plate": ("edge along x", "edge along y"),
    "cylinder": ("diameter", "height along z"),
    "tube": ("outer diameter", "inner diameter", "height along z"),
    "sphere": ("diameter",),
    "tensor": (),
    "unknown": (),
}
MASS = "mass"
CENTRAL = tuple(f"inertia_C_{ij}" for ij in ("xx", "yy", "zz", "xy", "xz", "yz"))


@dataclass(frozen=True, slots=True, eq=False)
class Part:
    """A rigid part; ``turn`` leads from its own axes to the body's."""

    name: str
    shape: Shape
    mass: float  # kg
    mass_sd: float  # kg
    centre: Vector3  # m, its centre of mass
    centre_sd: float  # m
    turn: Matrix3
    turn_sd: float  # rad
    size: Floats  # m, as ``DIMENSIONS`` has them
    size_sd: float  # m
    inertia: Matrix3  # kg m^2, about its own centre in its own axes, of a tensor; else nought
    inertia_sd: float  # -, relative, of its inertia about its own centre


@dataclass(frozen=True, slots=True, eq=False)
class Oscillation:
    """The platform swings about an axis that its support holds: by gravity, or on a torsion wire.

    ``stiffness`` None: gravity turns it back, and the axis is level.
    """

    name: str
    axis: Vector3  # unit vector
    axis_sd: float  # rad
    through: Vector3  # m, a point of the axis
    period: float  # s
    period_sd: float  # s
    amplitude: float  # rad, of which the period is
    amplitude_sd: float  # rad
    decay: float  # 1/s, of the amplitude
    stiffness: float | None  # N m, for a radian
    stiffness_sd: float  # -, relative
    fixture: float  # kg m^2, about the axis, of what swings with the platform
    fixture_sd: float  # kg m^2
    weight: float  # kg, put on for this swing
    weight_sd: float  # kg
    place: Vector3  # m, of the weight
    place_sd: float  # m
    gravity: float  # m/s^2
    recording: str = ""  # file of which period, amplitude and decay are to be; "": as stated


@dataclass(frozen=True, slots=True, eq=False)
class PartsList:
    """What a platform is made of, and how it swung."""

    name: str
    parts: tuple[Part, ...]
    oscillations: tuple[Oscillation, ...] = ()
    source: str = ""


@dataclass(frozen=True, slots=True)
class Share:
    """What one part contributes: to the mass, and to the variance of what the parts sum to."""

    name: str
    mass: float  # kg
    of_mass: float  # -, of the variance
    of_com: float  # -, of the sum of the three variances
    of_inertia: float  # -, of the sum of the six, about P


@dataclass(frozen=True, slots=True)
class OscillationCheck:
    """A moment of inertia that a swing measured, beside what all swings and parts say of it."""

    name: str
    measured: float  # kg m^2, about the swing's axis, with what is put on
    measured_sd: float  # kg m^2
    expected: float  # kg m^2
    off: float  # sd of the measurement


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class MassBudget(Plotted):
    """Mass properties from parts and swings; ``estimate`` has mass, com and inertia about P."""

    stated: PartsList
    estimate: Estimate
    central: tuple[Parameter, ...]  # inertia about C, named as ``CENTRAL``
    shares: tuple[Share, ...]  # of the parts alone; the greatest of the inertia's variance first
    checks: tuple[OscillationCheck, ...]

    @property
    def is_whole(self) -> bool:
        """Whether all of it is known, and can be relied on."""
        return not self.estimate.outcome.warns and all(
            p.observable for p in self.estimate.parameters
        )

    @property
    def body(self) -> MassProperties:
        """Mass, centre of mass and inertia about P."""
        mass = self.estimate.parameters[self.estimate.index(MASS)].value
        return MassProperties(mass, self.estimate.com, self.estimate.inertia_P)
