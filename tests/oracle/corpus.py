"""The corpus that judges: one record a seed, over the whole space of platforms and laboratories.

MuJoCo moves the platform; ``corpus_choices`` says what is drawn. The laboratory states its inputs
with an sd, and each is wrong by a normal draw of that sd: masses of the platform and of the
sliders, gravity, clocks, the gyro's zero, the camera's vertical, J and centre of mass beforehand.

A record ends where the tilt exceeds 45 deg. One that would end within 3 s is drawn tamer: com,
tilt and spin are reduced until it lasts. No record has more steps than a few seconds make.
"""

from dataclasses import dataclass, replace

import numpy as np

from equipoise.model.mass_properties import MassProperties, parallel_axis
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import Testbed
from tests.oracle import mujoco_bench as oracle
from tests.oracle import sensors
from tests.oracle.corpus_choices import (
    DURATION,
    WAY_MM,
    Choices,
    MassLog,
    Sensors,
    Shape,
    between,
    choices,
    stream,
)
from tests.oracle.corpus_testbed import (
    BIAS_SD,
    CLOCK_SD,
    GRAVITY,
    GRAVITY_SD,
    PLUMB_SD,
    QUANTUM,
    SERVO,
    exact_testbed,
    stated_testbed,
)
from tests.oracle.defects import Array, Defects

STOP = np.radians(45.0)
STEPS = (5e-3, 2.5e-3, 1e-3)  # s: every sensor's period is a whole number of them
TURN, MOST = 0.03, 720_000  # rad within a step; steps of a run, chosen: 1 h of 5 ms
RAIL = 50.0  # Hz, rows of the encoders


@dataclass(frozen=True, eq=False)
class CorpusRecord:
    """A record, what a laboratory states of it, and what is true."""

    choices: Choices  # as they were drawn; a tamed platform has less com, tilt and spin
    platform: oracle.Platform
    testbed: Testbed  # as stated
    exact: Testbed  # the same sd, every value true
    recording: Recording

    @property
    def truth(self) -> MassProperties:
        """What is to be found: masses at home."""
        return self.exact.body


# --- the platform ---------------------------------------------------------------------------------


def gyration(rng: np.random.Generator, shape: Shape) -> Array:
    """Return the radii of gyration over the greatest of them, (3,)."""
    if shape is Shape.SPHERE:
        return rng.uniform(0.85, 1.0, 3)
    thin = rng.uniform(0.1, 0.25)
    if shape is Shape.DISC:
        return np.array([1.0, rng.uniform(0.9, 1.0), thin])
    along = int(rng.choice([0, 2]))
    return np.where(np.arange(3) == along, 1.0, thin * rng.uniform(0.9, 1.1, 3))


def _bare_inertia(rng: np.random.Generator, drawn: Choices, mass: float, size: float) -> Array:
    """Return the inertia about its centre of what does not slide, axes some degrees off."""
    sigma = mass * (size * gyration(rng, drawn.shape)) ** 2
    R = oracle.matrix(oracle.rotation(rng.normal(0.0, 0.05, 3)))
    return R @ np.diag(sigma.sum() - sigma) @ R.T


def _slides(drawn: Choices, size: float) -> tuple[oracle.Slide, ...]:
    """Return three masses that move com aside by a tenth to a third of its depth: light or heavy.

    The further they go, the lighter they are.
    """
    if drawn.log is MassLog.NONE:
        return ()
    rng = stream(drawn.seed, 1)
    way = 1e-3 * between(rng, WAY_MM)
    shares = np.clip(abs(drawn.depth) * rng.uniform(0.1, 0.33, 3) / way, 1e-4, 0.05)
    homes = size * rng.uniform(0.3, 0.6, 3)[:, None] * np.eye(3)
    return tuple(
        oracle.Slide(f"{letter}1", share * drawn.mass, home, axis, SERVO)
        for letter, share, home, axis in zip("xyz", shares, homes, np.eye(3), strict=True)
    )


def platform_of(drawn: Choices, tame: float = 1.0) -> oracle.Platform:
    """Return the platform as it is let go; ``tame`` times the com, tilt and spin."""
    rng, start = stream(drawn.seed, 2), stream(drawn.seed, 3)
    size = rng.uniform(0.25, 0.5) * (drawn.mass / 14.0) ** (1 / 3)
    slides = _slides(drawn, size)
    com = tame * drawn.depth * np.array([*rng.uniform(-0.2, 0.2, 2), -1.0])
    mass = drawn.mass - sum(s.mass for s in slides)
    rest = drawn.mass * com - sum((s.mass * s.home for s in slides), np.zeros(3))
    inertia = _bare_inertia(rng, drawn, mass, size) + parallel_axis(mass, rest / mass)
    for s in slides:
        inertia = inertia + parallel_axis(s.mass, s.home) + oracle.POINT * np.eye(3)
    way, heading = start.uniform(0, 2 * np.pi, 2)
    lean = tame * np.radians(drawn.tilt) * np.array([np.cos(way), np.sin(way), 0.0])
    q = oracle.product(oracle.rotation(lean), oracle.rotation(np.array([0.0, 0.0, heading])))
    rate = tame * np.radians([*start.uniform(-0.5, 0.5, 2), drawn.spin])
    drag = drawn.drag * np.diag(inertia)
    gravity = GRAVITY * (1 + GRAVITY_SD * start.normal())
    return oracle.Platform(drawn.mass, inertia, com, slides, gravity, q, rate, drag)


# --- the run --------------------------------------------------------------------------------------


def moves_of(drawn: Choices, platform: oracle.Platform) -> tuple[oracle.Ramp, ...]:
    """Return moves of all masses, to whole steps of the log, spread over the record."""
    if not platform.slides:
        return ()
    rng = stream(drawn.seed, 4)
    way = 1e-3 * between(stream(drawn.seed, 1), WAY_MM)  # that which the masses were chosen for
    part = drawn.duration / (drawn.moves + 1)
    speed = max(drawn.speed, oracle.PEAK * 4 * way / part)  # done before half of a part is over
    ramps: list[oracle.Ramp] = []
    for k in range(drawn.moves):
        sides = rng.choice([-1.0, 1.0], 3) if not k % 2 else np.zeros(3)
        targets = QUANTUM * np.round(sides * way / QUANTUM)
        start = part * (k + 1 + rng.uniform(-0.2, 0.2))
        ramps.append(oracle.Ramp(start, targets, speed))
    return tuple(ramps)


def step_of(drawn: Choices, platform: oracle.Platform) -> float:
    """Return the longest step (s) within which nothing turns far and sensors have their rows."""
    least = float(np.linalg.eigvalsh(platform.inertia_P)[0])
    swing = np.sqrt(platform.mass * platform.gravity * np.linalg.norm(platform.com) / least)
    quick = max(float(swing), float(np.linalg.norm(platform.rate)))
    return next((dt for dt in STEPS if quick * dt <= TURN), STEPS[-1])


def until_stop(run: oracle.OracleRun) -> oracle.OracleRun:
    """Return the part of a run before its tilt exceeds 45 deg."""
    over = 1 - 2 * (run.q[:, 1] ** 2 + run.q[:, 2] ** 2) < np.cos(STOP)
    end = int(np.argmax(over)) if over.any() else len(over)
    columns = ("t", "q", "rate", "displacement", "velocity", "com")
    return replace(run, **{name: getattr(run, name)[:end] for name in columns})


def run_of(drawn: Choices) -> tuple[oracle.OracleRun, tuple[oracle.Ramp, ...]]:
    """Return what happened, of a platform tame enough to last for 3 s, and its moves."""
    tame = 1.0
    while True:
        platform = platform_of(drawn, tame)
        dt, first = step_of(drawn, platform), DURATION[0]
        start = until_stop(oracle.simulate(platform, (), first, dt, locked=not platform.slides))
        if start.t[-1] >= first - dt:
            break
        tame *= 0.7
    duration = dt * min(int(drawn.duration / dt), MOST)
    moves = moves_of(drawn, platform)
    whole = oracle.simulate(platform, moves, duration, dt, locked=not platform.slides)
    return until_stop(whole), moves


# --- what the laboratory records ------------------------------------------------------------------


def _masses(
    drawn: Choices, run: oracle.OracleRun, moves: tuple[oracle.Ramp, ...]
) -> Samples | None:
    """Return the rows of the masses, as this laboratory logs them."""
    if drawn.log is MassLog.NONE:
        return None
    rate = drawn.rates[0] if drawn.log is MassLog.STEPS else RAIL
    if drawn.log is MassLog.COMMAND:
        return sensors.where_masses_were_sent(run, moves, drawn.rates[0])
    rows = sensors.where_masses_are(run, rate)
    if drawn.log is MassLog.STEPS:
        return Samples(rows.t, QUANTUM * np.round(rows.values / QUANTUM))
    return Samples(rows.t + drawn.late, rows.values) if drawn.log is MassLog.LATE else rows


def slower(channel: Samples | None, clock: float) -> Samples | None:
    """Return a channel on a clock that is fast by ``clock`` (relative)."""
    return channel and Samples(channel.t * (1 + clock), channel.values)


def recording_of(
    drawn: Choices, run: oracle.OracleRun, moves: tuple[oracle.Ramp, ...]
) -> Recording:
    """Return what is recorded; the camera's clock, or that of a gyro alone, dates all channels."""
    noise, wrong = stream(drawn.seed, 5), stream(drawn.seed, 6)
    defects = Defects(
        plumb=PLUMB_SD * wrong.normal(size=2), gyro_bias=BIAS_SD * wrong.normal(size=3)
    )
    clocks = CLOCK_SD * wrong.normal(size=2)
    attitude = rate = None
    if drawn.sensors is not Sensors.GYRO:
        sd = float(np.radians(drawn.camera_deg))
        attitude = sensors.camera(run, noise, drawn.camera_hz, sd, defects).attitude
    if drawn.sensors is not Sensors.CAMERA:
        rate = sensors.gyro(run, noise, drawn.gyro_hz, np.radians(drawn.gyro_deg_s), defects)
    beside = clocks[1] if attitude is not None else 0.0
    return Recording(
        slower(attitude, clocks[0]),
        slower(slower(rate, beside), clocks[0]),
        tuple(s.name for s in run.platform.slides),
        slower(_masses(drawn, run, moves), clocks[0]),
        source=f"MuJoCo, corpus, seed {drawn.seed}",
    )


def corpus_record(seed: int) -> CorpusRecord:
    """Return the record of a seed."""
    drawn = choices(seed)
    run, moves = run_of(drawn)
    exact = exact_testbed(drawn, run.platform)
    recording = recording_of(drawn, run, moves)
    return CorpusRecord(drawn, run.platform, stated_testbed(drawn, exact), exact, recording)
