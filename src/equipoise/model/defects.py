"""Defects of a simulated bench beyond noise: surroundings, camera, gyro and log."""

from dataclasses import dataclass, field

import numpy as np

from equipoise.model.arrays import Floats, Vector3


def nothing() -> Vector3:
    """Return zeros."""
    return np.zeros(3)


@dataclass(frozen=True, slots=True, eq=False)
class Contact:
    """The platform touches something for a moment."""

    time: float  # s
    impulse: Vector3  # N m s, about P, laboratory axes


@dataclass(frozen=True, slots=True, eq=False)
class ComStep:
    """A part slips: the centre of mass goes elsewhere, once."""

    time: float  # s
    shift: Vector3  # m, of the total centre of mass


@dataclass(frozen=True, slots=True, eq=False)
class TrueLamp:
    """When a lamp is on, and how it really warms the platform; None: as the testbed states it.

    What is on at time zero has been on for long.
    """

    on: Floats  # (n, 2) s, from when to when
    warms: float | None = None  # K
    time_constant: float | None = None  # s


@dataclass(frozen=True, slots=True, eq=False)
class TrueCoilPair:
    """What a pair of coils of a cage really gives."""

    name: str
    gain: float = 1.0  # -, of the field it is driven by
    axis_N: Vector3 | None = None  # unit vector, laboratory; None: as the testbed states it
    deviation: float | None = None  # -, of the field at the magnetometer from that at the coils
    # on the platform, relative; None: drawn within what the testbed states


@dataclass(frozen=True, slots=True)
class Gap:
    """Rows of the sensors that are missing, both ends included."""

    start: float  # s
    end: float  # s


@dataclass(frozen=True, slots=True, eq=False)
class CameraErrors:
    """Rotation vectors and outliers, plumb in laboratory axes, the rest in body axes.

    measured = exp(plumb) (x) true (x) exp(heading_cos cos 2 psi + heading_sin sin 2 psi),
    psi being the heading.
    """

    plumb: Vector3 = field(default_factory=nothing)  # rad, about the laboratory's x and y
    heading_cos: Vector3 = field(default_factory=nothing)  # rad
    heading_sin: Vector3 = field(default_factory=nothing)  # rad
    bad_share: float = 0.0  # of the rows
    bad_turn: float = 0.0  # rad, by which a bad row is turned about any axis


@dataclass(frozen=True, slots=True, eq=False)
class GyroErrors:
    """w_measured = (1 + scale) R(turn)^T w, before bias and noise."""

    scale: Vector3 = field(default_factory=nothing)  # -, of each gyro axis
    turn: Vector3 = field(default_factory=nothing)  # rad, of the gyro's axes from the body's
