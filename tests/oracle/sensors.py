"""What camera, gyro and masses record of an oracle run, with the sensors' defects. Development."""

from typing import NamedTuple

import numpy as np

from equipoise.model.recording import Samples
from tests.oracle import mujoco_bench as oracle
from tests.oracle.defects import Array, Defects, Harmonic

HAIR = 1e-9  # s, chosen: a frame may lie outside the run by so much


class Observed(NamedTuple):
    """The rows of a camera."""

    attitude: Samples
    length: Array  # of each row's mean quaternion before it is normalised: 1 - |w|^2 var(t) / 8


def attitude_at(run: oracle.OracleRun, t: Array) -> Array:
    """Return attitudes between the run's steps, (..., 4); good to 1e-9 rad.

    The rate is taken to change evenly over a step.
    """
    dt = run.t[1] - run.t[0]
    k = np.clip((t / dt).astype(int), 0, len(run.t) - 2)
    s = (t / dt - k)[..., None]
    mean = run.rate[k] + 0.5 * s * (run.rate[k + 1] - run.rate[k])
    return oracle.product(run.q[k], oracle.rotation(mean * s * dt))


def heading(q: Array) -> Array:
    """Return atan2 of the laboratory's y and x components of body x, rad, (...)."""
    w, x, y, z = np.moveaxis(q, -1, 0)
    return np.arctan2(2 * (x * y + w * z), 1 - 2 * (y * y + z * z))


def heading_error(psi: Array, harmonics: tuple[Harmonic, ...]) -> Array:
    """Return the camera's rotation vectors in body axes, rad, (..., 3)."""
    parts = [
        np.cos(h.order * psi)[..., None] * h.cosine + np.sin(h.order * psi)[..., None] * h.sine
        for h in harmonics
    ]
    return sum(parts, np.zeros((*psi.shape, 3)))


def in_camera_axes(q: Array, defects: Defects) -> Array:
    """Return plumb (x) true (x) heading error, (..., 4)."""
    turned = oracle.product(q, oracle.rotation(heading_error(heading(q), defects.heading)))
    return oracle.product(oracle.rotation(np.array([*defects.plumb, 0.0])), turned)


def frame_times(span: float, rate: float, defects: Defects) -> tuple[Array, Array]:
    """Return the rows' stamps, (n,), and when their frames were taken, (n, frames), s.

    A row is stamped with the middle of its frames, on a clock ``camera_delay`` late. Rows that have
    frames outside the run are left out; a single last row is there if its first frame is.
    """
    stamps = np.arange(round(span * rate) + 1) / rate
    offsets = defects.frame_gap * (np.arange(defects.frames) - 0.5 * (defects.frames - 1))
    frames = stamps[:, None] + offsets - defects.camera_delay
    last = frames[:, 0] if defects.last_row_single else frames[:, -1]
    keep = (frames[:, 0] >= -HAIR) & (last <= span + HAIR)
    return stamps[keep], frames[keep]


def camera(
    run: oracle.OracleRun, rng: np.random.Generator, rate: float, noise: float, defects: Defects
) -> Observed:
    """Return the rows of a camera at ``rate`` (Hz); a mean has the noise (rad), a frame more."""
    t, frames = frame_times(float(run.t[-1]), rate, defects)
    if defects.last_row_single:
        frames[-1] = frames[-1, 0]
    q = in_camera_axes(attitude_at(run, frames), defects)
    shaken = rng.normal(0.0, noise * np.sqrt(defects.frames), (*frames.shape, 3))
    if defects.last_row_single:
        shaken[-1] = shaken[-1, 0]
    mean = oracle.product(q, oracle.rotation(shaken)).mean(axis=1)
    length = np.linalg.norm(mean, axis=1)
    values = mean / length[:, None]
    for bad in defects.bad_rows:
        row = int(np.argmin(np.abs(t - bad.time)))
        values[row] = oracle.product(values[row], oracle.rotation(bad.turn))
    return Observed(Samples(t, values), length)


def gyro(
    run: oracle.OracleRun, rng: np.random.Generator, rate: float, noise: float, defects: Defects
) -> Samples:
    """Return round((E + M) w + b + noise), at ``rate`` (Hz)."""
    rows = oracle.every(run, rate)
    w = run.rate[rows] @ (np.eye(3) + defects.gyro_matrix).T + defects.gyro_bias
    w = w + rng.normal(0.0, noise, w.shape)
    if defects.gyro_quantum:
        w = defects.gyro_quantum * np.round(w / defects.gyro_quantum)
    return Samples(run.t[rows].copy(), w)


def where_masses_are(run: oracle.OracleRun, rate: float) -> Samples:
    """Return the displacements of an encoder on each rail, m, at ``rate`` (Hz)."""
    rows = oracle.every(run, rate)
    return Samples(run.t[rows].copy(), run.displacement[rows].copy())


def where_masses_were_sent(
    run: oracle.OracleRun, schedule: tuple[oracle.Ramp, ...], rate: float
) -> Samples:
    """Return the displacements as commanded, m: ahead of the masses, and without their sag."""
    t = run.t[oracle.every(run, rate)].copy()
    return Samples(t, oracle.command(run.platform, schedule, t))
