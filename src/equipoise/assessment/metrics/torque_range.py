"""Gravity's torque over a range of tilts, sag included, of a platform known with an uncertainty.

    tau(n) = m g (r + C n) x n  =  m g A(n) x,      x = [ r (3)  sag coefficients ]

n is the direction of gravity in body axes. Over all n within a tilt of level, each direction
counting alike, the mean square is x^T Q x, and the greatest that of the worst direction. Both are
lengths of an uncertain vector (``maths.gaussian_length``): what matters is the combination of
height and sag that the record shows, though it may not separate these.

(Residual torque: da Silva 2021 section 5; with sag, ``dynamics.sag_trim``.)

Cannot see torques that do not come from gravity, nor tilts at which the platform behaves unlike
those that were recorded.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from equipoise.dynamics.sag_trim import SAG_TERMS, downs, sag_matrix
from equipoise.maths.attitude import level, to_matrix
from equipoise.maths.gaussian_length import (
    SURE,
    Bounded,
    bounded_length,
    normal_points,
    root_of,
)
from equipoise.model.arrays import Floats, Series3, Square, Vector3
from equipoise.model.estimate import COM

RINGS, HEADINGS = 6, 24  # chosen: the worst direction to within 1 %


class InRange(NamedTuple):
    """Torque within a tilt of level, N m."""

    tilt: float  # rad
    rms: Bounded
    worst: float  # at the worst attitude
    worst_high: float  # 97.5 % bound


def levers(names: tuple[str, ...], n: Series3) -> Floats:
    """Return A(n) (N, 3, k): the lever of each coefficient at each direction of gravity."""
    A = np.empty((len(n), 3, len(names)))
    for k, name in enumerate(names):
        arm = n @ sag_matrix({name: 1.0}) if name in SAG_TERMS else np.eye(3)[COM.index(name)]
        A[:, :, k] = np.cross(arm, n)
    return A


def torque_form(names: tuple[str, ...], weight: float, up: Vector3, tilt: float) -> Square:
    """Return Q (k, k), (N m)^2: x^T Q x is the mean square; ``weight`` is m g in N."""
    n, share = downs(up, tilt)
    A = levers(names, n)
    return weight**2 * np.einsum("n,nia,nib->ab", share[:, 0], A, A, optimize=True)


def directions(up: Vector3, tilt: float) -> Series3:
    """Return directions of gravity (N, 3) on rings from level to a tilt (rad)."""
    rings = np.repeat(np.linspace(0.0, tilt, RINGS), HEADINGS)
    heading = np.tile(2 * np.pi * np.arange(HEADINGS) / HEADINGS, RINGS)
    n = -np.column_stack([
        np.sin(rings) * np.cos(heading), np.sin(rings) * np.sin(heading), np.cos(rings)
    ])  # fmt: skip
    turned: Series3 = n @ to_matrix(level(up))
    return turned


@dataclass(frozen=True, slots=True, eq=False)
class Pull:
    """What gravity pulls on."""

    names: tuple[str, ...]  # com_x ..., and coefficients of sag
    mean: Floats  # m
    covariance: Square  # m^2
    unscaled: Square  # m^2, with the inertia known, which all of them go in proportion to


def torque_in_range(pull: Pull, weight: float, up: Vector3, tilt: float) -> InRange:
    """Return the torque within a tilt (rad) of level; ``weight`` is m g in N."""
    A, mean = levers(pull.names, directions(up, tilt)), pull.mean
    draws: Floats = mean + normal_points(len(mean)) @ root_of(pull.covariance).T

    def worst(x: Floats) -> Floats:
        turning: Floats = np.einsum("nik,dk->dni", A, x, optimize=True)
        return weight * np.sqrt(np.sum(turning**2, axis=2).max(axis=1))

    high = np.quantile(np.concatenate([worst(part) for part in np.array_split(draws, 8)]), SURE)
    form = torque_form(pull.names, weight, up, tilt)
    rms = bounded_length(mean, pull.covariance, form, pull.unscaled)
    return InRange(tilt, rms, float(worst(mean[None])[0]), float(high))
