"""From the record of a bench to the Sample that a law receives."""

from dataclasses import dataclass

import numpy as np

from equipoise.actuators.jets import on_platform
from equipoise.actuators.sliding_masses import shift_by
from equipoise.control.law import Sample
from equipoise.estimation.motion.attitude_filter import AttitudeState, followed
from equipoise.maths.attitude import to_matrix
from equipoise.model.arrays import Floats, Vector3
from equipoise.model.devices import CoilPair, JetPair, at_start
from equipoise.model.errors import InputError
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import Testbed


@dataclass(frozen=True, slots=True, eq=False)
class Eyes:
    """The state that is carried from one sample to the next."""

    attitude: AttitudeState | None
    displacement: Floats  # m, (k,) as last reported
    states: Floats  # (n,) what the devices last reported
    momentum: Vector3  # N m s, stored
    t: float  # s, of that momentum
    field: Vector3 | None  # T, magnetic, body axes; None: not known


def opened(testbed: Testbed) -> Eyes:
    """Return the state before the first record."""
    masses, states = len(testbed.masses), np.array([at_start(each) for each in testbed.devices])
    return Eyes(None, np.zeros(masses), states, np.zeros(3), 0.0, None)


def last_row(channel: Samples | None, before: Floats) -> Floats:
    """Return a channel's last row, or what was known before."""
    return before if channel is None or not len(channel) else channel.values[-1]


def sampled(eyes: Eyes, fresh: Recording, testbed: Testbed) -> Eyes:
    """Return the state after a fresh record."""
    stored, attitude = fresh.momentum, followed(eyes.attitude, fresh, testbed)
    states = last_row(fresh.devices, eyes.states)
    return Eyes(
        attitude,
        last_row(fresh.masses, eyes.displacement),
        states,
        last_row(stored, eyes.momentum),
        eyes.t if stored is None or not len(stored) else float(stored.t[-1]),
        field_of(attitude, fresh, testbed, states),
    )


def sample_of(before: Eyes, now: Eyes, fresh: Recording, testbed: Testbed) -> Sample | None:
    """Return the sample after a fresh record; None before the first attitude."""
    if now.attitude is None:
        return None
    vertical = to_matrix(now.attitude.q).T @ np.array([0.0, 0.0, 1.0])
    gap = now.t - before.t
    torque = -(now.momentum - before.momentum) / gap if gap > 0 else np.zeros(3)
    return Sample(
        t=now.attitude.t,
        q=now.attitude.q,
        rate=now.attitude.rate,
        gravity=-testbed.gravity * vertical,
        shift=shift_by(testbed, now.displacement),
        momentum=now.momentum,
        torque=torque,
        impulse=impulse_of(fresh, testbed),
        field=now.field,
    )


def impulse_of(fresh: Recording, testbed: Testbed) -> Vector3:
    """Return the impulse of the jets over a record, N m s, body axes."""
    devices = fresh.devices
    if devices is None or not testbed.jets or len(devices) < 1:
        return np.zeros(3)
    pulses: Floats = _over(devices)[testbed.columns(JetPair)]
    return on_platform(testbed.jets, pulses)


def _over(channel: Samples) -> Floats:
    """Return the sum of means since the row before, times how long that is ago."""
    t, values = channel.t, channel.values
    if len(t) < 2:
        return np.zeros(int(values.shape[1]))
    since: Floats = np.diff(t, prepend=2 * t[0] - t[1])
    whole: Floats = np.sum(since[:, None] * values, axis=0)
    return whole


def field_of(
    attitude: AttitudeState | None, fresh: Recording, testbed: Testbed, states: Floats
) -> Vector3 | None:
    """Return the magnetic field in body axes (T): measured, else the laboratory's, turned.

    That of a cage is as its coils report it among the devices' ``states``.
    """
    if fresh.field is not None and len(fresh.field):
        return fresh.field.values.mean(axis=0)
    known = testbed.field_N(states[testbed.columns(CoilPair)])
    if known is None or attitude is None:
        return None
    turned: Vector3 = to_matrix(attitude.q).T @ known
    return turned


def no_attitude(seconds: float) -> InputError:
    """Return the error of a bench that gave no attitude in so many seconds."""
    found, wanted = f"no attitude in {seconds:g} s", "an attitude sensor that gives rows"
    return InputError("bench", found, wanted)
