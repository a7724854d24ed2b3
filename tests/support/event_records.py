"""A short record in which the rate or the centre of mass jumps, made by the propagator alone."""

from dataclasses import replace

import numpy as np

from equipoise.dynamics.propagation import body_of
from equipoise.dynamics.regressor import N_TORQUES
from equipoise.estimation.parameters.fit_parameters import RATE, R, Unknowns
from equipoise.maths.linalg import element_sizes, unpack_symmetric
from equipoise.maths.pseudo_inertia import from_inertia
from equipoise.model.estimate import COM as COM_NAMES
from equipoise.model.estimate import RATE as RATES
from equipoise.model.mass_properties import MassProperties, parallel_axis
from equipoise.model.recording import Recording, Samples
from equipoise.sensors.camera import N_SENSOR
from tests.support.builders import (
    ATTITUDE,
    COM,
    GRAVITY,
    INERTIA,
    MASS,
    line_of,
    move_at,
    platform,
    travel,
)
from tests.support.builders import RATE as START

END, EVENT = 40.0, 22.03  # s
TRACK = move_at(8.0, END)
INERTIA_SD, COM_SD = 1e-3, 1e-5  # relative, m: bodies that cannot exist are 7 sd away
# names, coordinates, and a size of some sd
KINDS = {
    "impulse": (RATES, RATE, np.array([6e-5, -9e-5, 5e-5])),  # rad/s
    "com_step": (COM_NAMES, R, np.array([5e-8, -4e-8, 6e-8])),  # m
}
SIX = from_inertia(unpack_symmetric(INERTIA) - parallel_axis(MASS, COM))
TRUTH = Unknowns(
    ATTITUDE, START, SIX, COM, np.zeros(N_TORQUES), np.zeros(N_SENSOR), np.zeros(0), np.zeros(3)
)


def reported(rng=None):
    """The platform as it is, or as somebody knows it who is off by the stated sd."""
    six, com = INERTIA, COM
    if rng is not None:
        size = INERTIA_SD * element_sizes(unpack_symmetric(INERTIA))
        six, com = INERTIA + size * rng.normal(size=6), COM + COM_SD * rng.normal(size=3)
    body = MassProperties(MASS, com, unpack_symmetric(six))
    return replace(platform(gyro=True), body=body, inertia_sd=INERTIA_SD, com_sd=np.full(3, COM_SD))


def eventful(touch=0.0, slip=0.0):
    """A record without noise in which the rate and the centre of mass jump at ``EVENT``."""
    t = np.arange(0, END + 1e-9, 0.05)
    before, after = t[t < EVENT], t[t > EVENT]
    first_line = line_of(np.append(before, EVENT), TRACK)
    first = travel(first_line)
    struck = body_of(MASS, GRAVITY, INERTIA, MASS * (COM + slip))
    line = line_of(np.append(EVENT, after), TRACK)
    second = travel(line, struck, q0=first.q[-1], w0=first.rate[-1] + touch)
    k, m = first_line.attitude_node[:-1], line.attitude_node[1:]
    q, w = np.vstack([first.q[k], second.q[m]]), np.vstack([first.rate[k], second.rate[m]])
    return Recording(Samples(t[::4], q[::4]), Samples(t, w), ("x", "y", "z"), TRACK)


def with_event(kind, share=1.0):
    """A record without noise with an event of one kind."""
    size = share * KINDS[kind][2]
    return eventful(touch=size) if kind == "impulse" else eventful(slip=size)
