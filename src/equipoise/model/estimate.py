"""An estimate: named values with their covariance, and the directions that are unobservable."""

import math
from collections.abc import Container, Mapping
from dataclasses import dataclass, field

import numpy as np

from equipoise.model.arrays import Floats, Matrix3, Series, Series1, Square, Vector3
from equipoise.model.event import Event
from equipoise.model.outcome import Outcome
from equipoise.model.presentation import Plotted
from equipoise.model.reasons.reason import Reason
from equipoise.model.recording import Samples

COM = ("com_x", "com_y", "com_z")
END = ("com_end_x", "com_end_y", "com_end_z")  # with the masses as they stand at the end
INERTIA = tuple(f"inertia_P_{ij}" for ij in ("xx", "yy", "zz", "xy", "xz", "yz"))
BODY = (*INERTIA, *COM)
RATE = ("rate_x", "rate_y", "rate_z")  # at the beginning of a record
ATTITUDE = ("attitude_x", "attitude_y", "attitude_z")
NORMAL_95 = 1.959963984540054  # two-sided 95 % point of the normal distribution


def standing_com(names: Container[str]) -> tuple[str, ...]:
    """Return the names of the centre of mass as the masses stand, of an estimate with ``names``."""
    return END if END[0] in names else COM


@dataclass(frozen=True, slots=True)
class Parameter:
    """One number with its uncertainty. What the data cannot see has an infinite interval."""

    name: str
    unit: str
    value: float
    sd: float
    observable: bool = True

    @property
    def low95(self) -> float:
        """Lower end of the 95 % interval."""
        return self.value - NORMAL_95 * self.sd

    @property
    def high95(self) -> float:
        """Upper end of the 95 % interval."""
        return self.value + NORMAL_95 * self.sd


def normalised_difference(parameter: Parameter, other: Parameter) -> float:
    """Return (a - b) / sqrt(sd_a^2 + sd_b^2) of independent estimates; NaN where neither has an sd.

    Beyond 2 to 3 the quantity has changed, or one of the two sd is too small. An estimate that
    shares data with the other is nearer to it than this says.
    """
    sd = math.hypot(parameter.sd, other.sd)
    return (parameter.value - other.value) / sd if sd > 0 else math.nan


@dataclass(frozen=True, slots=True, eq=False)
class Residual:
    """What the model leaves of the data."""

    attitude_rms: float | None  # rad per axis
    rate_rms: float | None  # rad/s per axis
    chi_square: float  # in units of the stated noise
    degrees_of_freedom: int
    lag_one: float  # correlation of neighbouring residuals; white: near 0
    whiteness: float = 1.0  # probability of correlations as large as these, were it white noise
    steady_rms: float | None = None  # rad or rad/s per axis, without process noise
    spectral_peak: float = 1.0  # of the residuals' density over its mean; white: 1
    held_out_rms: float | None = None  # rad per axis (rad/s without attitude), predicted
    held_out_span: tuple[float, float] | None = None  # s
    error_index: float | None = None  # of a linear method: share of the known side that is left
    error_indices: Mapping[str, float] = field(default_factory=dict[str, float])  # -, by name
    attitude: Samples | None = None  # rad, body axes: of the camera's rows that were fitted
    rate: Samples | None = None  # rad/s, gyro axes: of the gyro's, bias and alignment counted

    @property
    def reduced_chi_square(self) -> float:
        """Chi-square per degree of freedom; near 1 when the model explains the data."""
        return self.chi_square / max(self.degrees_of_freedom, 1)


@dataclass(frozen=True, slots=True, eq=False)
class Course:
    """The estimates of some parameters along the record."""

    names: tuple[str, ...]
    t: Series1  # s
    values: Series  # (n, k), SI
    sd: Series  # (n, k)


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Estimate(Plotted):
    """What a method concluded. ``covariance`` is in the order of ``parameters``."""

    method: str
    outcome: Outcome
    parameters: tuple[Parameter, ...]
    covariance: Square
    residual: Residual | None = None
    unobservable: tuple[Reason, ...] = ()  # directions that the data do not show
    ratios: tuple[Parameter, ...] = ()  # what is known when the scale is open
    possible: bool = True  # some body can have these mass properties
    provenance: Mapping[str, str] = field(default_factory=dict[str, str])
    events: tuple[Event, ...] = ()
    unexplained: tuple[Reason, ...] = ()  # what the model leaves open, and what it might do
    course: Course | None = None  # of a method that goes along the record
    rate_course: Course | None = None  # the angular velocity, of a method that tracks it

    def index(self, name: str) -> int:
        """Return where a parameter stands; KeyError if it is not among them."""
        return {p.name: i for i, p in enumerate(self.parameters)}[name]

    def has(self, name: str) -> bool:
        """Say whether a parameter is among them."""
        return any(p.name == name for p in self.parameters)

    @property
    def standing(self) -> tuple[str, ...]:
        """Names of the centre of mass with the masses as they stand."""
        return standing_com({p.name for p in self.parameters})

    def values(self, names: tuple[str, ...]) -> Floats:
        """Return several values."""
        return np.array([self.parameters[self.index(n)].value for n in names])

    def covariance_of(self, names: tuple[str, ...]) -> Square:
        """Return the covariance of several parameters."""
        where = [self.index(n) for n in names]
        return self.covariance[np.ix_(where, where)]

    def sees(self, names: tuple[str, ...]) -> bool:
        """Say whether the data show all of these."""
        known = {p.name for p in self.parameters if p.observable}
        return known.issuperset(names)

    @property
    def com(self) -> Vector3:
        """Centre of mass with the masses at home, m."""
        return self.values(COM)

    @property
    def inertia_P(self) -> Matrix3:
        """Inertia about P with the masses at home, kg m^2."""
        xx, yy, zz, xy, xz, yz = self.values(INERTIA)
        return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
