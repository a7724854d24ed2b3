"""MuJoCo's platforms that are not rigid, and what their sensors record.

How strongly a wheel shows is the chi-square of what it adds to the gyro's rows,

    S = sum_rows |J^-1 d e'|^2 / noise^2

A pendulum that the platform can bear moves too little for that. It shows as sag, from 5 % of the
depth of com on. Platforms that it would make lean more than a bearing lets them are left out.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from equipoise.model.modes import FreeMode
from equipoise.model.recording import Recording
from equipoise.model.testbed import AttitudeSensor, Gyro, Testbed
from tests.oracle import flexible_platform as flexible
from tests.oracle import mujoco_bench as oracle

FLOOR = 100.0  # S, from which on a mode is to be found; measured: of 122 all 70 above 70 were
FAINTEST, STRONGEST = 10.0, 1e5  # S; more would be a swing beyond small angles
STRONG = 1e4  # S of one of two wheels
RATIO = 1.2  # chosen: ratio of the frequencies of two wheels
LEAN = np.radians(35.0)  # chosen: a bearing ends there
SPAN, MOVED = 60.0, 20.0  # s, of a record, and when the masses move
TRAVELLED = (0.003, 0.012)  # m, by which each of them moves
CAMERA, NOISE = np.radians(0.02), np.radians(0.01)  # rad, rad/s


@dataclass(frozen=True, slots=True, eq=False)
class Simulated:
    """A run, its modes, and how strongly each shows."""

    run: oracle.OracleRun
    modes: tuple[FreeMode, ...] = ()
    strengths: tuple[float, ...] = ()


def random_platform(rng: np.random.Generator) -> oracle.Platform:
    """Return a platform of 14 kg with three masses, tilted by 3 deg at the beginning."""
    return oracle.random_platform(rng, mass=14.0, masses_per_axis=1, tilt=np.radians(3))


def with_parts(
    rng: np.random.Generator, make: Sequence[flexible.Maker]
) -> tuple[oracle.Platform, list[flexible.Part]]:
    """Return a random platform with parts; one that they do not fit is left out."""
    while True:
        platform = random_platform(rng)
        parts = [one(rng, platform) for one in make]
        f = sorted(flexible.mode_of(part, platform).frequency for part in parts)
        if flexible.is_sound(platform, parts) and np.all(np.divide(f[1:], f[:-1]) > RATIO):
            return platform, parts


def strength_of(run: flexible.FlexibleRun, k: int, mode: FreeMode, part: flexible.Part) -> float:
    """Return S of part k of a run."""
    shown = np.linalg.solve(run.run.platform.inertia_P, mode.coupling) * part.moment**0.5
    turning = run.turning[oracle.every(run.run, 50.0), k]
    return float((shown @ shown) * np.sum((turning - turning.mean()) ** 2) / NOISE**2)


def as_strong(platform: oracle.Platform, part: flexible.Part, wanted: float) -> flexible.Part:
    """Return a wheel that begins so far turned that it shows about as strongly as wanted."""
    probe = flexible.simulate(platform, [replace(part, angle=1e-3)], (), 30.0)
    found = strength_of(probe, 0, flexible.mode_of(part, platform), part)
    return replace(part, angle=1e-3 * (wanted / found) ** 0.5)


def with_wheels(
    rng: np.random.Generator, ramp: oracle.Ramp, count: int, strongest: tuple[float, float]
) -> Simulated:
    """Return a run of a platform with wheels that show within two limits of S."""
    platform, parts = with_parts(rng, [flexible.wheel] * count)
    wanted = np.exp(rng.uniform(*np.log(strongest), size=count))
    parts = [as_strong(platform, *pair) for pair in zip(parts, wanted, strict=True)]
    run = flexible.simulate(platform, parts, (ramp,), SPAN)
    modes = [flexible.mode_of(part, platform) for part in parts]
    shown = [strength_of(run, k, *pair) for k, pair in enumerate(zip(modes, parts, strict=True))]
    return Simulated(run.run, tuple(modes), tuple(shown))


def with_pendulum(rng: np.random.Generator) -> Simulated:
    """Return a run of a platform with a pendulum, within what a bearing lets it lean."""
    while True:
        platform, parts = with_parts(rng, [flexible.pendulum])
        run = flexible.simulate(platform, parts, (ramp_of(rng),), SPAN).run
        if np.all(np.cos(LEAN) < upright(run.q)):
            return Simulated(run, (flexible.mode_of(parts[0], platform),), (0.0,))


def upright(q: oracle.Array) -> oracle.Array:
    """Return the cosine of the tilt at attitudes (n, 4)."""
    return 1.0 - 2.0 * (q[:, 1] ** 2 + q[:, 2] ** 2)


def ramp_of(rng: np.random.Generator) -> oracle.Ramp:
    """Return the move of all masses, as far as a record of a pendulum has it."""
    return oracle.Ramp(MOVED, np.full(3, rng.uniform(*TRAVELLED)))


def simulated(kind: str, seed: int) -> Simulated:
    """Return a run of a platform of a kind (``modes.KINDS``)."""
    rng = np.random.default_rng([seed, 41])
    ramp = oracle.Ramp(MOVED, np.full(3, TRAVELLED[1]))
    if kind == "rigid":
        return Simulated(oracle.simulate(random_platform(rng), (ramp,), SPAN))
    if kind == "pendulum":
        return with_pendulum(rng)
    limits = {"wheel": (FLOOR, STRONGEST), "faint": (FAINTEST, FLOOR), "pair": (FLOOR, STRONG)}
    return with_wheels(rng, ramp, 2 if kind == "pair" else 1, limits[kind])


def recorded(run: oracle.OracleRun, seed: int) -> tuple[Recording, Testbed]:
    """Return what the sensors recorded, and what is known beforehand."""
    rng = np.random.default_rng([seed, 42])
    recording = oracle.sensor_log(run, rng, 10.0, CAMERA, 50.0, NOISE)
    camera, gyro = AttitudeSensor(10.0, CAMERA), Gyro(50.0, NOISE, np.radians(0.1))
    return recording, oracle.testbed_for(run.platform, rng, attitude=camera, gyro=gyro)
