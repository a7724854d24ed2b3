"""Flights of a platform over a table by MuJoCo, and what a laboratory knows beforehand.

A platform of 4 to 40 kg hangs 1.5 to 4.5 mm below P, on a sled of 20 to 50 % of its mass, on a
table of 4 m by 4 m that slopes by some 50 um/m. Friction at the corners is 0.02 to 0.2 N s/m. It
glides over the middle at 10 to 30 mm/s for a minute, swinging by 5 to 12 deg. Motion capture at
50 Hz has 0.05 deg and 0.3 mm, the gyro 0.02 deg/s and a bias. The inertia is known to 10 %, the
centre of mass not.
"""

from dataclasses import dataclass, replace

import numpy as np

from equipoise.model.mass_properties import parallel_axis
from equipoise.model.recording import Recording
from equipoise.model.table_top import PlanarTable, PositionSensor
from equipoise.model.testbed import AttitudeSensor, Gyro, Testbed
from tests.oracle import mujoco_bench as oracle
from tests.oracle import planar_bench

BELOW, DURATION = 3e-3, 60.0  # m, s
CAMERA = AttitudeSensor(50.0, float(np.deg2rad(0.05)), plumb_sd=0.0)
GYRO = Gyro(50.0, float(np.deg2rad(0.02)), float(np.deg2rad(0.3)))
POSITION = PositionSensor(50.0, 3e-4)
HALF = 2.0  # m, of the table's sides
LOW, HIGH = np.array([-HALF, -HALF]), np.array([HALF, HALF])


@dataclass(frozen=True, eq=False)
class Flight:
    """A record, what is known beforehand, and what is true."""

    platform: oracle.Platform
    floor: planar_bench.Floor
    recording: Recording
    testbed: Testbed
    run: planar_bench.PlanarRun


def bilinear(corners: np.ndarray) -> planar_bench.Coefficient:
    """Return friction (N s/m) between four corners: low low, low high, high low, high high."""

    def at(x: float, y: float) -> float:
        a, b = (min(max(0.5 * (z / HALF + 1.0), 0.0), 1.0) for z in (x, y))
        low = (1 - a) * corners[0] + a * corners[2]
        high = (1 - a) * corners[1] + a * corners[3]
        return float((1 - b) * low + b * high)

    return at


def wavy(level: float, phases: np.ndarray) -> planar_bench.Coefficient:
    """Return friction (N s/m) in waves of 4 m along x and 6 m along y, by a half up and down."""

    def at(x: float, y: float) -> float:
        waves = np.sin(np.pi / 2 * x + phases[0]) * np.sin(np.pi / 3 * y + phases[1])
        return float(level * (1 + 0.5 * waves))

    return at


def hanging(rng: np.random.Generator, below: float) -> oracle.Platform:
    """Return a random platform whose centre of mass is so far (m) below P, or half or more."""
    platform = oracle.random_platform(
        rng, masses_per_axis=1, tilt=float(np.deg2rad(rng.uniform(5, 12)))
    )
    com = np.array([*rng.uniform(-0.2, 0.2, 2), -1.0]) * below * rng.uniform(0.5, 1.5)
    J = platform.inertia_P - parallel_axis(platform.mass, platform.com)
    return replace(platform, com=com, inertia_P=J + parallel_axis(platform.mass, com))


def gliding(rng: np.random.Generator, mass: float, duration: float) -> planar_bench.Floor:
    """Return a sled and a table over whose middle it glides."""
    sled = float(mass * rng.uniform(0.2, 0.5))
    corners, heading = rng.uniform(0.02, 0.2, 4), rng.uniform(0, 2 * np.pi)
    velocity = rng.uniform(0.01, 0.03) * np.array([np.cos(heading), np.sin(heading)])
    slope = rng.normal(0, 5e-5, 2)
    return planar_bench.Floor(sled, slope, bilinear(corners), -0.5 * duration * velocity, velocity)


def flight(seed: int, duration: float = DURATION, waves: bool = False) -> Flight:
    """Return the flight of a seed, over friction in waves if wanted, which no map has exactly."""
    rng = np.random.default_rng(seed)
    platform = hanging(rng, BELOW)
    floor = gliding(rng, platform.mass, duration)
    if waves:
        friction = wavy(rng.uniform(0.05, 0.15), rng.uniform(0, 2 * np.pi, 2))
        floor = replace(floor, friction=friction)
    run = planar_bench.simulate(platform, floor, duration)
    log = planar_bench.planar_log(run, rng, bias=rng.normal(0, np.deg2rad(0.1), 3))
    bed = oracle.testbed_for(platform, rng, 0.1, CAMERA, GYRO)
    body = replace(bed.body, com=np.array([0.0, 0.0, -BELOW]))
    table = PlanarTable(floor.sled, LOW, HIGH)
    bed = replace(bed, body=body, com_sd=np.full(3, BELOW), masses=(), position=POSITION,
                  table=table)  # fmt: skip
    recording = replace(log, masses=None, mass_names=())
    return Flight(platform, floor, recording, bed, run)
