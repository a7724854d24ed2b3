"""The platform and its sliding masses: their tables, and their records in SI."""

from collections.abc import Mapping
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field

from equipoise.io.testbed.inertia_check import check_inertia, measured
from equipoise.io.toml.key_types import (
    Direction,
    Holds,
    Inertia,
    Name,
    NotNegative,
    Pair,
    Positive,
    SdTriple,
    Triple,
    unit_vector,
)
from equipoise.io.toml.table_records import RecordTable, record_of
from equipoise.io.toml.units import key_factor
from equipoise.model import testbed as model
from equipoise.model.arrays import Vector3
from equipoise.model.errors import InputError
from equipoise.model.mass_properties import MassProperties, from_centre
from equipoise.model.reasons.reason import Reason
from equipoise.model.units import MM, MS

HANGS = 1e-3  # m: a centre of mass guessed this far off P hangs there on purpose (chosen)
STANDS_OUT = 10.0  # times the other components, for its axis to be the vertical one (chosen)


class Platform(RecordTable):
    """Everything that floats, with the sliding masses at home."""

    layout: model.Layout = Field(
        "table-top",
        description="table-top: a deck on a half ball; umbrella: a canopy on a post; dumbbell: two "
        "decks at the ends of a level shaft; spherical-rotor: a sphere in a cup. A picture shows "
        "it; how far it may turn is stated by tilt_limit_deg",
    )
    mass_kg: Annotated[Positive, Holds("body.mass")]
    inertia_kg_m2: Annotated[Inertia, Holds("body.inertia_P")] = Field(
        description="three moments, or a tensor of three rows; products are minus the integrals"
    )
    inertia_sd_percent: Positive = Field(
        10.0,
        description=(
            "standard deviation; default: usual for CAD; if given, physically "
            "inconsistent moments within 3 sd are replaced by the nearest consistent ones"
        ),
    )
    about: Literal["C", "P"] = Field("C", description="C: centre of mass, P: centre of rotation")
    com_um: Annotated[Triple, Holds("body.com")] = Field(
        [0.0, 0.0, 0.0], description="first guess, from P"
    )
    com_sd_um: SdTriple = Field(
        [500.0, 500.0, 500.0],
        description="standard deviation; default: a platform balanced by hand",
    )
    up: Direction | None = Field(None, description="body axis that points up when level")
    tilt_limit_deg: Annotated[float, Field(gt=0, le=180)] = Field(
        30.0,
        description=(
            "tilt at which the platform meets its stop; default: usual for a table on a hemisphere"
        ),
    )
    gravity_m_s2: Positive = Field(9.80665, description="standard gravity")
    mass_sd_percent: NotNegative = Field(
        0.5, description="standard deviation of mass_kg; default: weighed in parts; 0: exact"
    )
    gravity_sd_percent: NotNegative = Field(
        0.1,
        description="standard deviation; default: standard gravity on most of the Earth; 0: exact",
    )
    momentum_sd_percent: NotNegative = Field(
        1.0,
        description="standard deviation of recorded momentum; default: data sheet",
    )
    torque_sd_percent: NotNegative = Field(
        1.0,
        description="standard deviation of recorded torque; default: data sheet",
    )

    def body(self, where: str) -> tuple[MassProperties, tuple[Reason, ...]]:
        """Return the body, whose inertia must be possible, and what of it was not."""
        place = f"{where}.inertia_kg_m2"
        com = np.array(self.com_um) * key_factor("com_um")
        inertia, stated = np.array(self.inertia_kg_m2), self._stated_share()
        if self.about == "C":
            inertia, mended = measured(inertia, stated, place)
            return from_centre(self.mass_kg, com, inertia), mended
        if stated is None:
            check_inertia(inertia, place)
        body = MassProperties(self.mass_kg, com, inertia)
        inertia, mended = measured(body.inertia_C, stated, f"{place}, moved to the centre of mass")
        return from_centre(self.mass_kg, com, inertia) if mended else body, mended

    def _stated_share(self) -> float | None:
        """Return the relative sd of the inertia; None where the file does not state it."""
        is_stated = "inertia_sd_percent" in self.model_fields_set
        return self.inertia_sd_percent * key_factor("inertia_sd_percent") if is_stated else None

    @classmethod
    def more_keys(cls, record: Any) -> Mapping[str, Any]:
        """Return the point of the inertia."""
        return {"about": "P"}


class SlidingMass(RecordTable):
    """A mass on a rail; its displacement counts from home along ``axis``."""

    name: Name
    mass_g: Positive
    home_mm: Triple
    axis: Direction
    travel_mm: Pair = Field(description="least and greatest displacement")
    resolution_mm: NotNegative = Field(0.0, description="smallest step of a command; 0: continuous")
    accuracy_mm: NotNegative = Field(0.1, description="standard deviation; default: lead screw")
    backlash_mm: NotNegative = 0.0
    speed_mm_s: Positive = Field(10.0, description="default: a small stepper on a lead screw")
    lag_sd_ms: NotNegative = Field(
        model.LAG_SD / MS,
        description=(
            "standard deviation of the delay behind a recorded command; default: soft "
            "servo; masses with one value share one delay; 0: no delay, or the log is a "
            "measurement"
        ),
    )
    sag_sd_mm: NotNegative = Field(
        model.SAG_SD / MM,
        description=(
            "standard deviation of the sag below a command on an upright rail; default: "
            "soft servo; 0: stiff drive or lead screw"
        ),
    )
    gain: Positive = Field(
        1.0,
        description=(
            "actual first moment divided by mass_g times the commanded displacement; "
            "equipoise calibrate estimates it"
        ),
    )
    mass_sd_percent: NotNegative = Field(
        0.5, description="standard deviation of mass_g and gain; default: kitchen scale; 0: exact"
    )

    def record(self, where: str) -> model.SlidingMass:
        """Return the mass, whose travel must go up and hold its home."""
        low, high = self.travel_mm
        if not low < high or not low <= 0 <= high:
            wanted = "the smallest and the largest displacement, home (0) included"
            raise InputError(f"{where}.travel_mm", f"[{low:g}, {high:g}]", wanted)
        unit = key_factor("travel_mm")
        return record_of(model.SlidingMass, self, where, travel=(low * unit, high * unit))


def up_of(platform: Platform, com: Vector3, where: str) -> Vector3:
    """Return the axis given, else the axis along which the centre of mass hangs, else z."""
    if platform.up is not None:
        return unit_vector(platform.up, f"{where}.up")
    size = np.abs(com)
    main = int(np.argmax(size))
    hangs = np.linalg.norm(com) > HANGS and np.all(np.delete(size, main) * STANDS_OUT < size[main])
    return np.eye(3)[main if hangs else 2]


def check_total_mass(platform: Platform, masses: list[SlidingMass], source: str) -> None:
    """Raise InputError unless the platform weighs more than its sliding masses."""
    total = sum(mass.mass_g for mass in masses) * key_factor("mass_g")
    if total >= platform.mass_kg:
        found = f"{platform.mass_kg:g} kg, but the sliding masses weigh {total:g} kg"
        raise InputError(
            f"{source}: platform.mass_kg",
            found,
            "the mass of everything that floats on the bearing",
        )
