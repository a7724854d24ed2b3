"""Records with what goes wrong in laboratories, each made from the same sound one."""

from dataclasses import replace
from functools import cache

import numpy as np

from equipoise.maths.attitude import exponential, multiply
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import AttitudeSensor, Gyro
from tests.support.builders import move_at, noisy, platform, recording

END, CAMERA, GYRO = 40.0, 10.0, 25.0  # s, Hz


def bed(exact: bool = True):
    """The shared platform with sensors of these rates; the first guess of J is the truth."""
    made = platform(accuracy=1e-4)
    gyro = Gyro(GYRO, 1e-4, 1e-2)
    sd = 0.0 if exact else 0.1
    return replace(made, attitude=AttitudeSensor(CAMERA, made.attitude.noise, plumb_sd=0.0),
                   gyro=gyro, inertia_sd=sd)  # fmt: skip


@cache
def sound() -> Recording:
    """Forty seconds with a move, camera and gyro."""
    return noisy(recording(END, move_at(15.0, END), CAMERA, GYRO), 3)


def rows(channel: Samples, keep: np.ndarray) -> Samples:
    return Samples(channel.t[keep], channel.values[keep])


def both(change) -> Recording:
    """Change both sensors by a function of channel and generator."""
    rng, record = np.random.default_rng(5), sound()
    return replace(record, attitude=change(record.attitude, rng), rate=change(record.rate, rng))


def gap() -> Recording:
    return both(lambda c, rng: rows(c, (c.t < 22) | (c.t > 30)))


def dropouts() -> Recording:
    return both(lambda c, rng: rows(c, rng.random(len(c)) > 0.1))


def outliers() -> Recording:
    rng, record = np.random.default_rng(6), sound()
    turn = np.where(rng.random((len(record.attitude), 1)) < 0.05, 1.0, 0.0)
    q = multiply(record.attitude.values, exponential(turn * rng.normal(0, 0.3, (len(turn), 3))))
    odd = np.where(rng.random((len(record.rate), 1)) < 0.05, 1.0, 0.0)
    w = record.rate.values + odd * rng.normal(0, 0.3, record.rate.values.shape)
    return replace(record, attitude=Samples(record.attitude.t, q), rate=Samples(record.rate.t, w))


def sign_flips() -> Recording:
    """The same attitudes: q and -q are one."""
    record = sound()
    signs = np.where(np.random.default_rng(7).random((len(record.attitude), 1)) < 0.5, -1.0, 1.0)
    return replace(record, attitude=Samples(record.attitude.t, signs * record.attitude.values))


def saturated() -> Recording:
    """A gyro that ends at 0.6 deg/s about every axis."""
    record, limit = sound(), np.radians(0.6)
    return replace(record, rate=Samples(record.rate.t, np.clip(record.rate.values, -limit, limit)))


def camera_alone() -> Recording:
    return replace(sound(), rate=None)


def gyro_alone() -> Recording:
    return replace(sound(), attitude=None)


def free() -> Recording:
    return replace(noisy(recording(END, None, CAMERA, GYRO), 4))


def brief() -> Recording:
    return both(lambda c, rng: rows(c, c.t < 0.35))


def at_rest() -> Recording:
    """A platform that stands on its bearing with the air off: nothing moves."""
    record = sound()
    still = np.tile([1.0, 0.0, 0.0, 0.0], (len(record.attitude), 1))
    quiet = Recording(Samples(record.attitude.t, still),
                      Samples(record.rate.t, 0 * record.rate.values))  # fmt: skip
    return noisy(quiet, 8)


AWKWARD = {
    made.__name__: made
    for made in (
        gap, dropouts, outliers, sign_flips, saturated, camera_alone, gyro_alone, free, brief,
        at_rest,
    )
}  # fmt: skip
