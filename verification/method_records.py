"""Records for the methods: the conditions of ``method_table``, and the regimes in which each card
says that its intervals are measured. They are MuJoCo's, but those on which a torque plays.
"""

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from equipoise.actuators.sliding_masses import com_shift, mass_maps
from equipoise.maths.linalg import element_sizes, pack_symmetric, unpack_symmetric
from equipoise.model.estimate import COM as COM_NAMES
from equipoise.model.estimate import END
from equipoise.model.estimate import INERTIA as INERTIA_NAMES
from equipoise.model.mass_properties import MassProperties
from equipoise.model.method_card import Regime
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import AttitudeSensor, Gyro, Testbed
from tests.oracle import mujoco_bench as oracle
from tests.support import random_walk_records
from tests.support.builders import move_at

Array = NDArray[np.float64]
Condition = Literal["slow", "quick", "driven", "noisy"]
INERTIA = unpack_symmetric(np.array([0.265, 0.246, 0.427, -0.014, -0.035, -0.018]))
COM, MASS = np.array([5.0, 5.0, -50.0]) * 1e-6, 14.307
LEAN = np.radians(5.1)  # of pitch and roll: 7 to 8 deg of tilt, about which axis is not told
RATES = {"slow": (1.0, -1.0, 3.0), "quick": (1.0, -1.0, 20.0)}  # deg/s
CAMERA_SD, HZ, HALF = np.radians(0.05), 100.0, 50.0
FINE, POOR = 0.005, 0.05  # deg/s/sqrt(Hz)
DURATION = 60.0  # s
PUSH, PERIODS = 0.010, (8.0, 11.0, 14.0)  # N m about each axis, s
VAGUE = 0.05  # of J, one sd, where it is sought
DRAG = 0.3  # N m s about each axis: swings die away in some ten seconds
EDGE = 1e-7  # s, on both sides of a jump


@dataclass(frozen=True, slots=True, eq=False)
class Record:
    """What was recorded, what is known beforehand, and what is true."""

    recording: Recording
    testbed: Testbed
    com: Array  # m, masses at home
    inertia_P: Array  # kg m^2

    @property
    def truth(self) -> dict[str, float]:
        """Return what estimates should say, by name."""
        track, end = self.recording.masses, self.com
        if track is not None:
            maps = mass_maps(self.testbed.masses)
            end = end + com_shift(maps, self.testbed.body.mass, track.values[-1])
        values = (*self.com, *end, *pack_symmetric(self.inertia_P))
        return dict(zip((*COM_NAMES, *END, *INERTIA_NAMES), map(float, values), strict=True))


def unb(rate: tuple[float, float, float]) -> oracle.Platform:
    """Return a platform like that of Brasilia, turning at some deg/s."""
    lean = (oracle.rotation(LEAN * axis) for axis in (np.eye(3)[1], np.eye(3)[0]))
    return oracle.Platform(MASS, INERTIA, COM, (), 9.81, oracle.product(*lean), np.radians(rate))


def known_before(platform: oracle.Platform, density: float, hz: float) -> Testbed:
    """Return the platform as it is, com not known, and its sensors."""
    body = MassProperties(platform.mass, np.zeros(3), platform.inertia_P)
    gyro = Gyro(hz, np.radians(density) * hz**0.5, 0.0)
    return Testbed(
        "like UnB", body, 0.0, np.full(3, 1e-4), np.array([0.0, 0.0, 1.0]), np.radians(30),
        platform.gravity, (), AttitudeSensor(hz, CAMERA_SD, plumb_sd=0.0), gyro,
    )  # fmt: skip


def square_waves(t: Array) -> Array:
    """Return torques (n, 3), N m, that change sign every half period, first after a quarter."""
    phase = t[:, None] / np.array(PERIODS) + 0.25
    return PUSH * np.where(phase % 1.0 < 0.5, 1.0, -1.0)


def reported_torque(duration: float) -> Samples:
    """Return the same torques as they are told: a row on both sides of every jump."""
    jumps = [p * (0.25 + 0.5 * k) for p in PERIODS for k in range(round(2 * duration / p) + 1)]
    inner = np.unique([j for j in jumps if 0 < j < duration])
    t = np.unique(np.concatenate([[0.0], inner - EDGE, inner + EDGE, [duration]]))
    return Samples(t, square_waves(t))


def free_swing(
    rate: tuple[float, float, float], rng: np.random.Generator, hz: float = HZ
) -> Record:
    """Return a free swing."""
    run = oracle.simulate(unb(rate), (), DURATION, locked=True)
    return observed(run, rng, FINE, hz)


def pushed(rng: np.random.Generator, density: float, hz: float = HZ) -> Record:
    """Return a motion under known square waves."""
    t = oracle.middles(DURATION, 1e-3)
    still = unb((0.0, 0.0, 0.0))
    run = oracle.driven(still, np.zeros((len(t), 0)), square_waves(t), in_body=True)
    record = observed(run, rng, density, hz)
    reported = replace(record.recording, torque=reported_torque(DURATION))
    return replace(record, recording=reported, testbed=vaguely(record.testbed, rng))


def vaguely(testbed: Testbed, rng: np.random.Generator) -> Testbed:
    """Return the testbed with an inertia that is off by what it says."""
    off = VAGUE * element_sizes(INERTIA) * np.clip(rng.normal(size=6), -2.0, 2.0)
    body = replace(testbed.body, inertia_P=INERTIA + unpack_symmetric(off))
    return replace(testbed, body=body, inertia_sd=VAGUE)


def observed(run: oracle.OracleRun, rng: np.random.Generator, density: float, hz: float) -> Record:
    """Return what camera and gyro record of a run, both at ``hz``."""
    noise = np.radians(density) * hz**0.5
    recording = oracle.sensor_log(run, rng, hz, CAMERA_SD, hz, noise)
    recording = replace(recording, masses=None, mass_names=())
    return Record(recording, known_before(run.platform, density, hz), COM, INERTIA)


def condition(name: Condition, seed: int) -> Record:
    """Return a record of a condition of the table."""
    rng = np.random.default_rng(seed)
    if name in RATES:
        return free_swing(RATES[name], rng)
    return pushed(rng, FINE if name == "driven" else POOR)


def moved(rng: np.random.Generator) -> Record:
    """Return a random platform with two moves, camera and gyro."""
    platform = oracle.random_platform(rng, masses_per_axis=2)
    run = oracle.simulate(platform, oracle.random_schedule(rng, platform, moves=2))
    bias = rng.normal(0, 1e-3, 3)
    recording = oracle.sensor_log(run, rng, 50.0, CAMERA_SD, 50.0, 1e-4, bias)
    camera, gyro = AttitudeSensor(50.0, CAMERA_SD, plumb_sd=0.0), Gyro(50.0, 1e-4, np.radians(1.0))
    testbed = oracle.testbed_for(platform, rng, attitude=camera, gyro=gyro)
    return Record(recording, testbed, platform.com, platform.inertia_P)


def rests(rng: np.random.Generator) -> Record:
    """Return a platform with drag, its centre of mass low, that rests after each of four moves."""
    platform = oracle.random_platform(rng, 14.0, 2)
    com = np.append(rng.uniform(-30e-6, 30e-6, 2), -rng.uniform(400e-6, 900e-6))
    platform = replace(platform, com=com, viscous=np.full(3, DRAG))
    k = len(platform.slides)
    targets = [rng.choice([-1.0, 1.0], k) * rng.uniform(0.01, 0.05, k) for _ in range(4)]
    schedule = tuple(oracle.Ramp(60.0 * (j + 1), each) for j, each in enumerate(targets))
    run = oracle.simulate(platform, schedule, 300.0)
    camera = AttitudeSensor(5.0, np.radians(0.2), plumb_sd=0.0)
    testbed = oracle.testbed_for(platform, rng, attitude=camera)
    return Record(oracle.sensor_log(run, rng), testbed, platform.com, platform.inertia_P)


def wandering(seed: int, name: Regime) -> Record:
    """Return a swing whose centre of mass walks, com being where it is at the end."""
    push = random_walk_records.square_waves(DURATION) if name == "played" else None
    end, track = (120.0, move_at(60.0, 120.0)) if name == "drifting" else (DURATION, None)
    recording, com = random_walk_records.walked(seed, end, push, track)
    testbed = random_walk_records.guessed(seed, 0.05)
    body = testbed.body
    if name == "levelled":
        off = 1e-6 * np.random.default_rng(seed).normal(size=2)
        guess = replace(body, com=np.append(com[:2] + off, body.com[2]))
        testbed = replace(testbed, body=guess, com_sd=np.array([1e-6, 1e-6, 1e-4]))
    return Record(recording, testbed, com, unpack_symmetric(random_walk_records.INERTIA))


def regime(name: Regime, seed: int) -> Record:
    """Return a record of a regime that a card may name."""
    rng = np.random.default_rng(seed)
    if name == "free":
        return free_swing(RATES["slow"], rng, HALF)
    if name == "driven":
        return pushed(rng, FINE, HALF)
    if name in ("moved", "rests"):
        return moved(rng) if name == "moved" else rests(rng)
    return wandering(seed, name)
