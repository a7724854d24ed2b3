"""A testbed file as a whole: its tables, and the testbed that they describe, in SI."""

import math
from collections.abc import Mapping
from typing import Annotated, Any, cast

from pydantic import Field

from equipoise.io.testbed import devices
from equipoise.io.testbed.hardware import (
    Hardware,
    check_driven_devices,
    check_moved_masses,
)
from equipoise.io.testbed.platform import Platform, SlidingMass, check_total_mass, up_of
from equipoise.io.testbed.table_top import Position, TableTop, check_table
from equipoise.io.testbed.true_surroundings import check_true_lamp, check_true_rows
from equipoise.io.testbed.truth import Truth, check_true_drives, truth_of
from equipoise.io.testbed.vector_sensors import Accelerometer, Magnetometer, Sun
from equipoise.io.testbed.weights import Weight, WeightGrid, check_weights
from equipoise.io.toml.key_types import ITSELF, Holds, NotNegative, Positive, Table, Visible
from equipoise.io.toml.table_records import RecordTable, check_names, record_of
from equipoise.io.toml.units import key_factor
from equipoise.model import testbed as model
from equipoise.model.errors import InputError
from equipoise.model.testbed import Testbed
from equipoise.model.torque_terms import expand

# A density is written as noise per sample, and what is assumed of it goes along.
WRITTEN_AS = {"sensor.gyro.noise_density_deg_s_rthz": "sensor.gyro.noise_deg_s"}


CLOCK: float = Field(
    100 * model.CLOCK_SD,
    description="standard deviation of its clock rate; default: crystal; 0: exact",
)


class Attitude(RecordTable):
    """A camera, motion capture or star tracker: whatever gives whole attitudes."""

    KIND = model.AttitudeSensor

    rate_hz: Positive
    noise_deg: Positive = Field(description="standard deviation per axis and sample")
    delay_s: NotNegative = 0.0
    averaging_s: NotNegative = 0.0
    quantum_deg: NotNegative = Field(0.0, description="resolution of roll, pitch, yaw (3-2-1)")
    clock_sd_percent: NotNegative = CLOCK
    plumb_sd_deg: NotNegative = Field(
        math.degrees(model.PLUMB_SD),
        description=(
            "standard deviation of the tilt of its vertical from gravity; default: "
            "levelled by eye; 0: none"
        ),
    )


class Gyro(RecordTable):
    """A rate gyro triad; give its noise per sample or as a density, not both."""

    rate_hz: Positive
    noise_deg_s: Positive | None = Field(None, description="standard deviation per axis and sample")
    noise_density_deg_s_rthz: Positive | None = Field(None, description="noise / sqrt(rate)")
    bias_sd_deg_s: NotNegative = Field(1.0, description="default: usual for a low-cost gyro")
    delay_s: NotNegative = 0.0
    averaging_s: NotNegative = 0.0
    quantum_deg_s: NotNegative = Field(0.0, description="resolution of a rate")
    clock_sd_percent: NotNegative = CLOCK

    def record(self, where: str) -> model.Gyro:
        """Return the gyro; InputError unless its noise is given once."""
        noise, density = self.noise_deg_s, self.noise_density_deg_s_rthz
        if (noise is None) == (density is None):
            found = "neither" if noise is None else "both"
            raise InputError(where, found, "one of 'noise_deg_s' and 'noise_density_deg_s_rthz'")
        if density is None:
            return record_of(model.Gyro, self, where)
        per_sample = density * math.sqrt(self.rate_hz)
        return record_of(model.Gyro, self, where, noise=per_sample * key_factor("noise_deg_s"))

    @classmethod
    def more_keys(cls, record: Any) -> Mapping[str, Any]:
        """Return no density: a record has the noise per sample."""
        return {"noise_density_deg_s_rthz": None}


class Sensors(Table):
    """What measures the platform's motion."""

    attitude: Attitude | None = None
    gyro: Gyro | None = None
    accelerometer: Accelerometer | None = None
    sun: Sun | None = None
    magnetometer: Magnetometer | None = None
    temperature: Annotated[devices.Thermometer | None, Holds("thermometer")] = None
    position: Position | None = None


class Disturbance(Table):
    """Which torques to consider beside gravity, and how large two that vary at random are."""

    consider: Annotated[list[str], Holds("disturbances")] = Field(default=[])
    air_torque_N_m: Positive = Field(
        default=2e-6, description="torque of air and bearing, standard deviation per axis"
    )
    com_walk_um: Positive = Field(
        default=0.05,
        description="random walk of the centre of mass, standard deviation after a minute",
    )


class TestbedFile(RecordTable):
    """A testbed file as a whole."""

    __test__ = False  # not a test case, whatever its name suggests

    name: Visible
    platform: Annotated[Platform, Holds(ITSELF)]
    sliding_mass: Annotated[list[SlidingMass], Holds("masses")] = Field([])
    reaction_wheel: Annotated[list[devices.ReactionWheel], Holds("wheels")] = Field([])
    control_moment_gyro: Annotated[list[devices.ControlMomentGyro], Holds("cmgs")] = Field([])
    magnetorquer: Annotated[list[devices.Magnetorquer], Holds("magnetorquers")] = Field([])
    coil_pair: Annotated[list[devices.CoilPair], Holds("coil_pairs")] = Field([])
    jet_pair: Annotated[list[devices.JetPair], Holds("jets")] = Field([])
    magnetic_field: devices.MagneticField | None = None
    weight: Annotated[list[Weight], Holds("weights")] = Field([])
    weight_grid: Annotated[list[WeightGrid], Holds("grids")] = Field([])
    lamp: devices.Lamp | None = None
    table: TableTop | None = None
    sensor: Annotated[Sensors, Holds(ITSELF)] = Sensors()
    disturbance: Annotated[Disturbance, Holds(ITSELF)] = Disturbance()
    hardware: Hardware | None = None
    truth: Truth | None = None
    assumed: dict[str, str] = Field(
        {}, description="dotted key of this file: why its value is assumed"
    )

    def record(self, where: str) -> Testbed:
        """Return the testbed; ``where`` is the file."""
        _check(self, where)
        body, mended = self.platform.body(f"{where}: platform")
        consider, truth = tuple(self.disturbance.consider), None
        if self.truth is not None:
            truth = truth_of(self.truth, self.platform, body.com, f"{where}: truth")
        return record_of(
            Testbed,
            self,
            f"{where}:",
            body=body,
            up=up_of(self.platform, body.com, f"{where}: platform"),
            disturbances=expand(consider, f"{where}: disturbance.consider"),
            truth=truth,
            source=where,
            mended=mended,
        )

    @classmethod
    def more_keys(cls, record: Any) -> Mapping[str, Any]:
        """Return what is assumed of the keys that are written."""
        return {"assumed": {WRITTEN_AS.get(k, k): why for k, why in record.assumed.items()}}


def _check(file: TestbedFile, source: str) -> None:
    """Raise InputError for tables that do not fit each other."""
    masses = [mass.name for mass in file.sliding_mass]
    check_names(file.sliding_mass, f"{source}: sliding_mass")
    check_total_mass(file.platform, file.sliding_mass, source)
    kinds = ("reaction_wheel", "control_moment_gyro", "magnetorquer", "coil_pair", "jet_pair")
    devices.check_device_names({kind: getattr(file, kind) for kind in kinds}, source)
    check_weights(file.weight, file.weight_grid, source)
    _check_field(file, source)
    _check_sun(file, source)
    is_true = file.truth is not None and file.truth.table is not None
    check_table(file.table, file.sensor.position, is_true, source)
    _check_assumed(file, source)
    if file.truth is not None:
        check_true_drives(file.truth, masses, f"{source}: truth")
        pairs = [pair.name for pair in file.coil_pair]
        check_true_rows(file.truth.coil_pair, pairs, f"{source}: truth.coil_pair")
        check_true_lamp(file.truth.lamp, file.truth.thermal_um_K, file.lamp, f"{source}: truth")
    if file.hardware is not None:
        check_moved_masses(file.hardware.board, masses, source)
        driven = [device.name for kind in kinds for device in getattr(file, kind)]
        check_driven_devices(file.hardware.actuator, driven, source)


def _check_field(file: TestbedFile, source: str) -> None:
    magnetometer = file.sensor.magnetometer
    known = file.magnetic_field
    if known is not None and magnetometer is not None and known.noise_uT is not None:
        found = "a magnetometer, and noise_uT in [magnetic_field] as well"
        raise InputError(f"{source}: sensor.magnetometer", found, "its noise in one place")
    if file.magnetic_field is not None or file.coil_pair:
        return
    if magnetometer is not None:
        wanted = "a table [magnetic_field] with field_uT, in laboratory axes, or [[coil_pair]]"
        where = f"{source}: sensor.magnetometer"
        raise InputError(where, "a magnetometer but no magnetic field", wanted)
    if file.magnetorquer:
        wanted = "a table [magnetic_field] with field_uT, in laboratory axes, or [[coil_pair]]"
        raise InputError(f"{source}: magnetorquer", "magnetorquers but no magnetic field", wanted)
    if file.truth is not None and file.truth.field_uT is not None:
        wanted = "a table [magnetic_field] with the nominal field, or [[coil_pair]]"
        raise InputError(f"{source}: truth.field_uT", "a true field but no stated field", wanted)


def _check_sun(file: TestbedFile, source: str) -> None:
    sun, lamp = file.sensor.sun, file.lamp
    stated = lamp is not None and lamp.direction is not None
    if sun is None or sun.direction is not None or stated:
        return
    wanted = "the direction to its lamp, here or in [lamp], in laboratory axes"
    raise InputError(f"{source}: sensor.sun.direction", "nothing", wanted)


def _check_assumed(file: TestbedFile, source: str) -> None:
    """Raise InputError for an assumed key that the file does not have."""
    content = file.model_dump(exclude_none=True)
    for key in file.assumed:
        if not _holds(content, key.split(".")):
            wanted = "the dotted name of a key in use"
            raise InputError(f"{source}: assumed.'{key}'", "no such key", wanted)


def _holds(content: Any, path: list[str]) -> bool:
    """Say whether a dotted key is there; for a list of tables, in its first."""
    if not path:
        return True
    if isinstance(content, list):
        tables = cast("list[Any]", content)
        return bool(tables) and _holds(tables[0], path)
    table = cast("dict[str, Any]", content) if isinstance(content, dict) else {}
    return path[0] in table and _holds(table[path[0]], path[1:])
