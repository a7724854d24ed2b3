"""Correlated noise torque: an Ornstein-Uhlenbeck process per body axis, exactly discretised.

    x_(k+1) = a x_k + s sqrt(1 - a^2) n_k,    a = exp(-step / correlation),    x_0 = s n

Between grid points the torque is a straight line, which takes 1.6 % off the variance halfway at
the step chosen here; at the grid points sd and correlation are exact. Values are drawn in order of
time, so that a run does not depend on how it is read.
(Size and correlation time of real ones: turbine effect, drafts; about 1e-6 N m over 30 s.)
"""

from dataclasses import dataclass, replace

import numpy as np

from equipoise.maths.kernels.compiled import kernel
from equipoise.maths.straight_lines import read_at
from equipoise.model.arrays import Floats, Series1, Series3
from equipoise.simulation.clock import tick

STEPS = 20  # in one correlation time, chosen: see above


@dataclass(frozen=True, slots=True, eq=False)
class NoiseTorque:
    """The process as far as it has been drawn."""

    sd: float  # N m per axis
    correlation: float  # s
    first: int  # index of the first value kept
    values: Series3  # (n, 3) N m, at (first + i) * step

    @property
    def step(self) -> float:
        """Grid spacing, s."""
        return self.correlation / STEPS

    @property
    def t(self) -> Series1:
        """Times of the values kept, s."""
        last = self.first + len(self.values)
        return tick(self.step * np.arange(self.first, last, dtype=np.float64))


@kernel
def _walk(stay: float, push: float, start: Floats, normal: Floats) -> None:
    for i in range(normal.shape[0]):
        for j in range(3):
            before = start[j] if i == 0 else normal[i - 1, j]
            normal[i, j] = stay * before + push * normal[i, j]


def start_noise(sd: float, correlation: float, rng: np.random.Generator) -> NoiseTorque:
    """Return the process at time zero."""
    return NoiseTorque(sd, correlation, 0, sd * rng.standard_normal((1, 3)))


def extended(noise: NoiseTorque, until: float, rng: np.random.Generator) -> NoiseTorque:
    """Return the process drawn at least up to ``until`` (s)."""
    missing = int(np.ceil(until / noise.step)) + 1 - (noise.first + len(noise.values))
    if missing <= 0:
        return noise
    stay = float(np.exp(-1.0 / STEPS))
    push = noise.sd * (1.0 - stay**2) ** 0.5
    fresh = rng.standard_normal((missing, 3))
    _walk(stay, push, noise.values[-1], fresh)
    return replace(noise, values=np.vstack([noise.values, fresh]))


def forgotten(noise: NoiseTorque, before: float) -> NoiseTorque:
    """Return the process without what only matters before a time (s)."""
    drop = int(np.floor(before / noise.step)) - 1 - noise.first
    if drop <= 0:
        return noise
    return replace(noise, first=noise.first + drop, values=noise.values[drop:])


def torque_at(noise: NoiseTorque, t: Series1) -> Series3:
    """Return the torque at times within what was drawn; as at time zero before it, N m."""
    if noise.sd == 0:
        return np.zeros((len(t), 3))
    return read_at(t, noise.t, noise.values)
