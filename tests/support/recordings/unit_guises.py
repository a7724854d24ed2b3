"""Guises of the units: of rates, of angles, of clocks, said or not."""

from pathlib import Path

import numpy as np

from equipoise.model.arrays import Floats
from equipoise.model.units import DEG, MILLI, RPM
from tests.support.recordings.frame_guises import PRINTED, angles
from tests.support.recordings.recorded_motion import Motion
from tests.support.recordings.variant import Reads, Refused, Variant, answered
from tests.support.recordings.written_tables import columns, lines, named, saved, text

HALF_A_COUNT = 0.51  # of a rounded number, and what its factor's six digits leave


def counted(name: str, per_count: float) -> Variant:
    """Return a gyro that counts whole numbers of so many deg/s."""
    unit = per_count * DEG

    def write(motion: Motion, folder: Path) -> Path:
        return saved(folder, text(columns(motion, w=np.round(motion.w / unit))))

    return Variant(name, write, Reads(rate=HALF_A_COUNT * unit, said="deg/s per count"))


mpu_6050_of_250_deg_s = counted("mpu_6050_of_250_deg_s", 1 / 131)
mpu_6050_of_500_deg_s = counted("mpu_6050_of_500_deg_s", 1 / 65.5)
icm_20948_of_2000_deg_s = counted("icm_20948_of_2000_deg_s", 1 / 16.4)
l3gd20_of_250_deg_s = counted("l3gd20_of_250_deg_s", 8.75e-3)
itg_3200 = counted("itg_3200", 1 / 14.375)
bno055 = counted("bno055", 1 / 16)


def in_unit(motion: Motion, folder: Path, unit: float, names: tuple[str, ...]) -> Path:
    return saved(folder, text(columns(motion, w=motion.w / unit, rate=names), decimals=9))


@answered(Reads(said="; deg/s"))
def degrees_per_second(motion: Motion, folder: Path) -> Path:
    return in_unit(motion, folder, DEG, ("gx", "gy", "gz"))


@answered(Reads(said="; deg/s"))
def degrees_per_second_by_microseconds(motion: Motion, folder: Path) -> Path:
    table = columns(motion, "time", 1e6 * motion.t, w=motion.w / DEG)
    return saved(folder, text(table, decimals=9))


@answered(Reads(said="; mrad/s"))
def milliradians_per_second(motion: Motion, folder: Path) -> Path:
    return in_unit(motion, folder, MILLI, ("wx", "wy", "wz"))


@answered(Reads(said="; rpm"))
def revolutions_per_minute(motion: Motion, folder: Path) -> Path:
    return in_unit(motion, folder, RPM, ("p", "q", "r"))


@answered(Reads(said="; mdeg/s"))
def millidegrees_per_second(motion: Motion, folder: Path) -> Path:
    """As drivers of ST's gyros give them: mdps."""
    return in_unit(motion, folder, MILLI * DEG, ("gx_mdps", "gy_mdps", "gz_mdps"))


@answered(Reads(said="; deg/s"))
def degrees_per_second_said_in_brackets(motion: Motion, folder: Path) -> Path:
    return in_unit(motion, folder, DEG, ("gyroX [°/s]", "gyroY [°/s]", "gyroZ [°/s]"))


@answered(Reads(said="; deg/s"))
def degrees_per_second_said_to_be_radians(motion: Motion, folder: Path) -> Path:
    """The row of units is one of another program's table: the motion shows which holds."""
    head, *rows = lines(columns(motion, w=motion.w / DEG), decimals=9)
    return saved(folder, "\n".join([head, "ms,-,-,-,-,rad/s,rad/s,rad/s", *rows]))


@answered(Reads(turn=PRINTED, said="in rad"))
def angles_in_radians(motion: Motion, folder: Path) -> Path:
    values = np.column_stack([1e3 * motion.t, angles(motion, "ZYX") * DEG, motion.w])
    return saved(folder, text(named(("ms", "roll", "pitch", "yaw", "gx", "gy", "gz"), values)))


@answered(Reads(turn=PRINTED, said="in deg"))
def all_in_degrees_and_milliseconds(motion: Motion, folder: Path) -> Path:
    values = np.column_stack([1e3 * motion.t, np.round(angles(motion, "ZYX"), 2), motion.w / DEG])
    names = ("t_ms", "Roll", "Pitch", "Yaw", "GyroX", "GyroY", "GyroZ")
    return saved(folder, text(named(names, values), decimals=9))


def _others(motion: Motion) -> dict[str, Floats]:
    rng = np.random.default_rng(5)
    g = np.stack([np.sin(motion.q[:, 1]), np.sin(motion.q[:, 2]), np.cos(motion.q[:, 1])], axis=1)
    pull = np.round(1000 * (g + rng.normal(0, 0.002, g.shape)))
    return dict(zip(("ax_mg", "ay_mg", "az_mg"), pull.T, strict=True))


@answered(Reads(rate=HALF_A_COUNT * DEG / 131, said="deg/s per count"))
def counts_beside_an_accelerometer(motion: Motion, folder: Path) -> Path:
    unit = DEG / 131
    table = columns(motion, w=np.round(motion.w / unit))
    return saved(folder, text(_others(motion) | table))


@answered(Refused("No clock with four columns of a quaternion", "--write-map", by=("import",)))
def quaternion_in_counts(motion: Motion, folder: Path) -> Path:
    """As a BNO055 counts it, 16384 being one."""
    return saved(folder, text(columns(motion, q=np.round(16384 * motion.q))))
