"""Motions of a platform like the preset `nanosat`, made by MuJoCo, as camera and gyro saw them."""

from dataclasses import dataclass

import numpy as np

from equipoise.model.arrays import Series1, Series3, Series4
from equipoise.model.mass_properties import MassProperties, parallel_axis
from equipoise.model.recording import Recording
from tests.oracle import mujoco_bench as oracle

MASS, GRAVITY = 4.0, 9.80665  # kg, m/s^2: as the preset states
RATE_HZ, STEP = 40.0, 5e-3  # of both sensors; s of the simulation
CAMERA_SD, GYRO_SD = np.radians(0.1), np.radians(0.03)  # rad, rad/s
ZERO = np.radians([0.05, -0.03, 0.04])  # rad/s, the gyro's
COM = np.array([9e-6, -6e-6, -95e-6])  # m: within the preset's sd
INERTIA_C = np.array(
    [[0.0452, 0.0008, -0.0005], [0.0008, 0.0412, 0.0006], [-0.0005, 0.0006, 0.0279]]
)


@dataclass(frozen=True, slots=True, eq=False)
class Motion:
    """What the sensors reported of a motion, and the platform's truth."""

    t: Series1  # s
    q: Series4  # scalar first, body to a laboratory whose Z is up
    w: Series3  # rad/s, body axes
    truth: MassProperties


def motion(seed: int, tilt_deg: float, spin_deg_s: float, duration: float = 60.0) -> Motion:
    """Return a motion that begins with so much tilt, turning about the vertical."""
    rng = np.random.default_rng(seed)
    inertia = INERTIA_C + parallel_axis(MASS, COM)
    way, heading = rng.uniform(0, 2 * np.pi, 2)
    lean = np.radians(tilt_deg) * np.array([np.cos(way), np.sin(way), 0.0])
    q = oracle.product(oracle.rotation(lean), oracle.rotation(np.array([0.0, 0.0, heading])))
    rate = oracle.matrix(q).T @ np.radians([0.6, -0.4, spin_deg_s])
    platform = oracle.Platform(MASS, inertia, COM, (), GRAVITY, q, rate)
    run = oracle.simulate(platform, (), duration, STEP, locked=True)
    log = oracle.sensor_log(run, rng, RATE_HZ, CAMERA_SD, RATE_HZ, GYRO_SD, ZERO, RATE_HZ)
    return _moved(log, MassProperties(MASS, COM, inertia))


def _moved(log: Recording, truth: MassProperties) -> Motion:
    attitude, rate = log.attitude, log.rate
    assert attitude is not None
    assert rate is not None
    return Motion(attitude.t, attitude.values, rate.values, truth)


def turning() -> Motion:
    """Return a motion whose heading turns once around: most of what a table means shows in it."""
    return motion(3, 10.0, 5.0)


def swinging() -> Motion:
    """Return a motion that hardly turns about the vertical."""
    return motion(4, 9.0, 0.3)
