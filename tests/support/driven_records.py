"""Two minutes under known square-wave torques, made by the propagator, as sensors see it."""

from dataclasses import replace
from functools import cache

import numpy as np

from equipoise.dynamics.propagation import Motion
from equipoise.dynamics.timeline import timeline
from equipoise.maths.attitude import exponential, multiply
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import AttitudeSensor, Gyro, Testbed
from tests.support.builders import body, platform, travel

END, RATE = 120.0, 100.0  # s, Hz
SIZE, PERIODS = 1e-2, (8.0, 11.0, 14.0)  # N m, s: square waves about x, y and z
EDGE = 1e-3  # s, from one value to the other
GYRO_SD, CAMERA_SD = np.radians(0.05), np.radians(0.05)  # 0.005 deg/s/sqrt(Hz)
GYRO_BIAS = np.array([3e-4, -2e-4, 1e-4])


def square_waves(end: float) -> Samples:
    """Cosines cut to their sign: rates are triangles about zero, and turns stay small."""
    edges = [np.arange(0.25 * p, end, 0.5 * p) for p in PERIODS]
    t = np.concatenate([[0.0, end], *(e + side for e in edges for side in (-EDGE / 2, EDGE / 2))])
    t = np.unique(np.clip(t, 0.0, end))
    values = np.column_stack([np.sign(np.cos(2 * np.pi * t / p)) for p in PERIODS])
    return Samples(t, SIZE * values)


@cache
def motion(end: float = END) -> tuple[np.ndarray, Motion]:
    """Return times at 100 Hz and the motion at them."""
    t = np.arange(round(end * RATE)) / RATE
    line = timeline(t, np.zeros(0), None, 3, 0.01, None, square_waves(end))
    whole = travel(line, body())
    return t, Motion(*(values[line.attitude_node] for values in whole[:3]), *whole[3:])


def driven_platform() -> Testbed:
    """The shared platform as a drawing might have it, with a gyro and a camera at 100 Hz."""
    sound = platform()
    wrong = np.diag(np.diag(sound.body.inertia_P) * [1.10, 1.05, 0.95])
    return replace(
        sound,
        body=replace(sound.body, inertia_P=wrong, com=np.zeros(3)),
        masses=(),
        attitude=AttitudeSensor(RATE, CAMERA_SD),
        gyro=Gyro(RATE, GYRO_SD, 1e-2),
    )


def driven(seed: int | None = None, end: float = END) -> Recording:
    """Return the record; without noise for no seed."""
    t, true = motion(end)
    q, w = true.q, true.rate
    if seed is not None:
        rng = np.random.default_rng(seed)
        q = multiply(q, exponential(CAMERA_SD * rng.normal(size=(len(t), 3))))
        w = w + GYRO_BIAS + GYRO_SD * rng.normal(size=w.shape)
    return Recording(Samples(t, q), Samples(t, w), torque=square_waves(end))
