"""Flexible and sloshing modes: found where they are, not where they are not; J and com with them.

Platforms are MuJoCo's, random, with a wheel on a torsion spring or a pendulum, and without either.
How strongly a wheel shows is the chi-square of what it adds to the gyro's rows,

    S = sum_rows |J^-1 d e'|^2 / noise^2

A pendulum that the platform can bear moves too little for that. It shows as sag, from 5 % of the
depth of com on, and gravity acts at its pivot: the outcome must say that intervals may not hold.
"""

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from equipoise.model.estimate import NORMAL_95
from equipoise.model.modes import FreeMode
from equipoise.model.outcome import Trust
from equipoise.model.reasons.mode_reasons import ModeReason
from equipoise.model.recording import Recording
from equipoise.model.testbed import AttitudeSensor, Gyro, Testbed
from equipoise.procedure.identification.identify import IdentifyOptions, identify
from tests.oracle import flexible_platform as flexible
from tests.oracle import mujoco_bench as oracle
from verification.chance import share_band
from verification.result import Result, Row, Spread, at_least, at_most, between, in_turn
from verification.stated_errors import stated_errors

STATED = 120  # platforms for which the claim is stated
FLOOR = 300.0  # S, from which a mode is to be found
STRONGEST = 1e5  # S; more would be a swing beyond small angles
KINDS = ("wheel", "rigid", "pendulum")
WRONG = 4.0  # stated sd, chosen: by chance one of 16000 numbers errs by more
SPAN, MOVED = 60.0, 20.0  # s, of a record, and when the masses move
CAMERA, NOISE = np.radians(0.02), np.radians(0.01)  # rad, rad/s
NEAR = 0.01  # of a frequency, chosen: so near is the same mode


class Found(NamedTuple):
    """One record identified."""

    kind: str
    frequencies: tuple[float, ...]  # Hz, of the modes in the model
    true: FreeMode | None
    z: NDArray[np.float64]  # errors of com and inertia in stated sd
    trust: Trust
    may_hang: bool = False  # it states that a part that sags may hang

    @property
    def is_found(self) -> bool:
        """Whether the mode that is there is in the model."""
        assert self.true is not None
        return any(abs(f / self.true.frequency - 1) < NEAR for f in self.frequencies)

    @property
    def is_wrong(self) -> bool:
        """Whether a number errs by far more than it says, and nothing warns of it."""
        stated = self.trust in {Trust.TRUSTWORTHY, Trust.WIDENED}
        return stated and not self.may_hang and bool(np.any(np.abs(self.z) > WRONG))


def with_part(rng: np.random.Generator, kind: str) -> tuple[oracle.Platform, flexible.Part]:
    """Return a random platform with a part; one that the part does not fit is left out."""
    make = flexible.wheel if kind == "wheel" else flexible.pendulum
    while True:
        platform = oracle.random_platform(rng, mass=14.0, masses_per_axis=1, tilt=np.radians(3))
        part = make(rng, platform)
        if flexible.is_sound(platform, [part]):
            return platform, part


def strength_of(run: flexible.FlexibleRun, mode: FreeMode, part: flexible.Part) -> float:
    """Return S of a run."""
    shown = np.linalg.solve(run.run.platform.inertia_P, mode.coupling) * part.moment**0.5
    turning = run.turning[oracle.every(run.run, 50.0), 0]
    return float((shown @ shown) * np.sum((turning - turning.mean()) ** 2) / NOISE**2)


def as_strong(
    platform: oracle.Platform, part: flexible.Part, mode: FreeMode, wanted: float
) -> flexible.Part:
    """Return a wheel that begins so far turned that it shows as strongly as wanted."""
    probe = flexible.simulate(platform, [replace(part, angle=1e-3)], (), 30.0)
    return replace(part, angle=1e-3 * (wanted / strength_of(probe, mode, part)) ** 0.5)


def simulated(kind: str, seed: int) -> tuple[oracle.OracleRun, FreeMode | None]:
    """Return a platform's run, and its mode."""
    rng = np.random.default_rng([seed, 41])
    ramp = oracle.Ramp(MOVED, np.full(3, 0.012))
    if kind == "rigid":
        platform = oracle.random_platform(rng, mass=14.0, masses_per_axis=1, tilt=np.radians(3))
        return oracle.simulate(platform, (ramp,), SPAN), None
    platform, part = with_part(rng, kind)
    mode = flexible.mode_of(part, platform)
    if kind == "wheel":
        wanted = np.exp(rng.uniform(np.log(FLOOR), np.log(STRONGEST)))
        part = as_strong(platform, part, mode, wanted)
    return flexible.simulate(platform, [part], (ramp,), SPAN).run, mode


def recorded(run: oracle.OracleRun, seed: int) -> tuple[Recording, Testbed]:
    """Return what the sensors recorded, and what is known beforehand."""
    rng = np.random.default_rng([seed, 42])
    recording = oracle.sensor_log(run, rng, 10.0, CAMERA, 50.0, NOISE)
    camera, gyro = AttitudeSensor(10.0, CAMERA), Gyro(50.0, NOISE, np.radians(0.1))
    return recording, oracle.testbed_for(run.platform, rng, attitude=camera, gyro=gyro)


def identified(seed: int) -> Found:
    """Identify one record: of a wheel, a rigid platform or a pendulum in turn."""
    kind = KINDS[seed % len(KINDS)]
    run, mode = simulated(kind, seed)
    recording, testbed = recorded(run, seed)
    *_, last = identify(recording, testbed, IdentifyOptions("trajectory"))
    found = last.estimate
    frequencies = tuple(p.value for p in found.parameters if p.name.endswith("_frequency"))
    z = stated_errors(found, run.platform) if found.outcome.usable else np.full(9, np.nan)
    may_hang = any(r.code is ModeReason.SAG_MAY_HANG for r in found.outcome.reasons)
    return Found(kind, frequencies, mode, z, found.outcome.trust, may_hang)


def rows_of_wheels(runs: Sequence[Found]) -> list[Row]:
    """Return how often the modes of wheels were found, and whether intervals hold with them."""
    share = float(np.mean([run.is_found for run in runs]))
    z = np.array([run.z for run in runs if run.trust is not Trust.NOT_USABLE]).reshape(-1, 9)
    inside = float(np.mean(np.abs(z) < NORMAL_95))
    band = share_band((0.9, 0.99), 0.95, len(runs))
    return [
        at_least(f"wheels found, S from {FLOOR:g} on, of {len(runs)}", share, 0.95),
        between("com and inertia in their 95 % intervals, with wheels", inside, band),
    ]


def rows_of_rigid(runs: Sequence[Found]) -> list[Row]:
    """Return how often a rigid platform was given a mode."""
    false = float(np.mean([bool(run.frequencies) for run in runs]))
    return [at_most(f"modes of rigid platforms, of {len(runs)}", false, 0.02)]


def rows_of_pendulums(runs: Sequence[Found]) -> list[Row]:
    """Return how often an interval that is said to hold does not, by far."""
    wrong = float(np.mean([run.is_wrong for run in runs]))
    quantity = f"pendulums: com or inertia {WRONG:g} sd off without a warning, of {len(runs)}"
    return [at_most(quantity, wrong, 0.0)]


ROWS = {"wheel": rows_of_wheels, "rigid": rows_of_rigid, "pendulum": rows_of_pendulums}


def measure(seeds: Sequence[int], spread: Spread = in_turn) -> Result:
    """Identify one record for each seed."""
    runs = spread(partial(identified), seeds)
    groups = {kind: [run for run in runs if run.kind == kind] for kind in KINDS}
    rows = [row for kind in KINDS if groups[kind] for row in ROWS[kind](groups[kind])]
    claim = (
        "A flexible mode of a platform is found where it shows, and none where there is none; "
        "inertia and centre of mass are inside their intervals all the same. With a hanging mass, "
        "which shows as sag, no number is far off without a warning."
    )
    return Result("modes", claim, tuple(rows), ())
