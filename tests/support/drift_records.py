"""A record in which the centre of mass wanders, made by the propagator alone, piece by piece."""

import numpy as np

from equipoise.dynamics.propagation import body_of
from equipoise.model.recording import Recording, Samples
from tests.support.builders import ATTITUDE, COM, GRAVITY, INERTIA, MASS, RATE, line_of, travel

PIECE = 0.25  # s, within which com stands still; no move of a whole second falls between two


def random_walk(seed, size, end):
    """How far com is from where it began after each piece; size in m/sqrt(s), one or three."""
    steps = np.random.default_rng(seed).normal(size=(int(end / PIECE) + 1, 3))
    steps[0] = 0.0
    return np.cumsum(size * np.sqrt(PIECE) * steps, axis=0)


def ramp(rate, end):
    """The same at a constant rate (m/s, one an axis)."""
    return PIECE * np.outer(np.arange(int(end / PIECE) + 1), rate)


def wandered(way, track=None, camera=5.0, gyro=20.0):
    """A record without noise; com is off by ``way`` (m) around each multiple of ``PIECE``."""
    end, q, w = PIECE * (len(way) - 1), ATTITUDE, RATE
    edges = np.concatenate([[0.0], PIECE * (np.arange(len(way) - 1) + 0.5), [end]])
    rows = {rate: np.arange(int(end * rate) + 1) / rate for rate in (camera, gyro) if rate > 0}
    found = {rate: [] for rate in rows}
    for k, step in enumerate(way):
        first, last = edges[k], edges[k + 1]
        inside = {r: t[(t >= first) & ((t < last) | (last == end))] for r, t in rows.items()}
        t = np.unique(np.concatenate([[first, last], *inside.values()]))
        line = line_of(t, track)
        struck = body_of(MASS, GRAVITY, INERTIA, MASS * (COM + step))
        motion = travel(line, struck, q0=q, w0=w)
        values = {camera: motion.q, gyro: motion.rate}
        for rate, at in inside.items():
            found[rate].append(values[rate][line.attitude_node[np.searchsorted(t, at)]])
        q, w = motion.q[-1], motion.rate[-1]
    channels = [Samples(rows[r], np.vstack(found[r])) if r > 0 else None for r in (camera, gyro)]
    return Recording(*channels, ("x", "y", "z") if track is not None else (), track)


def com_at(way, t):
    """The true com (m) at times t, masses at home."""
    return COM + way[np.rint(np.asarray(t) / PIECE).astype(int)]
