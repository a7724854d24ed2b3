"""The platform on its bearing, made of MuJoCo bodies: an independent truth. Development only.

A ball joint at P carries one body with its own centre of mass and inertia; each sliding mass is a
point on a slide joint, held by a stiff position servo that follows a smooth ramp. Nothing here
shares code with ``equipoise.dynamics`` or ``equipoise.estimation``.

Three things that are easily got wrong, and are not here:

- MuJoCo's inertia is about the body's own centre of mass, and quaternions are scalar first.
- ``qvel`` of a ball joint is the angular velocity in *body* axes.
- MuJoCo's frame sensors are one step late; attitude and rate are read from qpos and qvel.

The servos give way: a mass sags by at most g / SERVO^2 = 0.11 mm and lags the ramp by 7 ms. The
run and its log hold where the masses *are*, not where they were told to be.

A disturbing torque is a motor at the bearing whose axis belongs to the laboratory, or, where
thrusters are meant, to the body; viscous drag is the ball joint's damping, one coefficient per body
axis.
"""

# ruff: noqa: PT028 - testbed_for is no test, whatever its name suggests
from dataclasses import dataclass, field
from functools import cached_property

import mujoco
import numpy as np
from mujoco import rollout
from numpy.typing import NDArray

from equipoise.model.mass_properties import MassProperties, is_possible, parallel_axis
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import AttitudeSensor, Gyro, SlidingMass, Testbed

Array = NDArray[np.float64]
SERVO = 300.0  # rad/s, chosen: 0.3 rad per step of 1 ms, far inside RK4's stability
POINT = 1e-12  # kg m^2, chosen: MuJoCo demands inertia of a moving body; subtracted exactly
PEAK = 1.875  # -, greatest slope of the ramp 10 s^3 - 15 s^4 + 6 s^5, at s = 1/2
EYE = np.eye(3)


@dataclass(frozen=True, slots=True, eq=False)
class Slide:
    """A point mass on a rail; part of the platform's total mass."""

    name: str
    mass: float  # kg
    home: Array  # m, from P
    axis: Array  # unit vector
    servo: float = SERVO  # rad/s; the mass lags a ramp by 2 / servo, and sags by g / servo^2


@dataclass(frozen=True, eq=False)
class Platform:
    """The truth, masses at home."""

    mass: float  # kg, everything that floats
    inertia_P: Array  # kg m^2, about P
    com: Array  # m, from P
    slides: tuple[Slide, ...]
    gravity: float  # m/s^2
    q: Array  # initial attitude, scalar first, body to laboratory
    rate: Array  # rad/s, initial, body axes
    viscous: Array = field(default_factory=lambda: np.zeros(3))  # N m s, torque -c_i w_i

    @property
    def tilt(self) -> float:
        """Return the initial angle between the body's z axis and the vertical, rad."""
        return float(np.arccos(np.clip(matrix(self.q)[2, 2], -1.0, 1.0)))

    @cached_property
    def slide_mass(self) -> Array:
        """Return the sliding masses, kg, (k,)."""
        return np.array([s.mass for s in self.slides])

    @cached_property
    def slide_axes(self) -> Array:
        """Return the rails' directions, (k, 3)."""
        return np.array([s.axis for s in self.slides]).reshape(-1, 3)

    @cached_property
    def servos(self) -> Array:
        """Return the servos' frequencies, rad/s, (k,)."""
        return np.array([s.servo for s in self.slides])

    def com_at(self, displacement: Array) -> Array:
        """Return the total centre of mass, m, with the masses displaced (m, (..., k))."""
        return self.com + (displacement * self.slide_mass) @ self.slide_axes / self.mass


@dataclass(frozen=True, slots=True, eq=False)
class Ramp:
    """A commanded move of all masses, together, along one ramp."""

    start: float  # s
    targets: Array  # m, displacement from home, (k,)
    speed: float = 0.010  # m/s, greatest speed of the mass that travels furthest
    even: bool = False  # at constant speed, not smoothly


@dataclass(frozen=True, slots=True, eq=False)
class OracleRun:
    """What really happened, at every step."""

    platform: Platform
    t: Array  # s, (n,)
    q: Array  # (n, 4)
    rate: Array  # rad/s, body axes, (n, 3)
    displacement: Array  # m, where the masses are, (n, k)
    velocity: Array  # m/s, (n, k)
    com: Array  # m, total, masses where they are, (n, 3)


def matrix(q: Array) -> Array:
    """Return R(q), body to laboratory."""
    out = np.empty(9)
    mujoco.mju_quat2Mat(out, np.asarray(q, float))
    return out.reshape(3, 3)


def rotation(vector: Array) -> Array:
    """Return the unit quaternions of rotation vectors (rad, (..., 3))."""
    angle = np.linalg.norm(vector, axis=-1, keepdims=True)
    return np.concatenate([np.cos(angle / 2), np.sinc(angle / (2 * np.pi)) / 2 * vector], axis=-1)


def product(p: Array, q: Array) -> Array:
    """Return the quaternion products p q, (..., 4)."""
    a, u, b, v = p[..., :1], p[..., 1:], q[..., :1], q[..., 1:]
    scalar = a * b - np.sum(u * v, axis=-1, keepdims=True)
    return np.concatenate([scalar, a * v + b * u + np.cross(u, v)], axis=-1)


def angle_between(p: Array, q: Array) -> Array:
    """Return the rotation angles between attitudes, rad; good to 1e-16 near zero."""
    conjugate = p * np.array([1.0, -1.0, -1.0, -1.0])
    return 2 * np.arcsin(np.clip(np.linalg.norm(product(conjugate, q)[..., 1:], axis=-1), 0, 1))


# --- the model ------------------------------------------------------------------------------------


def bare_body(platform: Platform) -> tuple[float, Array, Array]:
    """Return mass, centre of mass and inertia about it of the platform without its slides."""
    slides = platform.slides
    mass = platform.mass - sum(s.mass for s in slides)
    com = (
        platform.mass * platform.com - sum((s.mass * s.home for s in slides), np.zeros(3))
    ) / mass
    points = sum((parallel_axis(s.mass, s.home) + POINT * EYE for s in slides), np.zeros((3, 3)))
    return mass, com, platform.inertia_P - points - parallel_axis(mass, com)


def _text(values: Array) -> str:
    return " ".join(f"{v:.17g}" for v in np.atleast_1d(values))


def _slide_text(slide: Slide, locked: bool) -> str:
    joint = f'<joint name="{slide.name}" type="slide" axis="{_text(slide.axis)}"/>'
    point = f'mass="{slide.mass:.17g}" diaginertia="{_text(np.full(3, POINT))}"'
    return (
        f'<body pos="{_text(slide.home)}">{"" if locked else joint}'
        f'<inertial pos="0 0 0" {point}/></body>'
    )


def _servo_text(slide: Slide) -> str:
    kp, kv = slide.mass * slide.servo**2, 2 * slide.mass * slide.servo  # critically damped
    return f'<position joint="{slide.name}" kp="{kp:.17g}" kv="{kv:.17g}"/>'


def model_text(platform: Platform, dt: float, locked: bool = False) -> str:
    """Return the MuJoCo model; ``locked`` welds the masses at home."""
    mass, com, J = bare_body(platform)
    inertia = J[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
    slides = "\n".join(_slide_text(s, locked) for s in platform.slides)
    servos = "" if locked else "\n".join(_servo_text(s) for s in platform.slides)
    motors = "\n".join(f'<motor jointinparent="bearing" gear="{_text(e)} 0 0 0"/>' for e in EYE)
    return f"""<mujoco model="platform">
<compiler angle="radian" inertiafromgeom="false"/>
<option timestep="{dt:.17g}" gravity="0 0 {-platform.gravity:.17g}" integrator="RK4">
<flag contact="disable" constraint="disable"/></option>
<worldbody><body name="platform">
<joint name="bearing" type="ball" damping="0"/>
<inertial pos="{_text(com)}" mass="{mass:.17g}" fullinertia="{_text(inertia)}"/>
{slides}
</body></worldbody>
<actuator>{servos}{motors}</actuator>
</mujoco>"""


# --- running it -----------------------------------------------------------------------------------


def smooth(share: Array) -> Array:
    """Return the ramp from 0 to 1 that begins and ends without speed and acceleration."""
    return 10 * share**3 - 15 * share**4 + 6 * share**5


def command(platform: Platform, schedule: tuple[Ramp, ...], t: Array) -> Array:
    """Return the commanded displacements at times ``t``, m, (n, k). Ramps may not overlap."""
    out = np.zeros((len(t), len(platform.slides)))
    before = np.zeros(len(platform.slides))
    free_from = 0.0
    for ramp in schedule:
        if ramp.start < free_from:
            raise ValueError(
                f"a ramp starts at {ramp.start} s, the one before ends at {free_from} s"
            )
        way = np.max(np.abs(ramp.targets - before))
        duration = (1.0 if ramp.even else PEAK) * way / ramp.speed
        s = np.clip((t - ramp.start) / duration, 0.0, 1.0)[:, None]
        out += (s if ramp.even else smooth(s)) * (ramp.targets - before)
        before, free_from = ramp.targets, ramp.start + duration
    return out


def _start(platform: Platform, model: mujoco.MjModel, locked: bool) -> Array:
    """Return MuJoCo's initial state; the masses begin at rest where their servos hold them."""
    gravity_B = matrix(platform.q).T @ np.array([0.0, 0.0, -platform.gravity])
    sag = np.array([] if locked else platform.slide_axes @ gravity_B / platform.servos**2)
    data = mujoco.MjData(model)
    data.qpos[:] = np.concatenate([platform.q, sag])
    data.qvel[:] = np.concatenate([platform.rate, np.zeros_like(sag)])
    state = np.empty(mujoco.mj_stateSize(model, mujoco.mjtState.mjSTATE_FULLPHYSICS))
    mujoco.mj_getState(model, data, state, mujoco.mjtState.mjSTATE_FULLPHYSICS)
    return state


def middles(duration: float, dt: float) -> Array:
    """Return the middle of each step, s. A command and a torque are held over a step.

    Taking a ramp's value at the step's beginning would make every move dt / 2 late.
    """
    return (np.arange(round(duration / dt)) + 0.5) * dt


def driven(
    platform: Platform, wanted: Array, torque: Array, dt: float = 1e-3, in_body: bool = False
) -> OracleRun:
    """Run the platform under commands, one row for each step.

    ``wanted`` are displacements, m, (n, k), or (n, 0) to weld the masses at home; ``torque`` acts
    on the platform, N m, (n, 3), in laboratory axes, or in those of the body.
    """
    locked = not wanted.shape[1]
    text = model_text(platform, dt, locked)
    text = text.replace("jointinparent=", "joint=") if in_body else text
    model = mujoco.MjModel.from_xml_string(text)
    model.dof_damping[:3] = platform.viscous
    start = _start(platform, model, locked)
    control = np.hstack([wanted, torque])[None]
    states, _ = rollout.rollout(model, mujoco.MjData(model), start[None], control)
    rows = np.vstack([start, states[0]])
    return _run(platform, np.arange(len(rows)) * dt, rows[:, 1:], wanted.shape[1])


def simulate(
    platform: Platform,
    schedule: tuple[Ramp, ...] = (),
    duration: float = 120.0,
    dt: float = 1e-3,
    locked: bool = False,
) -> OracleRun:
    """Run the platform for ``duration`` seconds; ``locked`` welds the masses at home."""
    if locked and schedule:
        raise ValueError("locked masses cannot be moved")
    t = middles(duration, dt)
    wanted = np.zeros((len(t), 0)) if locked else command(platform, schedule, t)
    return driven(platform, wanted, np.zeros((len(t), 3)), dt)


def _run(platform: Platform, t: Array, rows: Array, free: int) -> OracleRun:
    """Cut MuJoCo's rows [q, slides, rate, slide rates] into columns."""
    q, d, rate, velocity = np.split(rows[:, : 7 + 2 * free], [4, 4 + free, 7 + free], axis=1)
    if not free:
        d = velocity = np.zeros((len(t), len(platform.slides)))
    return OracleRun(platform, t, q, rate, d, velocity, platform.com_at(d))


# --- random platforms -----------------------------------------------------------------------------


def _box_inertia(rng: np.random.Generator, mass: float) -> Array:
    """Return the inertia about its centre of mass of forty equal points strewn in a random box.

    Sides 0.40-0.70 m at 14 kg, growing with the cube root of the mass: neither flat nor a needle.
    """
    sides = rng.uniform(0.40, 0.70, 3) * (mass / 14.0) ** (1 / 3)
    points = rng.uniform(-0.5, 0.5, (40, 3)) * sides
    points -= points.mean(axis=0)
    return sum((parallel_axis(mass / 40, p) for p in points), np.zeros((3, 3)))


def _random_slides(rng: np.random.Generator, mass: float, per_axis: int) -> tuple[Slide, ...]:
    """Return one or two masses per axis, on rails up to some degrees off the body's axes."""
    reach = 0.20 * (mass / 14.0) ** (1 / 3)
    skewed = np.array([matrix(rotation(rng.normal(0, 0.03, 3)))[:, i] for i in range(3)])
    each = rng.uniform(0.001, 0.0025, 3) * mass / per_axis
    slides = []
    for side in range(per_axis):
        for i, letter in enumerate("xyz"):
            home = (-1) ** side * reach * EYE[i] + rng.uniform(-0.05, 0.05, 3)
            slides.append(Slide(f"{letter}{side + 1}", each[i], home, skewed[i]))
    return tuple(slides)


def _random_com(rng: np.random.Generator) -> Array:
    """Return 40-150 um below P, and aside by up to 30 um but never over a quarter of that."""
    below = rng.uniform(40e-6, 150e-6)
    aside = min(30e-6, 0.25 * below)
    return np.array([*rng.uniform(-aside, aside, 2), -below])


def _random_start(rng: np.random.Generator, tilt: float) -> tuple[Array, Array]:
    """Return attitude (any heading, this tilt) and rate, rad/s: below 2 deg/s, with some spin."""
    way, heading = rng.uniform(0, 2 * np.pi, 2)
    lean = rotation(tilt * np.array([np.cos(way), np.sin(way), 0.0]))
    q = product(lean, rotation(np.array([0.0, 0.0, heading])))
    spin = rng.choice([-1.0, 1.0]) * np.deg2rad(rng.uniform(0.5, 1.5))  # Jzz is seen by it alone
    swing = np.deg2rad(rng.uniform(-0.9, 0.9, 2))
    return q, matrix(q).T @ np.array([*swing, spin])


def random_platform(
    rng: np.random.Generator,
    mass: float | None = None,
    masses_per_axis: int | None = None,
    tilt: float | None = None,
) -> Platform:
    """Return a physically possible platform of 4-40 kg with three or six sliding masses.

    The masses are 0.1-0.25 % of the total on each axis; the start is tilted by 3-10 deg.
    """
    mass = float(np.exp(rng.uniform(np.log(4.0), np.log(40.0)))) if mass is None else mass
    per_axis = int(rng.integers(1, 3)) if masses_per_axis is None else masses_per_axis
    tilt = np.deg2rad(rng.uniform(3.0, 10.0)) if tilt is None else tilt
    slides = _random_slides(rng, mass, per_axis)
    com = _random_com(rng)
    bare = mass - sum(s.mass for s in slides)
    bare_com = (mass * com - sum((s.mass * s.home for s in slides), np.zeros(3))) / bare
    inertia_P = _box_inertia(rng, bare) + parallel_axis(bare, bare_com)
    inertia_P = inertia_P + sum(
        (parallel_axis(s.mass, s.home) + POINT * EYE for s in slides), np.zeros((3, 3))
    )
    q, rate = _random_start(rng, tilt)
    return Platform(mass, inertia_P, com, slides, 9.81, q, rate)


def random_schedule(
    rng: np.random.Generator, platform: Platform, duration: float = 120.0, moves: int | None = None
) -> tuple[Ramp, ...]:
    """Return one move at 40 % of the run, or two, at 35 and 65 %: 10-50 mm of every mass.

    The platform must stay stable: 40-300 um below, and aside by at most a quarter of that.
    """
    moves = int(rng.integers(1, 3)) if moves is None else moves
    starts = {1: (0.40,), 2: (0.35, 0.65)}[moves]
    return tuple(Ramp(share * duration, _stable_targets(rng, platform)) for share in starts)


def movable_platform(
    rng: np.random.Generator, duration: float = 120.0
) -> tuple[Platform, tuple[Ramp, ...]]:
    """Return a random platform and a random schedule; one that has no stable move is left out."""
    for _ in range(100):
        platform = random_platform(rng)
        try:
            return platform, random_schedule(rng, platform, duration)
        except RuntimeError:
            continue
    raise RuntimeError("no stable move found for any of 100 platforms")


def _stable_targets(rng: np.random.Generator, platform: Platform) -> Array:
    k = len(platform.slides)
    for _ in range(10_000):
        targets = rng.choice([-1.0, 1.0], k) * rng.uniform(0.010, 0.050, k)
        com = platform.com_at(targets)
        if 40e-6 <= -com[2] <= 300e-6 and np.hypot(com[0], com[1]) <= -0.25 * com[2]:
            return targets
    raise RuntimeError(f"no stable move found for a platform with com {platform.com} m")


# --- what the laboratory gets to see --------------------------------------------------------------


def every(run: OracleRun, rate: float) -> slice:
    """Return the rows of a sensor at ``rate`` (Hz); its period must be whole steps."""
    dt = run.t[1] - run.t[0]
    stride = round(1 / (rate * dt))
    if abs(stride * rate * dt - 1) > 1e-9:
        raise ValueError(f"{rate} Hz is not a whole number of steps of {dt} s")
    return slice(None, None, stride)


def sensor_log(  # noqa: PLR0913, PLR0917 - each is a number of a sensor
    run: OracleRun,
    rng: np.random.Generator,
    attitude_rate: float = 5.0,
    attitude_noise_rad: float = np.deg2rad(0.2),
    gyro_rate: float | None = None,
    gyro_noise: float = 0.0,
    gyro_bias: Array | None = None,
    mass_rate: float = 50.0,
) -> Recording:
    """Return what camera, gyro (if it has a rate) and mass encoders record; rates in Hz, SI else.

    The attitude's noise is a small rotation in body axes. Displacements are exact.
    """
    camera, encoder = every(run, attitude_rate), every(run, mass_rate)
    noise = rng.normal(0.0, attitude_noise_rad, run.q[camera].shape[:1] + (3,))
    attitude = Samples(run.t[camera].copy(), product(run.q[camera], rotation(noise)))
    rate = None
    if gyro_rate is not None:
        rows = every(run, gyro_rate)
        bias = np.zeros(3) if gyro_bias is None else gyro_bias
        observed = run.rate[rows] + bias + rng.normal(0.0, gyro_noise, run.rate[rows].shape)
        rate = Samples(run.t[rows].copy(), observed)
    return Recording(
        attitude=attitude,
        rate=rate,
        mass_names=tuple(s.name for s in run.platform.slides),
        masses=Samples(run.t[encoder].copy(), run.displacement[encoder].copy()),
        source="MuJoCo",
    )


def wrong_inertia(rng: np.random.Generator, platform: Platform, error: float) -> MassProperties:
    """Return a guess: moments wrong by up to ``error``, no products, com (0, 0, -100) um."""
    com = np.array([0.0, 0.0, -100e-6])
    for _ in range(10_000):
        moments = np.diag(platform.inertia_P) * (1 + rng.uniform(-error, error, 3))
        guess = MassProperties(platform.mass, com, np.diag(moments))
        if is_possible(guess):
            return guess
    raise RuntimeError(f"no possible inertia within {error:.0%} of {np.diag(platform.inertia_P)}")


def testbed_for(  # noqa: PLR0913, PLR0917 - each is a line of the testbed
    platform: Platform,
    rng: np.random.Generator,
    inertia_error: float = 0.10,
    attitude: AttitudeSensor | None = None,
    gyro: Gyro | None = None,
    mass_accuracy: float = 0.0,
) -> Testbed:
    """Return what a laboratory would know beforehand: mass, rails, sensors, and a wrong guess.

    The recorded displacements are exact: the stated accuracy of the masses is 0 unless given (m).
    """
    masses = tuple(
        SlidingMass(s.name, s.mass, s.home, s.axis, (-0.06, 0.06), 0.0, mass_accuracy, 0.0, 0.010)
        for s in platform.slides
    )
    return Testbed(
        name="MuJoCo",
        body=wrong_inertia(rng, platform, inertia_error),
        inertia_sd=inertia_error,
        com_sd=np.full(3, 50e-6),
        up=np.array([0.0, 0.0, 1.0]),
        tilt_limit=float(np.deg2rad(60.0)),
        gravity=platform.gravity,
        masses=masses,
        attitude=attitude,
        gyro=gyro,
    )


testbed_for.__test__ = False  # pytest would take its name for a test's
