"""Wheels, gimbals and masses all moving: without gravity, total momentum is kept in the laboratory.

The propagator's rate and attitude, put together again body by body: point masses on their rails,
wheels, rotors, and each gimbal's inertia turned with it. None of that is the propagator's own sum.
"""

import numpy as np

from equipoise.actuators.control_moment_gyros import gimbal_coordinates, gimbal_maps
from equipoise.actuators.sliding_masses import MassMaps, mass_maps
from equipoise.dynamics.propagation import body_of, stacked
from equipoise.maths.attitude import to_matrix
from equipoise.maths.linalg import pack_symmetric
from equipoise.model.devices import ControlMomentGyro
from equipoise.model.testbed import SlidingMass
from equipoise.simulation.motion import run

INERTIA = np.array([[0.46, -0.008, 0.031], [-0.008, 0.53, 0.011], [0.031, 0.011, 0.78]])
T = np.arange(0.0, 600.0 + 1e-9, 0.02)
STEP = T[1] - T[0]
WHEEL_AXES = np.array([[1.0, 0, 0], [0, 0.6, 0.8]])
WHEEL_INERTIA = 5e-4


def gyro(g, s, asymmetry):
    return ControlMomentGyro(
        "g", np.array(g), np.array(s), 0.05, 1.0, gimbal_inertia=4e-3, asymmetry=asymmetry
    )


GYROS = (
    gyro([0.0, 0.0, 1.0], [1.0, 0.0, 0.0], -3e-3),
    gyro([0.6, 0.0, 0.8], [0.0, 1.0, 0.0], 2e-3),
)
MASSES = tuple(
    SlidingMass("m", 0.3, np.array(home), np.array(axis), (-0.1, 0.1), 0.0, 0.0, 0.0, 0.01)
    for home, axis in (([0.0, 0.2, -0.1], [1.0, 0.0, 0.0]), ([0.2, 0.0, 0.1], [0.0, 0.6, 0.8]))
)


def waves(sizes, periods):
    return np.column_stack(
        [a * np.sin(2 * np.pi * T / p) for a, p in zip(sizes, periods, strict=True)]
    )


SPEEDS = waves([80.0, 60.0], [40.0, 70.0])
ANGLES = waves([1.5, 2.0], [33.0, 47.0]) + 0.4
PLACES = waves([0.05, 0.04], [90.0, 61.0])


def spins(angles):
    """Return s of each gyro, (n, 2, 3), by turning s0 about g."""
    s0 = np.array([g.spin_axis for g in GYROS])
    third = np.array([np.cross(g.gimbal_axis, g.spin_axis) for g in GYROS])
    return np.cos(angles)[..., None] * s0 + np.sin(angles)[..., None] * third


def motion():
    body = body_of(14.0, 0.0, pack_symmetric(INERTIA), np.zeros(3))
    maps = MassMaps(*map(np.vstack, zip(mass_maps(MASSES), gimbal_maps(GYROS), strict=True)))
    h = WHEEL_INERTIA * SPEEDS @ WHEEL_AXES + 0.05 * spins(ANGLES).sum(axis=1)
    known = np.hstack([h, np.zeros((len(h), 4)), PLACES, gimbal_coordinates(GYROS, ANGLES)])
    start = np.array([1.0, 0, 0, 0, 0.03, -0.02, 0.05])
    return run(body, stacked(maps), start, T, known)


def of_masses(w):
    """Momentum of the masses where they are, less that at home; the speed is the last step's."""
    total = np.zeros_like(w)
    for mass, d in zip(MASSES, PLACES.T, strict=True):
        speed = np.append(0.0, np.diff(d) / STEP)
        place = mass.home + d[:, None] * mass.axis
        velocity = np.cross(w, place) + speed[:, None] * mass.axis
        total += mass.mass * (
            np.cross(place, velocity) - np.cross(mass.home, np.cross(w, mass.home))
        )
    return total


def of_gyros(w):
    """Momentum of rotors and gimbals beyond that of gimbals locked at zero."""
    s, s0 = spins(ANGLES), spins(np.zeros(2))
    rates = np.vstack([[0.0, 0.0], np.diff(ANGLES, axis=0) / STEP])
    total = 0.05 * s.sum(axis=1)
    for i, g in enumerate(GYROS):
        along = np.sum(s[:, i] * w, axis=1, keepdims=True) * s[:, i]
        total += g.asymmetry * (along - np.outer(w @ s0[i], s0[i]))
        total += g.gimbal_inertia * np.outer(rates[:, i], g.gimbal_axis)
    return total


def test_total_momentum_is_kept_for_ten_minutes():
    """1e-10 of it, while wheels and gyros hold as much as all of it, and the platform tumbles."""
    path = motion()
    w = path.rate
    H = w @ INERTIA + WHEEL_INERTIA * SPEEDS @ WHEEL_AXES + of_masses(w) + of_gyros(w)
    H_N = np.einsum("nij,nj->ni", to_matrix(path.y[:, :4]), H)[1:]  # row 0 has no step before it
    size = np.linalg.norm(H_N[0])
    assert np.ptp(H_N, axis=0).max() < 1e-10 * size
    assert np.abs(w @ INERTIA).max() > size
    assert np.ptp(np.einsum("nij,nj->ni", to_matrix(path.y[:, :4]), w @ INERTIA)) > size
