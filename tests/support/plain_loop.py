"""A platform and a loop around a law, written plainly: no bench, no sensors but noise.

Wheels are ideal within their torque and momentum, masses travel at their speed in whole steps, and
what a law sees is the truth with white noise. Coils give what is across the field.
"""

from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from equipoise.actuators.sliding_masses import MassMaps, com_shift, mass_maps
from equipoise.control.law import Sample
from equipoise.dynamics.propagation import body_of, stacked
from equipoise.dynamics.regressor import N_TORQUES
from equipoise.maths.attitude import exponential, multiply, to_matrix
from equipoise.maths.linalg import cross, pack_symmetric
from equipoise.model.command import Command
from equipoise.model.devices import ReactionWheel
from equipoise.model.following import Following
from equipoise.model.mass_properties import MassProperties
from equipoise.model.reasons.reason import Reason
from equipoise.model.recording import Recording, Samples, window
from equipoise.model.testbed import AttitudeSensor, Gyro, SlidingMass, Testbed
from equipoise.procedure.balancing.run_law import measured_estimate
from equipoise.simulation.motion import run

MASS, GRAVITY = 14.0, 9.81
UP = np.array([0.0, 0.0, 1.0])
INERTIA = np.diag([0.30, 0.28, 0.45])
GYRO_SD = np.radians(0.05)  # at 100 Hz: 0.005 deg/s/sqrt(Hz)
NODES = 0.05  # s, between nodes of the motion


def masses(accuracy: float = 0.0) -> tuple[SlidingMass, ...]:
    """Coarse ones of 200 g in steps of 0.1 mm, fine ones of 20 g in steps of 10 um, 1 mm/s."""
    homes = np.array([[0.2, 0, 0.05], [0, 0.2, 0.05], [0, 0, 0.2]])
    return tuple(
        SlidingMass(f"{kind}_{name}", m, home, axis, (-0.05, 0.05), quantum, accuracy * quantum,
                    0.0, 1e-3, 0.0, 0.0)
        for kind, m, quantum in (("coarse", 0.2, 1e-4), ("fine", 0.02, 1e-5))
        for name, home, axis in zip("xyz", homes, np.eye(3), strict=True)
    )  # fmt: skip


def wheels(torque: float = 5e-3, momentum: float = 0.04) -> tuple[ReactionWheel, ...]:
    return tuple(
        ReactionWheel(f"wheel_{name}", axis, 1e-4, momentum / 1e-4, torque, speed_noise=0.02)
        for name, axis in zip("xyz", np.eye(3), strict=True)
    )


def platform(com_sd: float = 50e-6, disturbances: tuple[str, ...] = ()) -> Testbed:
    return Testbed(
        "plain", MassProperties(MASS, np.zeros(3), INERTIA), 0.05, np.full(3, com_sd), UP,
        np.radians(30), GRAVITY, masses(), AttitudeSensor(5.0, np.radians(0.2), plumb_sd=0.0),
        Gyro(100.0, GYRO_SD, 1e-3), disturbances, wheels=wheels(),
    )  # fmt: skip


@dataclass(frozen=True)
class Truth:
    """What the law is not told."""

    com: np.ndarray  # m, masses at home, at time zero
    inertia: np.ndarray = field(default_factory=lambda: INERTIA * np.array([1.03, 0.98, 1.02]))
    drift: np.ndarray = field(default_factory=lambda: np.zeros(3))  # m/s
    torque: dict[int, float] = field(default_factory=dict)  # coefficients by index
    play: float = 0.0  # N m, correlated over 30 s
    tilt: np.ndarray = field(default_factory=lambda: np.radians([3.0, -2.0, 40.0]))
    rate: np.ndarray = field(default_factory=lambda: np.array([2e-3, -1e-3, 3e-3]))
    field_N: np.ndarray = field(default_factory=lambda: np.zeros(3))  # T
    camera_sd: float = np.radians(0.01)  # rad, of a filtered attitude
    bias: float = 1e-5  # rad/s, that the gyro's is misjudged by
    seed: int = 0


@dataclass
class Now:
    """The platform as it goes."""

    t: float
    y: np.ndarray
    h: np.ndarray
    d: np.ndarray  # m, displacements
    goal: np.ndarray  # m
    requested: np.ndarray | None = None  # m, the shift that the goal is for
    play: np.ndarray = field(default_factory=lambda: np.zeros(3))
    torque: np.ndarray = field(default_factory=lambda: np.zeros(3))  # delivered
    rate: np.ndarray = field(default_factory=lambda: np.zeros(3))


@dataclass
class Course:
    """What happened."""

    testbed: Testbed
    truth: Truth
    now: Now
    t: list[float] = field(default_factory=list)
    q: list[np.ndarray] = field(default_factory=list)
    w: list[np.ndarray] = field(default_factory=list)
    h: list[np.ndarray] = field(default_factory=list)
    tau: list[np.ndarray] = field(default_factory=list)
    d: list[np.ndarray] = field(default_factory=list)
    finished: tuple[Reason, ...] = ()
    following: Following | None = None
    states: list[object] = field(default_factory=list)

    @cached_property
    def maps(self) -> MassMaps:
        return mass_maps(self.testbed.masses)

    @property
    def com(self) -> np.ndarray:
        """Where the centre of mass is now, m."""
        shift = com_shift(self.maps, MASS, self.now.d)
        return self.truth.com + self.truth.drift * self.now.t + shift


def begun(testbed: Testbed, truth: Truth) -> Course:
    q = exponential(truth.tilt)
    y = np.concatenate([q, truth.inertia @ truth.rate])
    k = len(testbed.masses)
    now = Now(0.0, y, np.zeros(3), np.zeros(k), np.zeros(k), rate=truth.rate)
    return Course(testbed, truth, now)


def delivered(course: Course, wanted: np.ndarray | None, dt: float) -> np.ndarray:
    """Torque on the platform by wheels along x, y and z, within what they can."""
    if wanted is None or not course.testbed.wheels:
        return np.zeros(3)
    most = course.testbed.wheels[0].max_torque
    full = course.testbed.wheels[0].inertia * course.testbed.wheels[0].max_speed
    u = np.clip(wanted, -most, most)
    return (course.now.h - np.clip(course.now.h - u * dt, -full, full)) / dt


def targets(bed: Testbed, goal: np.ndarray, shift: np.ndarray) -> np.ndarray:
    """Displacements for a shift, three coarse masses then three fine ones along x, y and z.

    Coarse ones go when fine ones would have to go further than one and a half of their steps.
    """
    coarse, fine = bed.masses[0], bed.masses[3]
    step, small = coarse.mass * coarse.resolution, fine.mass * fine.resolution
    left = MASS * shift - coarse.mass * goal[:3]
    steps = np.where(np.abs(left) > 1.5 * step, np.round(left / step), 0.0)
    left = left - steps * step
    return np.concatenate(
        [goal[:3] + steps * coarse.resolution, np.round(left / small) * fine.resolution]
    )


def moved(d: np.ndarray, goal: np.ndarray, testbed: Testbed, dt: float) -> np.ndarray:
    most = np.array([m.speed for m in testbed.masses]) * dt
    return d + np.clip(goal - d, -most, most)


def magnetic(course: Course, wanted: np.ndarray | None) -> np.ndarray:
    if wanted is None or not course.testbed.magnetorquers:
        return np.zeros(3)
    B = to_matrix(course.now.y[:4]).T @ course.truth.field_N
    most = course.testbed.magnetorquers[0].max_dipole
    dipole = np.clip(cross(B, wanted) / (B @ B), -most, most)
    return cross(dipole, B)


def go(course: Course, command: Command, dt: float, rng: np.random.Generator) -> None:
    """Carry a command for dt seconds; the record grows."""
    now, truth, bed = course.now, course.truth, course.testbed
    shift = command.shift
    if shift is not None and (now.requested is None or np.any(shift != now.requested)):
        now.goal, now.requested = targets(bed, now.goal, shift), shift
    u, coil = delivered(course, command.torque, dt), magnetic(course, command.magnetic)
    stay = np.exp(-dt / 30.0)
    play = stay * now.play + truth.play * np.sqrt(1 - stay**2) * rng.normal(size=3)
    n = max(round(dt / NODES), 1)
    share = np.linspace(0, 1, n + 1)[:, None]
    d = np.array([moved(now.d, now.goal, bed, s * dt) for s in share[:, 0]])
    h, torque = now.h - share * u * dt, coil + now.play + share * (play - now.play)
    terms = np.zeros(N_TORQUES)
    for index, value in truth.torque.items():
        terms[index] = value
    # A mass that stops within a step makes a corner there; its momentum is small.
    moment = MASS * (truth.com + truth.drift * (now.t + 0.5 * dt))
    body = body_of(MASS, GRAVITY, pack_symmetric(truth.inertia), moment, terms)
    t = share[:, 0] * dt
    path = run(
        body, stacked(course.maps), now.y, t, np.hstack([h, torque, np.zeros((len(d), 1)), d])
    )
    for j in range(1 if course.t else 0, n + 1):
        course.t.append(now.t + t[j])
        course.q.append(path.y[j, :4])
        course.w.append(path.rate[j])
        course.h.append(h[j])
        course.tau.append(0 * coil)
        course.d.append(d[j])
    rate = path.rate[-1]
    course.now = replace(
        now, t=now.t + dt, y=path.y[-1], h=h[-1], d=d[-1], play=play, torque=u, rate=rate
    )


def sample(course: Course, period: float, rng: np.random.Generator) -> Sample:
    now, truth, bed = course.now, course.truth, course.testbed
    q = multiply(now.y[:4], exponential(truth.camera_sd * rng.normal(size=3)))
    mean = GYRO_SD / np.sqrt(100.0 * period)
    rate = now.rate + mean * rng.normal(size=3) + truth.bias * np.array([1, -1, 1])
    down = to_matrix(q).T @ np.array([0, 0, -GRAVITY])
    quiet = np.array([w.inertia * w.speed_noise for w in bed.wheels] or [0.0] * 3)
    h, torque = now.h + quiet * rng.normal(size=3), now.torque + quiet * rng.normal(size=3)
    shift = com_shift(course.maps, MASS, now.d)
    B = to_matrix(q).T @ truth.field_N
    return Sample(now.t, q, rate, down, shift, h, torque, np.zeros(3), B)


def measured(course: Course, command: Command, rng: np.random.Generator):
    """Let it swing, and estimate from the record as its sensors would have seen it."""
    measurement, start = command.measurement, course.now.t
    for _ in range(round(measurement.duration / 0.5)):
        go(course, Command(), 0.5, rng)
    since = start if measurement.since is None else measurement.since
    bed = course.testbed
    t, q, w = np.array(course.t), np.array(course.q), np.array(course.w)
    every = round(1 / bed.attitude.rate / NODES)
    tq, q = t[::every], q[::every]
    q = multiply(q, exponential(bed.attitude.noise * rng.normal(size=(len(tq), 3))))
    noise = GYRO_SD * np.sqrt(NODES**-1 / 100.0)
    w = w + noise * rng.normal(size=w.shape)
    record = Recording(
        Samples(tq, q), Samples(t, w), bed.mass_names, Samples(t, np.array(course.d)),
        momentum=Samples(t, np.array(course.h)) if bed.wheels else None,
    )  # fmt: skip
    bed = replace(bed, gyro=replace(bed.gyro, rate=1 / NODES, noise=noise))
    record = window(record, since, course.now.t)
    return measured_estimate(record, bed, measurement)


def close(law, testbed: Testbed, truth: Truth, target: np.ndarray, limit: float) -> Course:
    """Run a law until it has finished or the time (s) is over; return the course."""
    return carried_on(law, law.begin(testbed, target), begun(testbed, truth), limit)


def carried_on(law, beginning: tuple, course: Course, limit: float) -> Course:
    rng = np.random.default_rng(course.truth.seed)
    period = law.card.period
    state, params = beginning
    observed = sample(course, period, rng)
    while course.now.t < limit:
        state, command = law.step(state, observed, params)
        course.states.append(state)
        if command.finished:
            course.finished, course.following = command.finished, command.following
            break
        if command.measurement is not None:
            observed = measured(course, command, rng)
            continue
        go(course, command, period, rng)
        observed = sample(course, period, rng)
    return course
