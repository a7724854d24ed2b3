"""What a recording can show, to any method and to a filter."""

from dataclasses import dataclass

from equipoise.model.arrays import Bools, Floats, Matrix3
from equipoise.model.estimate import Parameter
from equipoise.model.reasons.reason import Reason


@dataclass(frozen=True, slots=True, eq=False)
class Observability:
    """What a recording shows. Arrays are in the order of ``names``."""

    names: tuple[str, ...]
    units: tuple[str, ...]  # SI
    sd: Floats  # Cramer-Rao bound, SI; infinite: unobservable
    before: Floats  # prior sd of the testbed, SI; infinite: none
    hidden: Bools
    held: Bools  # not sought
    unobservable: tuple[Reason, ...]  # directions
    cautions: tuple[Reason, ...]  # why the motion may be another than the recording's
    ratios: tuple[Parameter, ...]  # when the scale is open
    condition: float
    gravity_sweep: float
    tilt: tuple[float, float]  # rad, least and greatest
    rank: int
    size: int
    inertia_P: Matrix3  # kg m^2, of the motion


@dataclass(frozen=True, slots=True)
class FilterView:
    """What a filter can observe."""

    name: str
    size: int  # of its state
    measures: str  # "gyro" or "camera"
    possible: int  # rank with sensors of no noise
    rank: int | None  # with the testbed's; None: the recording has no such rows
    unobservable: tuple[Reason, ...]  # at ``rank`` if there is one
