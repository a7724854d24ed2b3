"""The tables and keys of a plan file: what may stand where, and in which unit.

A unit is part of its key. Nothing is converted here; ``plan_file`` does that once.
"""

from typing import Annotated

from pydantic import Field

from equipoise.io.toml.key_types import Name, NotNegative, Positive, Table, Triple
from equipoise.model.manoeuvre import HAND_RATE, HAND_TILT

DEG = 0.017453292519943295
Six = Annotated[list[float], Field(min_length=6, max_length=6)]
Targets = dict[Name, float]


class Start(Table):
    """How the platform is let go."""

    tilt_deg: Annotated[float, Field(ge=0, le=180)]
    low_side: Triple = Field([1.0, 0.0, 0.0], description="body direction that is lowest")
    rate_deg_s: Triple = Field([0.0, 0.0, 0.0], description="body axes")
    tilt_sd_deg: NotNegative = Field(
        round(HAND_TILT / DEG, 9), description="one sd, chosen: how well a hand meets a tilt"
    )
    rate_sd_deg_s: NotNegative = Field(
        round(HAND_RATE / DEG, 9), description="one sd of each component, chosen: of a push"
    )


class Standing(Table):
    """Where masses stand before, those that are not at home."""

    at_mm: Targets


class Move(Table):
    """Masses that are sent off at a time."""

    time_s: NotNegative
    to_mm: Targets = Field(description="displacements from home by mass", min_length=1)


class Wave(Table):
    """A square wave: a torque on a wheel's rotor, or a rate of a gyro's gimbal."""

    device: Name
    torque_N_m: float | None = None
    gimbal_rate_deg_s: float | None = None
    period_s: Positive
    phase: Annotated[float, Field(ge=0, lt=1)] = Field(
        0.25, description="of a period, at the start"
    )


class Promised(Table):
    """One sd of what a fit of the record should find."""

    com_sd_um: Triple
    inertia_sd_kg_m2: Six = Field(description="xx yy zz xy xz yz, about P")


class PlanFile(Table):
    """A plan."""

    testbed: str = ""
    duration_s: Positive
    start: Start
    standing: Standing | None = None
    move: list[Move] = Field([])
    wave: list[Wave] = Field([])
    predicted: Promised | None = None
