"""Parts files: TOML to parts and to swings about known axes. A unit is part of its key."""

import math
from pathlib import Path
from typing import Annotated, Any

import numpy as np
from pydantic import Field

from equipoise.io.toml.key_types import (
    Direction,
    Inertia,
    NotNegative,
    Positive,
    Table,
    Triple,
    Visible,
    unit_vector,
)
from equipoise.io.toml.read_toml import parse_toml, read_toml
from equipoise.maths.attitude import exponential, to_matrix
from equipoise.model import mass_budget as model
from equipoise.model.errors import InputError
from equipoise.model.mass_budget import DIMENSIONS, PartsList, Shape
from equipoise.model.units import DEG, GRAM, MM, PERCENT

WANTED = "a parts file (TOML), such as the one in docs/parts.md"


class Part(Table):
    """A rigid part, the sliding masses at home among them."""

    name: Visible
    shape: Shape = Field(description="tensor: inertia_kg_m2 is stated; unknown: swings show it")
    mass_g: Positive
    mass_sd_percent: NotNegative = Field(
        0.5, description="standard deviation; default: kitchen scale"
    )
    size_mm: list[Positive] = Field(
        [],
        description="; ".join(
            f"{shape}: {', '.join(of)}" for shape, of in DIMENSIONS.items() if of
        ),
    )
    size_sd_mm: NotNegative = Field(0.5, description="standard deviation of each; default: ruler")
    centre_mm: Triple = Field(description="centre of mass of the part, from P, body axes")
    centre_sd_mm: NotNegative = Field(
        1.0,
        description="standard deviation of each component; default: ruler, uneven filling",
    )
    turn_deg: Triple = Field(
        [0.0, 0.0, 0.0], description="rotation vector from body axes to the axes of the part"
    )
    turn_sd_deg: NotNegative = Field(
        1.0, description="standard deviation about each axis; default: by eye"
    )
    inertia_kg_m2: Inertia | None = Field(
        None, description="of a tensor: about the part's centre of mass, in the part's axes"
    )
    inertia_sd_percent: NotNegative = Field(
        10.0,
        description="standard deviation of the part's inertia; default: uneven filling",
    )

    def record(self, where: str) -> model.Part:
        """Return the part in SI; InputError for a shape that lacks its size."""
        _check_shape(self, where)
        inertia = np.zeros((3, 3)) if self.inertia_kg_m2 is None else np.array(self.inertia_kg_m2)
        mass = self.mass_g * GRAM
        return model.Part(
            self.name, self.shape, mass, self.mass_sd_percent * PERCENT * mass,
            np.array(self.centre_mm) * MM, self.centre_sd_mm * MM,
            to_matrix(exponential(np.array(self.turn_deg) * DEG)), self.turn_sd_deg * DEG,
            np.array(self.size_mm, float) * MM, self.size_sd_mm * MM,
            inertia, self.inertia_sd_percent * PERCENT,
        )  # fmt: skip


class Oscillation(Table):
    """A swing about an axis that the support holds, by gravity or on a torsion wire."""

    name: Visible
    axis: Direction = Field(
        description="body axes; horizontal, unless a wire gives the restoring torque"
    )
    axis_sd_deg: NotNegative = Field(
        0.5, description="standard deviation; default: set with a square"
    )
    through_mm: Triple = Field([0.0, 0.0, 0.0], description="a point on the axis, from P")
    period_s: Positive | None = Field(None, description="omit it where a recording determines it")
    recording: Visible | None = Field(
        None, description="recording of this swing, beside the parts file, for its period"
    )
    period_sd_s: Positive = Field(
        0.02,
        description="standard deviation; default: twenty swings timed by hand, to 0.4 s in all",
    )
    amplitude_deg: Annotated[float, Field(ge=0, lt=90)] = Field(
        5.0,
        description=(
            "amplitude to each side, halfway through the timed swings; default: a gentle push"
        ),
    )
    amplitude_sd_deg: NotNegative = Field(1.0, description="standard deviation; default: by eye")
    decay_s: Positive | None = Field(
        None, description="time in which the amplitude falls by a factor e; if omitted: no damping"
    )
    stiffness_N_m: Positive | None = Field(
        None,
        description=(
            "torsional stiffness of the wire, per radian, axis vertical; if omitted: "
            "gravity restores"
        ),
    )
    stiffness_sd_percent: NotNegative = Field(
        1.0, description="standard deviation; default: calibrated with a known body"
    )
    fixture_kg_m2: NotNegative = Field(
        0.0, description="of everything else that swings, about the axis"
    )
    fixture_sd_kg_m2: NotNegative = 0.0
    weight_g: NotNegative = Field(
        0.0, description="added for this swing; its size is small compared with its arm"
    )
    weight_sd_g: NotNegative = Field(
        0.1, description="standard deviation; default: a kitchen scale"
    )
    weight_mm: Triple = Field([0.0, 0.0, 0.0], description="position of its centre, from P")
    weight_sd_mm: NotNegative = Field(
        0.5, description="standard deviation of each component; default: a ruler"
    )

    def record(self, gravity: float, where: str) -> model.Oscillation:
        """Return the swing in SI; InputError unless its period is given once."""
        if (self.period_s is None) == (self.recording is None):
            found = "neither" if self.period_s is None else "both"
            raise InputError(where, found, "one of 'period_s' and 'recording'")
        return model.Oscillation(
            self.name, unit_vector(self.axis, f"{where}.axis"), self.axis_sd_deg * DEG,
            np.array(self.through_mm) * MM, self.period_s or math.nan, self.period_sd_s,
            self.amplitude_deg * DEG, self.amplitude_sd_deg * DEG,
            0.0 if self.decay_s is None else 1 / self.decay_s,
            self.stiffness_N_m, self.stiffness_sd_percent * PERCENT,
            self.fixture_kg_m2, self.fixture_sd_kg_m2,
            self.weight_g * GRAM, self.weight_sd_g * GRAM if self.weight_g else 0.0,
            np.array(self.weight_mm) * MM, self.weight_sd_mm * MM, gravity,
            self.recording or "",
        )  # fmt: skip


class PartsFile(Table):
    """Everything that floats, and how it swung."""

    name: Visible
    gravity_m_s2: Positive = Field(9.80665, description="standard gravity")
    part: list[Part] = Field(min_length=1)
    oscillation: list[Oscillation] = Field([])


def read_parts(path: str | Path) -> PartsList:
    """Return the parts and swings of a file; InputError names file, key, found and wanted."""
    return parts_of(read_toml(path, PartsFile, WANTED), str(path))


def parse_parts(text: str, source: str) -> PartsList:
    """Return the parts and swings of a text; ``source`` names it in errors."""
    return parts_of(parse_toml(text, source, PartsFile), source)


def parts_of(file: PartsFile, source: str) -> PartsList:
    """Return a file's content in SI."""
    for kind, rows in (("part", file.part), ("oscillation", file.oscillation)):
        names = [row.name for row in rows]
        for k, name in enumerate(names):
            if name in names[:k]:
                raise InputError(f"{source}: {kind}[{k + 1}].name", f"a second '{name}'", "another")
    return PartsList(
        file.name,
        tuple(part.record(f"{source}: part[{k}]") for k, part in enumerate(file.part, 1)),
        tuple(
            swing.record(file.gravity_m_s2, f"{source}: oscillation[{k}]")
            for k, swing in enumerate(file.oscillation, 1)
        ),
        source,
    )


def parts_schema() -> dict[str, Any]:
    """Return the JSON Schema of a parts file, for editors that complete and check keys."""
    schema = PartsFile.model_json_schema()
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **schema}


def _check_shape(part: Part, where: str) -> None:
    """Raise InputError for a shape with another number of sizes, or a tensor without one."""
    wanted = DIMENSIONS[part.shape]
    if len(part.size_mm) != len(wanted):
        names = f"of a {part.shape}: {', '.join(wanted)}" if wanted else f"none for '{part.shape}'"
        raise InputError(f"{where}.size_mm", f"{len(part.size_mm)} numbers", f"sizes {names}")
    if part.shape == "tube" and part.size_mm[1] >= part.size_mm[0]:
        found = f"an inner diameter of {part.size_mm[1]:g} in one of {part.size_mm[0]:g}"
        raise InputError(f"{where}.size_mm", found, "outer before inner diameter")
    if (part.shape == "tensor") != (part.inertia_kg_m2 is not None):
        found = "none" if part.inertia_kg_m2 is None else f"one of a '{part.shape}'"
        raise InputError(f"{where}.inertia_kg_m2", found, "an inertia, of shape 'tensor' alone")
