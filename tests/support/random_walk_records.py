"""Records of a platform whose centre of mass walks and on which a torque plays, as filters assume.

The torque is drawn at every node and given to the propagator as a known one; the walk of the centre
of mass is made by the sliding masses. Neither is in the record.
"""

from dataclasses import replace

import numpy as np

from equipoise.actuators.sliding_masses import com_shift
from equipoise.dynamics.propagation import propagate
from equipoise.dynamics.timeline import straight_lines, timeline
from equipoise.estimation.filters.model import Walks
from equipoise.maths.linalg import element_sizes, unpack_symmetric
from equipoise.model.mass_properties import MassProperties
from equipoise.model.recording import Recording, Samples
from tests.support.builders import (
    ATTITUDE,
    COM,
    INERTIA,
    MASS,
    RATE,
    body,
    maps,
    noisy,
    platform,
)

WALKS = Walks()
TICK = 0.05  # s


def square_waves(end: float, size: float = 1e-2, period: float = 4.0) -> Samples:
    """Known torques of +-10 mN m about x, y and z, of different periods."""
    t = np.arange(0, end + 1e-9, 0.01)
    waves = [np.sign(np.sin(2 * np.pi * t / (period * k) + 0.1 * k)) for k in (1, 1.3, 1.7)]
    return Samples(t, size * np.column_stack(waves))


def walked(
    seed: int, end: float = 60.0, torque: Samples | None = None, track: Samples | None = None
):
    """A noisy record (5 Hz camera, 20 Hz gyro), and where the centre of mass is at the end."""
    rng = np.random.default_rng(seed)
    t = np.arange(0, end + 1e-9, TICK)
    push = rng.normal(size=(len(t), 3)) * WALKS.torque / TICK**0.5
    steps = rng.normal(size=(len(t), 3)) * WALKS.com * TICK**0.5
    d = np.cumsum(steps, axis=0) * MASS / 0.0156
    moved = straight_lines(track, t, 3) + d
    given = Samples(t, push)
    if torque is not None:
        fine = np.unique(np.concatenate([t, torque.t]))
        total = straight_lines(given, fine, 3) + straight_lines(torque, fine, 3)
        given = Samples(fine, total)
    line = timeline(np.zeros(0), t, Samples(t, moved), 3, 1.0, None, given)
    motion = propagate(body(), maps(), line, ATTITUDE, RATE)
    q, w = motion.q[line.rate_node], motion.rate[line.rate_node]
    names = ("x", "y", "z") if track is not None else ()
    clean = Recording(Samples(t[::4], q[::4]), Samples(t, w), names, track, torque=torque)
    return noisy(clean, seed), COM + com_shift(maps(), MASS, d[-1])


def guessed(seed: int, inertia_sd: float, com_sd: float = 1e-4):
    """The platform as known beforehand: off by what it says, drawn."""
    rng = np.random.default_rng(1000 + seed)
    testbed = replace(platform(gyro=True), inertia_sd=inertia_sd, com_sd=np.full(3, com_sd))
    off = rng.normal(size=6) * inertia_sd * element_sizes(unpack_symmetric(INERTIA))
    com = COM + com_sd * rng.normal(size=3)
    level = replace(testbed.attitude, plumb_sd=0.0)
    body = MassProperties(MASS, com, unpack_symmetric(INERTIA + off))
    return replace(testbed, body=body, attitude=level)
