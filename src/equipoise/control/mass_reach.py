"""How fast, how far and how finely the sliding masses can move the centre of mass.

Masses m_i on rails u_i, of speed v_i and travel d_i, shift the centre of mass m within a zonotope;
along a direction n it reaches to

    speed  sum_i m_i v_i |u_i.n| / m        travel  sum_i m_i d_i |u_i.n| / m

and the least of these over the directions across ``up`` is what can be counted on. The quantum is
the largest step of one motor: m_i resolution_i / m.

Does not see that masses which are to stay level while they move across may have to help one
another: with slanting rails less may be left.
"""

from typing import NamedTuple

import numpy as np

from equipoise.maths.linalg import skew
from equipoise.model.arrays import Floats, Matrix3, Vector3
from equipoise.model.errors import InputError
from equipoise.model.testbed import Testbed

DIRECTIONS = 360  # chosen: of half a turn, so that the least is found to 1e-5
FLAT = 1e-9  # m/s, chosen: no masses across up
LIKELY = 2.0  # sd, chosen: an offset that few exceed


class Reach(NamedTuple):
    """What can be counted on in any direction across up."""

    speed: float  # m/s, of the centre of mass
    travel: float  # m, of the centre of mass, either way from home
    quantum: float  # m, the coarsest step of it
    upward: float  # m, travel along up


def across(up: Vector3) -> Matrix3:
    """Return what takes the part along ``up`` from a vector: E - up up^T."""
    return np.eye(3) - np.outer(up, up)


def around(up: Vector3, n: int = DIRECTIONS) -> Floats:
    """Return n unit vectors across ``up``, (n, 3), evenly over half a turn."""
    first = skew(up) @ np.eye(3)[int(np.argmin(np.abs(up)))]
    first = first / float(np.linalg.norm(first))
    angle = np.pi * np.arange(n)[:, None] / n
    return np.cos(angle) * first + np.sin(angle) * (skew(up) @ first)


def reach_of(testbed: Testbed) -> Reach:
    """Return what the masses can do; InputError if they cannot go some way across up."""
    masses, total = testbed.masses, testbed.body.mass
    share = np.array([mass.mass for mass in masses]) / total
    u = np.array([mass.axis for mass in masses]).reshape(-1, 3)
    seen = np.abs(around(testbed.up) @ u.T) * share
    speed = float(np.min(seen @ np.array([mass.speed for mass in masses]), initial=np.inf))
    if not masses or speed < FLAT:
        raise InputError(testbed.name, f"{len(masses)} sliding masses that do not span the level",
                         "masses that move along two directions across up")  # fmt: skip
    travel = np.array([min(-mass.travel[0], mass.travel[1]) for mass in masses])
    quantum = float(np.max(share * np.array([mass.resolution for mass in masses])))
    upward = float(np.abs(u @ testbed.up) * share @ travel)
    return Reach(speed, float(np.min(seen @ travel)), quantum, upward)


def likely_offset(testbed: Testbed) -> float:
    """Return how far (m) the centre of mass may well be off sideways, masses at home."""
    P = across(testbed.up)
    return float(np.linalg.norm(P @ testbed.body.com) + LIKELY * np.linalg.norm(P @ testbed.com_sd))


def likely_height(testbed: Testbed) -> float:
    """Return how far (m) the centre of mass may well be above P, masses at home."""
    return float(testbed.up @ testbed.body.com) + LIKELY * height_sd(testbed)


def height_sd(testbed: Testbed) -> float:
    """Return one sd (m) of the height of the centre of mass."""
    return float(np.linalg.norm(testbed.up * testbed.com_sd))


def level_inertia(testbed: Testbed) -> float:
    """Return the mean moment (kg m^2) about the axes across up."""
    return float(np.trace(across(testbed.up) @ testbed.body.inertia_P)) / 2
