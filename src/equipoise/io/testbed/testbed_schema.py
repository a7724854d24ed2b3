"""The tables and keys of a testbed file: what may stand where, in which unit, and the defaults.

A unit is part of its key. Nothing is converted here; ``testbed_build`` does that once.
"""

import math
from typing import Annotated, Literal

from pydantic import Field

from equipoise.io.testbed.devices import (
    ControlMomentGyro,
    JetPair,
    MagneticField,
    Magnetorquer,
    ReactionWheel,
)
from equipoise.io.testbed.hardware import Hardware
from equipoise.io.testbed.weights import Weight, WeightGrid
from equipoise.io.toml.key_types import (
    Five,
    Name,
    NotNegative,
    Pair,
    Positive,
    SdTriple,
    Square,
    Table,
    Triple,
)
from equipoise.model.testbed import LAG_SD, PLUMB_SD, SAG_SD

Point = Literal["C", "P"]


class Platform(Table):
    """Everything that floats, with the sliding masses at home."""

    mass_kg: Positive
    inertia_kg_m2: Square = Field(description="tensor elements: products are minus the integrals")
    inertia_sd_percent: Positive = Field(10.0, description="one sd, chosen: usual for CAD")
    about: Point = Field("C", description="C: centre of mass, P: centre of rotation")
    com_um: Triple = Field([0.0, 0.0, 0.0], description="first guess, from P")
    com_sd_um: SdTriple = Field(
        [500.0, 500.0, 500.0], description="one sd, chosen: a platform balanced by hand"
    )
    up: Triple | None = Field(None, description="body axis that points up when level")
    tilt_limit_deg: Annotated[float, Field(gt=0, le=180)] = Field(
        30.0, description="chosen: usual for a table on a hemisphere"
    )
    gravity_m_s2: Positive = Field(9.80665, description="standard gravity")


class SlidingMass(Table):
    """A mass on a rail; its displacement counts from home along ``axis``."""

    name: Name
    mass_g: Positive
    home_mm: Triple
    axis: Triple
    travel_mm: Pair = Field(description="least and greatest displacement")
    resolution_mm: NotNegative = Field(0.0, description="0: any displacement can be asked for")
    accuracy_mm: NotNegative = Field(0.1, description="one sd, chosen: a lead screw's")
    backlash_mm: NotNegative = 0.0
    speed_mm_s: Positive = Field(10.0, description="chosen: a small stepper on a lead screw")
    lag_sd_ms: NotNegative = Field(
        1e3 * LAG_SD,
        description="one sd of how late it follows a recorded command, chosen: a soft servo's; "
        "masses with one value share one lag; 0: at once, or the log is a measurement",
    )
    sag_sd_mm: NotNegative = Field(
        1e3 * SAG_SD,
        description="one sd of how far it hangs below a command on an upright rail, chosen: a "
        "soft servo's; 0: a stiff drive, a lead screw's",
    )
    gain: Positive = Field(
        1.0,
        description="first moment that it really gives, over mass_g times the commanded "
        "displacement; equipoise calibrate finds it",
    )


class Attitude(Table):
    """A camera or motion capture."""

    rate_hz: Positive
    noise_deg: Positive = Field(description="one sd per axis and sample")
    delay_s: NotNegative = 0.0
    averaging_s: NotNegative = 0.0
    quantum_deg: NotNegative = Field(0.0, description="last digit of roll, pitch, yaw (3-2-1)")
    plumb_sd_deg: NotNegative = Field(
        math.degrees(PLUMB_SD),
        description="one sd of how far its vertical may lean from gravity's, chosen: levelled by "
        "eye; 0: it does not lean",
    )


class Gyro(Table):
    """A rate gyro triad; give its noise per sample or as a density, not both."""

    rate_hz: Positive
    noise_deg_s: Positive | None = Field(None, description="one sd per axis and sample")
    noise_density_deg_s_rthz: Positive | None = Field(None, description="noise / sqrt(rate)")
    bias_sd_deg_s: NotNegative = Field(1.0, description="chosen: usual for a low-cost gyro")
    delay_s: NotNegative = 0.0
    averaging_s: NotNegative = 0.0
    quantum_deg_s: NotNegative = Field(0.0, description="last digit of a rate")


class Sensors(Table):
    """What sees the platform."""

    attitude: Attitude | None = None
    gyro: Gyro | None = None


class Disturbance(Table):
    """Which torques to consider beside gravity."""

    consider: list[str] = Field(default=[])


class Fault(Table):
    """A mass that does not do as it is told."""

    mass: str
    kind: Literal["stuck", "slip"] = "stuck"
    gain: float | None = Field(None, description="slip: share of the distance really gone")
    from_move: Annotated[int, Field(ge=1)] = 1


class Drive(Table):
    """What a mass's drive really is, all its life; what is left out is as the testbed states it.

    Nothing here is relative to what is stated, so that it stays true when that is calibrated.
    """

    mass: str
    gain: Positive | None = Field(None, description="as the mass's own key")
    axis: Triple | None = Field(None, description="direction of the rail, body axes")
    backlash_mm: NotNegative | None = None
    accuracy_mm: NotNegative | None = Field(None, description="one sd of where it really stops")


class Contact(Table):
    """The platform touches something for a moment."""

    time_s: Positive
    impulse_N_m_s: Triple = Field(description="about the centre of rotation, laboratory axes")


class ComStep(Table):
    """A part slips, once."""

    time_s: Positive
    com_um: Triple = Field(description="by how much the total centre of mass moves, body axes")


class Gap(Table):
    """Rows of camera and gyro that are missing, both ends included."""

    start_s: NotNegative
    end_s: Positive


class Truth(Table):
    """What the simulated bench is made of; read by the simulator alone."""

    com_um: Triple | None = None
    com_low_um: Triple | None = None
    com_high_um: Triple | None = None
    inertia_kg_m2: Square | None = Field(None, description="about the platform's point")
    inertia_error_percent: Annotated[float, Field(ge=0, lt=100)] = 0.0
    attitude_deg: Triple | None = Field(None, description="roll, pitch, yaw (3-2-1)")
    tilt_deg: Annotated[float, Field(ge=0, le=180)] = 3.0
    rate_deg_s: Triple | None = None
    rate_limit_deg_s: NotNegative = 0.5
    viscous_N_m_s: Triple | None = None
    quadratic_N_m_s2: float | None = None
    constant_N_m: Triple | None = None
    swirl_N_m: float | None = None
    sag_um: Five | None = Field(None, description="xx, yy, xy, xz, yz")
    drift_um_min: Triple | None = None
    noise_torque_N_m: NotNegative = 0.0
    noise_correlation_s: Positive = 30.0
    gyro_bias_deg_s: Triple = Field([0.0, 0.0, 0.0])
    gyro_scale_percent: Triple = Field([0.0, 0.0, 0.0], description="each axis reads so much more")
    gyro_misalignment_deg: Triple = Field(
        [0.0, 0.0, 0.0], description="rotation vector from body axes to the gyro's"
    )
    plumb_deg: Pair = Field(
        [0.0, 0.0], description="attitudes are seen turned by so much about laboratory x and y"
    )
    heading2_cos_deg: Triple = Field(
        [0.0, 0.0, 0.0], description="turn of the seen attitude, times cos(2 heading); body"
    )
    heading2_sin_deg: Triple = Field(
        [0.0, 0.0, 0.0], description="turn of the seen attitude, times sin(2 heading); body"
    )
    bad_rows_percent: Annotated[float, Field(ge=0, le=100)] = Field(
        0.0, description="share of the camera's rows that are outliers"
    )
    bad_row_deg: Annotated[float, Field(ge=0, le=180)] = Field(
        10.0, description="turn of an outlier about any axis, chosen: far outside any noise"
    )
    mass_lag_s: NotNegative = Field(0.0, description="masses are so far behind their report")
    field_uT: Triple | None = Field(None, description="magnetic, laboratory axes, as it really is")
    fault: list[Fault] = Field([])
    drive: list[Drive] = Field([])
    contact: list[Contact] = Field([])
    com_step: list[ComStep] = Field([])
    gap: list[Gap] = Field([])


class TestbedFile(Table):
    """A testbed file as a whole."""

    __test__ = False  # not a test case, whatever its name suggests

    name: Annotated[str, Field(min_length=1)]
    platform: Platform
    sliding_mass: list[SlidingMass] = Field([])
    reaction_wheel: list[ReactionWheel] = Field([])
    control_moment_gyro: list[ControlMomentGyro] = Field([])
    magnetorquer: list[Magnetorquer] = Field([])
    jet_pair: list[JetPair] = Field([])
    magnetic_field: MagneticField | None = None
    weight: list[Weight] = Field([])
    weight_grid: list[WeightGrid] = Field([])
    sensor: Sensors = Sensors()
    disturbance: Disturbance = Disturbance()
    hardware: Hardware | None = None
    truth: Truth | None = None
    assumed: dict[str, str] = Field({}, description="dotted key of this file: why it is assumed")
