"""The platform, its masses and its records that several tests share (made by no estimator)."""

from dataclasses import replace

import numpy as np

from equipoise.actuators.sliding_masses import MassMaps, mass_maps
from equipoise.dynamics.propagation import NO_COLUMNS, Columns, Motion, body_of, propagate
from equipoise.dynamics.rigid_body import Body
from equipoise.dynamics.timeline import Timeline, timeline
from equipoise.maths.attitude import exponential, multiply, to_matrix
from equipoise.maths.linalg import unpack_symmetric
from equipoise.model.mass_properties import MassProperties
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import AttitudeSensor, Gyro, SlidingMass, Testbed

MASS, GRAVITY = 14.24, 9.81
INERTIA = np.array([0.3565, 0.5301, 0.8782, -0.0078, 0.0314, 0.0113])  # xx yy zz xy xz yz
COM = np.array([-0.92, -0.1, -79.0]) * 1e-6
RATE = np.array([-0.010, -0.004, 0.011])
ATTITUDE = exponential(np.radians([3.2, -2.4, 40.0]))  # 4 deg of tilt
CAMERA_SD, GYRO_SD = np.radians(0.2), 1e-4
EVERY_TORQUE = np.array(
    [2e-4, 3e-4, 1e-4, 2e-3, 1e-5, -2e-5, 3e-6, 2e-5]  # drags, constant, swirl
    + [3e-7, -2e-7, 4e-7, 1e-7, -5e-7, 1e-8, -2e-8, 5e-9]  # sag (m), drift (m/s)
    + [6e-8, -3e-8, 4e-8]  # warmth (m/K)
)
WARMING = Samples(np.array([0.0, 7.0, 20.0]), np.array([[21.0], [23.5], [22.0]]))  # degC


def sliding_masses(accuracy: float = 0.0, resolution: float = 1e-3) -> tuple[SlidingMass, ...]:
    """Three masses of 15.6 g along x, y and z, +-50 mm, 10 mm/s; stiff, and at once where told."""
    homes = np.array([[0.2, 0, 0.05], [0, 0.2, 0.05], [0, 0, 0.25]])
    return tuple(
        SlidingMass(
            name, 0.0156, home, axis, (-0.05, 0.05), resolution, accuracy, 0.0, 0.01, 0.0, 0.0
        )
        for name, home, axis in zip("xyz", homes, np.eye(3), strict=True)
    )


def rail(mass, home, axis, **more) -> SlidingMass:
    axis = np.asarray(axis, dtype=float)
    plain = SlidingMass(
        "m", mass, np.asarray(home, dtype=float), axis / np.linalg.norm(axis),
        (-0.05, 0.05), 1e-3, 0.0, 0.0, 0.01,
    )  # fmt: skip
    return replace(plain, **more)


SKEW = (
    rail(0.02, [0.2, 0.05, 0.0], [1.0, 0.3, 0.0]),
    rail(0.03, [-0.1, 0.2, 0.1], [0.2, 1.0, -0.4]),
    rail(0.01, [0.0, -0.1, 0.3], [0.3, 0.0, 1.0]),
)


def platform(accuracy: float = 0.0, gyro: bool = False) -> Testbed:
    """The platform as published; the first guess is the truth."""
    return Testbed(
        "test", MassProperties(MASS, COM, unpack_symmetric(INERTIA)), 0.1, np.full(3, 1e-4),
        np.array([0.0, 0.0, 1.0]), np.radians(30), GRAVITY, sliding_masses(accuracy),
        AttitudeSensor(5.0, CAMERA_SD), Gyro(20.0, GYRO_SD, 1e-2) if gyro else None,
    )  # fmt: skip


def platform_with(masses, mass=MASS) -> Testbed:
    """The platform with other masses on rails, of another mass in all (kg)."""
    bed = platform()
    return replace(bed, masses=tuple(masses), body=replace(bed.body, mass=mass))


def level(testbed: Testbed) -> Testbed:
    """The same platform seen by a camera whose vertical is known to be gravity's."""
    return replace(testbed, attitude=replace(testbed.attitude, plumb_sd=0.0))


def guessed_wrong(testbed: Testbed) -> Testbed:
    """The same platform as a drawing might have it: moments 5 to 10 % off, no products, centred."""
    inertia = np.diag(INERTIA[:3] * [1.10, 1.05, 0.95])
    return replace(testbed, body=MassProperties(MASS, np.zeros(3), inertia))


def move_at(start: float, end: float) -> Samples:
    """The masses go from home to (-10, -10, -50) mm at 10 mm/s from ``start`` (s) on."""
    t = np.array([0.0, start, start + 1, start + 5, end])
    d = np.array([[0, 0, 0], [0, 0, 0], [-10, -10, -10], [-10, -10, -50], [-10, -10, -50]])
    return Samples(t, d * 1e-3)


def body(torque: np.ndarray | None = None) -> Body:
    """The platform as the propagator takes it."""
    return body_of(MASS, GRAVITY, INERTIA, MASS * COM, torque)


def maps(masses: tuple[SlidingMass, ...] | None = None) -> MassMaps:
    return mass_maps(sliding_masses() if masses is None else masses)


def line_of(t: np.ndarray, track: Samples | None = None, step: float = 0.05) -> Timeline:
    """A timeline with nodes at t and no step longer than ``step`` (s)."""
    return timeline(t, np.zeros(0), track, 3, step)


def travel(
    line: Timeline, rigid: Body | None = None, columns: Columns = NO_COLUMNS,
    q0: np.ndarray = ATTITUDE, w0: np.ndarray = RATE,
) -> Motion:  # fmt: skip
    """The motion of the shared platform along a timeline."""
    return propagate(body() if rigid is None else rigid, maps(), line, q0, w0, columns)


def recording(
    end: float = 120.0, track: Samples | None = None, camera: float = 5.0, gyro: float = 0.0,
    torque: np.ndarray | None = None,
) -> Recording:  # fmt: skip
    """A record without noise; camera and gyro in Hz, 0 for none."""

    def channel(rate: float, values: str) -> Samples | None:
        if rate == 0:
            return None
        t = np.arange(int(end * rate) + 1) / rate
        line = line_of(t, track)
        return Samples(t, getattr(travel(line, body(torque)), values)[line.attitude_node])

    names = ("x", "y", "z") if track is not None else ()
    return Recording(channel(camera, "q"), channel(gyro, "rate"), names, track)


def noisy(clean: Recording, seed: int, bias: np.ndarray | None = None) -> Recording:
    """The same record as the shared sensors would have seen it."""
    rng = np.random.default_rng(seed)
    attitude, rate = clean.attitude, clean.rate
    if attitude is not None:
        error = exponential(CAMERA_SD * rng.normal(size=(len(attitude), 3)))
        attitude = Samples(attitude.t, multiply(attitude.values, error))
    if rate is not None:
        error = GYRO_SD * rng.normal(size=(len(rate), 3))
        rate = Samples(rate.t, rate.values + error + (0 if bias is None else bias))
    return replace(clean, attitude=attitude, rate=rate)


def camera_says(q: np.ndarray, sensor: np.ndarray, forward: np.ndarray) -> np.ndarray:
    """What a camera makes of attitudes: plumb, and harmonics of the heading of ``forward``.

    ``sensor`` has plumb x, y and then cos 2, sin 2, cos 3, sin 3 times heading, each about x y z.
    """
    p = to_matrix(q) @ forward
    psi = np.arctan2(p[..., 1], p[..., 0])[..., None]
    c2, s2, c3, s3 = sensor[2:14].reshape(4, 3)
    eta = c2 * np.cos(2 * psi) + s2 * np.sin(2 * psi) + c3 * np.cos(3 * psi) + s3 * np.sin(3 * psi)
    return multiply(exponential(np.array([*sensor[:2], 0.0])), multiply(q, exponential(eta)))
