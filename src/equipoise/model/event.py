"""An event in a recording: an impulse on the platform, or a step of its centre of mass."""

from dataclasses import dataclass
from typing import Literal

from equipoise.model.arrays import Matrix3, Vector3

Kind = Literal["impulse", "com_step"]
UNITS: dict[Kind, str] = {"impulse": "N m s", "com_step": "m"}


@dataclass(frozen=True, slots=True, eq=False)
class Event:
    """One event; ``size`` is a jump of angular momentum about P, or of com."""

    kind: Kind
    t: float  # s
    t_sd: float  # s
    size: Vector3  # in UNITS; laboratory axes for an impulse, body axes otherwise
    covariance: Matrix3
    surprise: float  # chi-square of three degrees of freedom that it explains
    # The other kind explains it about as well; of a step of com only the covariance shows that.
    unclear: bool = False
    azimuth: float | None = None  # rad about the body's up axis, of the place pushed from below
