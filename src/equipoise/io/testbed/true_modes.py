"""What is not rigid of the simulated platform: ``[[truth.mode]]``."""

from collections.abc import Mapping
from typing import Annotated, Any

import numpy as np
from pydantic import Field

from equipoise.io.toml.key_types import Direction, NotNegative, Positive, unit_vector
from equipoise.io.toml.table_records import RecordTable
from equipoise.io.toml.units import key_factor
from equipoise.model.arrays import Vector3
from equipoise.model.modes import Mode


class TrueMode(RecordTable):
    """A part of the platform that oscillates on its own."""

    frequency_hz: Positive = Field(description="of the part while the platform is held")
    damping_ratio: Annotated[float, Field(ge=0, lt=1)] = 0.005
    axis: Direction = Field(description="about which the part turns, body axes")
    inertia_kg_m2: Positive = Field(description="moment of the part that oscillates, about P")
    angle_deg: float = Field(0.0, description="of the part at the beginning")
    rate_deg_s: float = Field(0.0, description="of the part against the platform at the beginning")
    slosh_axis: Direction | None = Field(
        None, description="along which the part's centre of mass moves, body axes"
    )
    slosh_mass_kg: NotNegative = Field(0.0, description="that moves along slosh_axis")

    def record(self, where: str) -> Mode:
        """Return the mode."""
        size = float(np.sqrt(self.inertia_kg_m2))
        turn = size * key_factor("angle_deg")
        return Mode(
            self.frequency_hz,
            self.damping_ratio,
            size * unit_vector(self.axis, f"{where}.axis"),
            _moment(self.slosh_axis, self.slosh_mass_kg, f"{where}.slosh_axis"),
            turn * self.angle_deg,
            turn * self.rate_deg_s,
        )

    @classmethod
    def more_keys(cls, record: Any) -> Mapping[str, Any]:
        """Return the coupling as direction and moment, and what oscillates as an angle."""
        size, sloshing = record.inertia**0.5, float(np.linalg.norm(record.moment))
        return {
            "damping_ratio": record.damping,
            "axis": record.coupling / size,
            "inertia_kg_m2": record.inertia,
            "angle_deg": record.deflection / size,
            "rate_deg_s": record.velocity / size,
            "slosh_axis": record.moment / sloshing if sloshing else None,
            "slosh_mass_kg": sloshing**2,
        }


def _moment(axis: list[float] | None, mass: float, where: str) -> Vector3:
    """Return s (sqrt(kg)) of a mass (kg) that moves along an axis."""
    return np.zeros(3) if axis is None else mass**0.5 * unit_vector(axis, where)
