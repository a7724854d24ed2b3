"""Flexible and sloshing modes: found where they are, not where they are not; J and com with them.

Platforms are MuJoCo's, random, with a wheel on a torsion spring or a pendulum, and without either.
How strongly a mode shows is the chi-square of what it adds to the gyro's rows,

    S = sum_rows |J^-1 d e'|^2 / noise^2
"""

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from equipoise.model.estimate import NORMAL_95
from equipoise.model.modes import FreeMode
from equipoise.model.recording import Recording
from equipoise.model.testbed import AttitudeSensor, Gyro, Testbed
from equipoise.procedure.identification.identify import IdentifyOptions, identify
from tests.oracle import flexible_platform as flexible
from tests.oracle import mujoco_bench as oracle
from verification.result import Result, Row, Spread, at_least, at_most, between, in_turn
from verification.stated_errors import stated_errors

STATED = 120  # platforms for which the claim is stated
FLOOR = 300.0  # S, from which a mode is to be found
STRONGEST = {"wheel": 1e5, "pendulum": 3e3}  # S; more would be a swing beyond small angles
KINDS = ("wheel", "rigid")  # a pendulum is not measured yet: its S needs a high-pass
SPAN, MOVED = 60.0, 20.0  # s, of a record, and when the masses move
CAMERA, NOISE = np.radians(0.02), np.radians(0.01)  # rad, rad/s
NEAR = 0.01  # of a frequency, chosen: so near is the same mode


class Found(NamedTuple):
    """One record identified."""

    kind: str
    strength: float  # S
    frequencies: tuple[float, ...]  # Hz, of the modes in the model
    true: FreeMode | None
    z: NDArray[np.float64]  # errors of com and inertia in stated sd
    usable: bool

    @property
    def is_found(self) -> bool:
        """Whether the mode that is there is in the model."""
        assert self.true is not None
        return any(abs(f / self.true.frequency - 1) < NEAR for f in self.frequencies)


def with_part(rng: np.random.Generator, kind: str) -> tuple[oracle.Platform, flexible.Part]:
    """Return a random platform with a part; one that the part does not fit is left out."""
    make = flexible.wheel if kind == "wheel" else flexible.pendulum
    while True:
        platform = oracle.random_platform(rng, mass=14.0, masses_per_axis=1, tilt=np.radians(3))
        part = make(rng, platform)
        if flexible.is_sound(platform, part):
            return platform, part


def strength_of(run: flexible.FlexibleRun, mode: FreeMode, part: flexible.Part) -> float:
    """Return S of a run."""
    shown = np.linalg.solve(run.run.platform.inertia_P, mode.coupling) * part.moment**0.5
    turning = run.turning[oracle.every(run.run, 50.0)]
    return float((shown @ shown) * np.sum((turning - turning.mean()) ** 2) / NOISE**2)


def simulated(
    kind: str, seed: int
) -> tuple[oracle.Platform, oracle.OracleRun, FreeMode | None, float]:
    """Return a platform's run, its mode and how strongly that shows."""
    rng = np.random.default_rng([seed, 41])
    if kind == "rigid":
        platform = oracle.random_platform(rng, mass=14.0, masses_per_axis=1, tilt=np.radians(3))
        ramp = oracle.Ramp(MOVED, np.full(3, 0.012))
        return platform, oracle.simulate(platform, (ramp,), SPAN), None, 0.0
    platform, part = with_part(rng, kind)
    ramp = oracle.Ramp(MOVED, np.full(3, 0.012))
    mode, wanted = (
        flexible.mode_of(part, platform),
        np.exp(rng.uniform(np.log(FLOOR), np.log(STRONGEST[kind]))),
    )
    probe = flexible.simulate(platform, replace(part, angle=1e-3), (), 30.0)
    angle = 1e-3 * (wanted / strength_of(probe, mode, part)) ** 0.5
    run = flexible.simulate(platform, replace(part, angle=angle), (ramp,), SPAN)
    return platform, run.run, mode, strength_of(run, mode, part)


def recorded(run: oracle.OracleRun, seed: int) -> tuple[Recording, Testbed]:
    """Return what the sensors recorded, and what is known beforehand."""
    rng = np.random.default_rng([seed, 42])
    recording = oracle.sensor_log(run, rng, 10.0, CAMERA, 50.0, NOISE)
    camera, gyro = AttitudeSensor(10.0, CAMERA), Gyro(50.0, NOISE, np.radians(0.1))
    return recording, oracle.testbed_for(run.platform, rng, attitude=camera, gyro=gyro)


def identified(seed: int) -> Found:
    """Identify one record: of a wheel, a pendulum or a rigid platform in turn."""
    kind = KINDS[seed % len(KINDS)]
    platform, run, mode, strength = simulated(kind, seed)
    recording, testbed = recorded(run, seed)
    *_, last = identify(recording, testbed, IdentifyOptions("trajectory"))
    found = last.estimate
    names = [p for p in found.parameters if p.name.endswith("_frequency")]
    frequencies = tuple(p.value for p in names)
    usable = found.outcome.usable
    z = stated_errors(found, platform) if usable else np.full(9, np.nan)
    return Found(kind, strength, frequencies, mode, z, usable)


def row_of_found(kind: str, runs: Sequence[Found]) -> Row:
    """Return how often the modes of a kind were found."""
    share = float(np.mean([run.is_found for run in runs]))
    return at_least(f"{kind}s found, S from {FLOOR:g} on, of {len(runs)}", share, 0.95)


def measure(seeds: Sequence[int], spread: Spread = in_turn) -> Result:
    """Identify one record for each seed."""
    runs = spread(partial(identified), seeds)
    groups = {kind: [run for run in runs if run.kind == kind] for kind in KINDS}
    rows = [row_of_found(kind, groups[kind]) for kind in KINDS[:-1] if groups[kind]]
    if groups["rigid"]:
        false = float(np.mean([bool(run.frequencies) for run in groups["rigid"]]))
        rows.append(at_most(f"modes of rigid platforms, of {len(groups['rigid'])}", false, 0.02))
    z = np.array([run.z for run in runs if run.kind != "rigid" and run.usable]).reshape(-1, 9)
    inside = float(np.mean(np.abs(z) < NORMAL_95))
    rows.append(between("com and inertia in their 95 % intervals, with modes", inside, 0.9, 0.99))
    claim = (
        "A flexible or sloshing mode of a platform is found where it shows, and none where there "
        "is none; inertia and centre of mass are inside their intervals all the same."
    )
    return Result("modes", claim, tuple(rows), ())
