"""Attitude and rate at the gyro's own times: input of the linear methods and of the filters.

A gyro shows motion finely, a camera shows where it is. With both, the gyro leads:

    q(t) = exp(d_N(t)) (x) q_w(t),      q_w' = 1/2 q_w (0, w_meas - b)

b is the gyro's bias, found by least squares from the drift of q_w against the camera; what then is
left of it, d_N, walks slowly in laboratory axes as the gyro's noise makes it, and is smoothed as
such a walk. No window is chosen, and what moves quickly is not blurred by smoothing attitudes.

With a camera alone, attitude and rate are those of ``sampled_motion``. With a gyro alone the
attitude is integrated from level, and the bias stays in the rates: nobody can see them.

A gap of the leading sensor ends a piece: nothing is integrated over it. A gyro alone cannot know
the attitude behind a gap; only the longest piece is used then.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from equipoise.estimation.motion.sampled_motion import integrate_rate, sampled_motion
from equipoise.estimation.motion.sensor_noise import camera_noise, gyro_noise
from equipoise.maths.attitude import conjugate, exponential, level, logarithm, multiply, to_matrix
from equipoise.maths.scaled_solve import scaled_solve
from equipoise.maths.straight_lines import read_at
from equipoise.maths.walk_smoother import smoothed_walk
from equipoise.model.arrays import (
    Bools,
    Floats,
    Ints,
    Quaternion,
    Series1,
    Series3,
    Series4,
    Vector3,
)
from equipoise.model.reasons.estimate_reasons import EstimateReason
from equipoise.model.reasons.reason import Reason
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import Testbed
from equipoise.sensors.timing import measured_at

FEWEST = 5  # rows of a piece, and of a camera in it
GAP, SHORTEST = 5.5, 0.25  # periods and s, chosen: a few missing rows are no gap
PASSES = 2  # of the bias, whose first guess is off by what the camera's rates err
STANDS_OFF = 6.0  # sd of a row against the rest, by the median, beyond which it is left out
MOST = 12000  # rows, chosen: of more, means of neighbours say the same (0.15 s in half an hour)


class LedMotion(NamedTuple):
    """Attitude and rate at common times, in pieces without gaps."""

    t: Series1  # s
    q: Series4
    w: Series3  # rad/s, without bias where a camera shows it
    piece: Ints  # (n,) which piece a row belongs to, from 0
    notes: tuple[Reason, ...] = ()  # what of the record is not used


def pieces_of(t: Series1) -> Ints:
    """Return the piece of every row: a new one begins behind each gap."""
    separation = np.diff(t)
    gap = max(GAP * float(np.median(separation)), SHORTEST) if len(separation) else np.inf
    return np.concatenate([[0], np.cumsum(separation > gap)]).astype(np.int64)


def led_motion(recording: Recording, testbed: Testbed) -> LedMotion:
    """Return attitude and rate; empty when no sensor has enough rows."""
    attitude, rate = (
        None if c is None or len(c) < FEWEST else c for c in (recording.attitude, recording.rate)
    )
    if attitude is None and rate is None:
        return joined([])
    if rate is None:
        return by_camera(recording, testbed)
    t = measured_at(rate.t, testbed.gyro)
    piece, whole = pieces_of(t), Samples(t, rate.values)
    if attitude is None:
        return by_gyro(whole, piece, testbed)
    camera = Samples(measured_at(attitude.t, testbed.attitude), attitude.values)
    parts = [led(whole.where(piece == k), camera, testbed) for k in range(piece[-1] + 1)]
    return thinned(joined([part for part in parts if part is not None]))


def joined(parts: list[LedMotion], notes: tuple[Reason, ...] = ()) -> LedMotion:
    """Return pieces one after the other."""
    if not parts:
        return LedMotion(np.zeros(0), np.zeros((0, 4)), np.zeros((0, 3)), np.zeros(0, np.int64))
    piece = np.repeat(np.arange(len(parts)), [len(part.t) for part in parts])
    t = np.concatenate([part.t for part in parts])
    q = np.concatenate([part.q for part in parts])
    w = np.concatenate([part.w for part in parts])
    return LedMotion(t, q, w, piece, notes)


def by_camera(recording: Recording, testbed: Testbed) -> LedMotion:
    """Return the motion that a camera alone shows, smoothed piece by piece."""
    attitude = recording.attitude
    assert attitude is not None
    piece, parts = pieces_of(attitude.t), list[LedMotion]()
    for k in range(piece[-1] + 1):
        if np.sum(piece == k) >= FEWEST:
            part = replace(recording, attitude=attitude.where(piece == k), rate=None)
            parts.append(LedMotion(*sampled_motion(part, testbed), np.zeros(0, np.int64)))
    return thinned(joined(parts))


def by_gyro(rate: Samples, piece: Ints, testbed: Testbed) -> LedMotion:
    """Return the motion that a gyro alone shows: its longest piece, from level."""
    longest = int(np.argmax(np.bincount(piece)))
    part = rate.where(piece == longest)
    q = integrate_rate(part.t, part.values, level(testbed.up))
    reported = () if piece[-1] == 0 else (Reason(EstimateReason.LONGEST_PIECE_ONLY),)
    whole = np.zeros(len(part.t), np.int64)
    return thinned(LedMotion(part.t, q, part.values, whole, reported))


def led(rate: Samples, camera: Samples, testbed: Testbed) -> LedMotion | None:
    """Return a piece of a gyro's motion, held by the camera rows within; None without any."""
    inside = (camera.t >= rate.t[0]) & (camera.t <= rate.t[-1])
    if inside.sum() < FEWEST or len(rate) < FEWEST:
        return None
    observed = camera.where(inside)
    bias = first_bias(rate, observed)
    base, off = followed(rate, observed, bias)
    observed = observed.where(~stand_off(off - median_near(off)))
    for _ in range(PASSES):
        bias = bias + bias_left(rate.t, base, observed.t, followed(rate, observed, bias)[1])
        base, off = followed(rate, observed, bias)
    density = gyro_noise(testbed) * rate.period**0.5  # rad/sqrt(s)
    slow = smoothed_walk(observed.t, off, density, camera_noise(testbed))
    q = multiply(exponential(read_at(rate.t, observed.t, slow)), base)
    return LedMotion(rate.t, q, rate.values - bias, np.zeros(len(rate.t), np.int64))


def followed(rate: Samples, observed: Samples, bias: Vector3) -> tuple[Series4, Series3]:
    """Return the attitudes that rates lead to, and by how much the camera is off (laboratory)."""
    base = integrate_rate(rate.t, rate.values - bias, observed.values[0])
    turn = multiply(observed.values, conjugate(at_times(rate.t, base, observed.t)))
    first = most_alike(turn[:FEWEST])
    return multiply(first, base), logarithm(multiply(turn, conjugate(first)))


def most_alike(turns: Series4) -> Quaternion:
    """Return the rotation that is nearest to the others, as an odd one is not."""
    separation = np.abs(turns @ turns.T)
    return turns[int(np.argmax(np.sort(separation, axis=1)[:, len(turns) // 2]))]


def first_bias(rate: Samples, observed: Samples) -> Vector3:
    """Return the median of the gyro's rates less the camera's, rad/s."""
    turn = logarithm(multiply(conjugate(observed.values[:-1]), observed.values[1:]))
    camera: Floats = turn / np.diff(observed.t)[:, None]
    middle = 0.5 * (observed.t[1:] + observed.t[:-1])
    gyro = read_at(middle, rate.t, rate.values)
    return np.asarray(np.median(gyro - camera, axis=0), dtype=np.float64)


def at_times(t: Series1, base: Series4, observed: Series1) -> Series4:
    """Return attitudes between their times, along the shortest turn."""
    i = np.clip(np.searchsorted(t, observed, side="right") - 1, 0, len(t) - 2)
    share = (observed - t[i]) / (t[i + 1] - t[i])
    step = logarithm(multiply(conjugate(base[i]), base[i + 1]))
    return multiply(base[i], exponential(share[:, None] * step))


def bias_left(t: Series1, base: Series4, observed: Series1, off: Series3) -> Vector3:
    """Return what is left of the bias (rad/s), by least squares on off = c - int R db."""
    R = to_matrix(base)
    steps = 0.5 * (R[1:] + R[:-1]) * np.diff(t)[:, None, None]
    grown = np.concatenate([np.zeros((1, 9)), np.cumsum(steps.reshape(-1, 9), axis=0)])
    grown = read_at(observed, t, grown)
    A = (grown.mean(axis=0) - grown).reshape(-1, 3)
    right: Floats = A.T @ (off - off.mean(axis=0)).reshape(-1)
    return scaled_solve(A.T @ A, right, 1e-9)


def median_near(off: Series3) -> Series3:
    """Return the running median of five rows, which a single odd row does not move."""
    padded = np.pad(off, ((2, 2), (0, 0)), mode="reflect")
    near = np.stack([padded[k : k + len(off)] for k in range(5)])
    return np.asarray(np.median(near, axis=0), dtype=np.float64)


def stand_off(left: Series3) -> Bools:
    """Return which rows are outliers, by the median."""
    size = np.linalg.norm(left, axis=1)
    return size > STANDS_OFF * max(float(np.median(size)) / 1.18, 1e-12)


def thinned(motion: LedMotion) -> LedMotion:
    """Return means of neighbouring rows of a motion that has more than ``MOST``."""
    k = -(-len(motion.t) // MOST)
    if k <= 1:
        return motion
    k += 1 - k % 2
    parts = list[LedMotion]()
    for j in range(int(motion.piece[-1]) + 1):
        rows = np.flatnonzero(motion.piece == j)
        n = len(rows) // k
        if n < FEWEST:
            continue
        block = rows[: n * k].reshape(n, k)
        middle = block[:, k // 2]
        parts.append(LedMotion(motion.t[block].mean(axis=1), motion.q[middle],
                               motion.w[block].mean(axis=1), np.zeros(n, np.int64)))  # fmt: skip
    return joined(parts, motion.notes)
