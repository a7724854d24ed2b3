"""Records as other laboratories make them, by MuJoCo: fast spins, large tilts, gyros alone, gaps.

    spun        a few kg at 280 deg/s about the vertical, camera 100 Hz, drag
    tilted      swings from 20 deg of tilt and more, masses moved
    tumbling    a gyro alone, 20 Hz in steps of 1/16 deg/s, for minutes
    in_a_plane  a pendulum that hardly turns about the vertical
    at_rest     let go where it rests
    silent      any record without the sensors' rows in some gaps
    motored     a fan or motor about body z, whose torque nobody tells the estimator

The inertia that is believed beforehand is wrong by 20 %, drawn from the seed.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from equipoise.model.mass_properties import MassProperties
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import AttitudeSensor, Gyro, Testbed
from tests.oracle import mujoco_bench as oracle
from tests.oracle import sensors
from tests.oracle.defects import SIXTEENTH, Array, Defects

DOUBT = 0.20  # of each moment
CAMERA = AttitudeSensor(5.0, float(np.deg2rad(0.2)))
FAST = AttitudeSensor(100.0, float(np.deg2rad(0.05)))
NOISE = float(np.deg2rad(0.05))  # rad/s, of a low-cost gyro
Torque = Callable[[Array], Array]  # of time (s), N m


@dataclass(frozen=True, eq=False)
class Record:
    """A record, what is known beforehand, and what is true."""

    platform: oracle.Platform
    recording: Recording
    testbed: Testbed

    @property
    def truth(self) -> MassProperties:
        """What is to be found: masses at home."""
        return MassProperties(self.platform.mass, self.platform.com, self.platform.inertia_P)

    def unstated(self) -> "Record":
        """Return the record of a laboratory whose testbed says nothing of its sensors."""
        return replace(self, testbed=replace(self.testbed, attitude=None, gyro=None))

    def knowing(self, *moments: int) -> "Record":
        """Return the record of a laboratory that knows these moments of inertia (0, 1, 2)."""
        body = self.testbed.body
        J = body.inertia_P.copy()
        for k in moments:
            J[k, k] = self.platform.inertia_P[k, k]
        return replace(self, testbed=replace(self.testbed, body=replace(body, inertia_P=J)))


def _streams(seed: int) -> tuple[np.random.Generator, ...]:
    return tuple(np.random.default_rng([seed, k]) for k in range(4))


def _let_go(
    platform: oracle.Platform, lean_deg: float, rate_deg_s: Array, rng: np.random.Generator
) -> oracle.Platform:
    """Return the platform at this tilt, towards anywhere, with these rates in laboratory axes."""
    way, heading = rng.uniform(0, 2 * np.pi, 2)
    lean = np.deg2rad(lean_deg) * np.array([np.cos(way), np.sin(way), 0.0])
    q = oracle.product(oracle.rotation(lean), oracle.rotation(np.array([0.0, 0.0, heading])))
    return replace(platform, q=q, rate=oracle.matrix(q).T @ np.deg2rad(rate_deg_s))


def _observed(
    run: oracle.OracleRun,
    rng: np.random.Generator,
    camera: AttitudeSensor | None,
    gyro: Gyro | None = None,
) -> Recording:
    """Return what the sensors record; a gyro has a bias of 0.1 deg/s or so, and its quantum."""
    log = oracle.sensor_log(run, rng, *((camera.rate, camera.noise) if camera else ()))
    rate = None
    if gyro is not None:
        bias = rng.normal(0.0, np.deg2rad(0.1), 3)
        faults = Defects(gyro_bias=bias, gyro_quantum=gyro.quantum)
        rate = sensors.gyro(run, rng, gyro.rate, gyro.noise, faults)
    masses = log.masses if run.platform.slides else None
    return replace(log, attitude=log.attitude if camera else None, rate=rate, masses=masses)


def spun(
    seed: int, depth: float = 0.010, down: bool = False, duration: float = 40.0, rate: float = 280.0
) -> Record:
    """Return 2.7 kg with its com ``depth`` (m) below P that spins at ``rate`` (deg/s) or down."""
    body, guess, noise, start = _streams(seed)
    products = np.triu(body.uniform(-2e-4, 2e-4, (3, 3)), 1)
    inertia = np.diag([0.028, 0.025, 0.033]) + products + products.T
    com = np.array([*body.uniform(-1e-4, 1e-4, 2), -depth])
    drag = (1.2e-3 if down else 8.5e-5) * body.uniform(0.8, 1.2, 3)
    still = oracle.Platform(2.7, inertia, com, (), 9.81, np.zeros(4), np.zeros(3), drag)
    swing = start.uniform(-4.0, 4.0, 2)
    platform = _let_go(still, start.uniform(2.0, 5.0), np.array([*swing, rate]), start)
    run = oracle.simulate(platform, (), duration, locked=True)
    bed = oracle.testbed_for(platform, guess, DOUBT, FAST)
    rough = replace(bed.body, com=np.array([0.0, 0.0, -depth * guess.uniform(0.8, 1.2)]))
    bed = replace(bed, body=rough, com_sd=np.full(3, 0.3 * depth))
    return Record(platform, _observed(run, noise, FAST), bed)


def _swinging(  # noqa: PLR0913, PLR0917 - each is a choice of a laboratory
    seed: int,
    tilt_deg: float,
    rates_deg_s: Array | None = None,
    duration: float = 120.0,
    moved: bool = True,
    camera: AttitudeSensor | None = CAMERA,
    gyro: Gyro | None = None,
    torque: Torque | None = None,
) -> Record:
    """Return 4-40 kg that swings, with masses moved at 40 % of the record or not."""
    body, guess, noise, start = _streams(seed)
    platform = oracle.random_platform(body, masses_per_axis=1)
    if rates_deg_s is None:
        rates_deg_s = np.array([*start.uniform(-0.9, 0.9, 2), start.uniform(0.5, 1.5)])
    platform = _let_go(platform, tilt_deg, rates_deg_s, start)
    moves = oracle.random_schedule(body, platform, duration, 1) if moved else ()
    run = _driven(platform, moves, duration, torque)
    bed = oracle.testbed_for(platform, guess, DOUBT, camera, gyro)
    return Record(platform, _observed(run, noise, camera, gyro), bed)


def tilted(seed: int, tilt_deg: float = 20.0, **how: object) -> Record:
    """Return swings from a tilt (deg) with the usual rates."""
    return _swinging(seed, tilt_deg, **how)  # pyright: ignore[reportArgumentType]


def tumbling(  # noqa: PLR0913, PLR0917 - each is a number of the gyro or of the motion
    seed: int,
    duration: float = 300.0,
    noise: float = NOISE,
    stated: float = NOISE,
    quantum: float = SIXTEENTH,
    reported: bool = True,
    moved: bool = False,
    spin: float = 3.0,
) -> Record:
    """Return slow tumbling measured by a gyro alone, 20 Hz in steps; ``reported``: they are known.

    ``noise`` is what the gyro has before rounding, ``stated`` what the testbed says (rad/s).
    """
    gyro = Gyro(20.0, noise, float(np.deg2rad(1.0)), quantum=quantum)
    start = _streams(seed)[3]
    rates = np.array([*start.uniform(-2.0, 2.0, 2), spin * start.uniform(0.7, 1.3)])
    made = _swinging(seed, float(start.uniform(5.0, 10.0)), rates, duration, moved, None, gyro)
    known = replace(gyro, noise=stated, quantum=quantum if reported else 0.0)
    return replace(made, testbed=replace(made.testbed, gyro=known))


def in_a_plane(seed: int, yaw_deg_s: float = 0.0, **how: object) -> Record:
    """Return a pendulum let go at 8 deg without rates but this slow one about the vertical."""
    return _swinging(seed, 8.0, np.array([0.0, 0.0, yaw_deg_s]), **how)  # pyright: ignore[reportArgumentType]


def at_rest(seed: int, moved: bool = False, rate_deg_s: float = 0.0) -> Record:
    """Return a platform let go where it rests, hardly turning."""
    body, guess, noise, start = _streams(seed)
    platform = oracle.random_platform(body, masses_per_axis=1)
    down = -platform.com / np.linalg.norm(platform.com)  # body axis along the vertical, up
    axis = np.cross(down, [0.0, 0.0, 1.0])
    q = oracle.rotation(axis / np.linalg.norm(axis) * np.arccos(down[2]))
    rate = np.deg2rad(rate_deg_s) * start.uniform(-1.0, 1.0, 3)
    platform = replace(platform, q=q, rate=rate)
    moves = oracle.random_schedule(body, platform, 120.0, 1) if moved else ()
    run = oracle.simulate(platform, moves, 120.0)
    bed = oracle.testbed_for(platform, guess, DOUBT, CAMERA)
    return Record(platform, _observed(run, noise, CAMERA), bed)


def silent(record: Record, *gaps: tuple[float, float]) -> Record:
    """Return a record without the rows of camera and gyro within these times (s)."""

    def without(channel: Samples | None) -> Samples | None:
        if channel is None:
            return None
        keep = np.ones(len(channel), bool)
        for start, end in gaps:
            keep &= (channel.t < start) | (channel.t > end)
        return Samples(channel.t[keep], channel.values[keep])

    recording = record.recording
    parts = without(recording.attitude), without(recording.rate)
    return replace(record, recording=replace(recording, attitude=parts[0], rate=parts[1]))


# --- motors ---------------------------------------------------------------------------------------


def bang_bang(size: float, period: float = 20.0) -> Torque:
    """Return a torque (N m) that changes its sign every half period (s)."""
    return lambda t: size * np.where((t % period) < 0.5 * period, 1.0, -1.0)


def sine(size: float, period: float = 20.0) -> Torque:
    """Return a torque (N m) that is a sine."""
    return lambda t: size * np.sin(2 * np.pi * t / period)


def sawtooth(size: float, period: float = 40.0) -> Torque:
    """Return a torque (N m) that ramps from -size to size again and again."""
    return lambda t: size * (2 * ((t / period) % 1.0) - 1.0)


def motored(
    seed: int, torque: Torque, tilt_deg: float = 5.0, camera: AttitudeSensor = CAMERA, **how: object
) -> Record:
    """Return an actuated run; the record has no column for what the motor does."""
    return _swinging(seed, tilt_deg, camera=camera, torque=torque, **how)  # pyright: ignore[reportArgumentType]


def _driven(
    platform: oracle.Platform,
    moves: tuple[oracle.Ramp, ...],
    duration: float,
    torque: Torque | None,
    dt: float = 1e-3,
) -> oracle.OracleRun:
    """Run a platform under a torque about body z.

    The bench takes torques in laboratory axes: a first run, with the torque about the vertical,
    says where body z points; nobody knows the torque, so where it really was is as good as any.
    """
    if torque is None:
        return oracle.simulate(platform, moves, duration, dt)
    t = oracle.middles(duration, dt)
    wanted, size = oracle.command(platform, moves, t), torque(t)[:, None]
    first = oracle.driven(platform, wanted, size * [0.0, 0.0, 1.0], dt)
    w, x, y, z = first.q[:-1].T
    up = np.column_stack([2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)])
    return oracle.driven(platform, wanted, size * up, dt)
