"""How fast masses may travel without disturbing an experiment that runs meanwhile.

Masses that set off at speeds v_i store momentum of travel, and move the centre of mass:

    h = sum m_i v_i rho_i x u_i          taken up, and given back when they stop
    dtau/dt = g |(sum m_i v_i u_i) x n|  at most g |sum m_i v_i u_i|

A drive sets off within a time t_0: then h turns the platform by h / t_0. Within any second, one
start and one stop and a torque that grows since the second began have a mean square of

    2 h^2 / t_0  +  (dtau/dt)^2 / 3      [N^2 m^2 in 1 s]

which must not exceed the square of the stated torque. All masses of a move go at one speed, which
is the greatest that keeps both. Single steps of a stepper are not counted, only their mean speed.
"""

from dataclasses import dataclass, replace
from itertools import product

import numpy as np

from equipoise.actuators.sliding_masses import MassMaps, mass_maps
from equipoise.model.arrays import Floats
from equipoise.model.bench_requests import in_steps
from equipoise.model.testbed import Testbed

SECOND = 1.0  # s, over which the mean square is taken
LITTLE = 0.5  # of the longest way, chosen: a mass with less waits until it is more
ROUNDING = 1e-9  # m, chosen: less is no way
START = 0.01  # s, chosen: a stepper reaches some um/s within a few steps


@dataclass(frozen=True, slots=True)
class MotionBudget:
    """What moves may add; infinite: masses go at their own speed."""

    torque: float = np.inf  # N m, rms in any second
    torque_rate: float = np.inf  # N m/s, of the torque of gravity


NO_LIMIT = MotionBudget()
USUAL = MotionBudget(2e-6)  # chosen: what an experiment on a few kg hardly measures


def speed_for(testbed: Testbed, way: Floats, budget: MotionBudget) -> float:
    """Return how fast (m/s) masses may travel along ``way`` (m, displacements to go)."""
    going = np.where(np.abs(way) > ROUNDING, np.sign(way), 0.0)
    return _speed(mass_maps(testbed.masses), testbed.gravity, going, budget)


def _speed(maps: MassMaps, gravity: float, sign: Floats, budget: MotionBudget) -> float:
    """Return how fast (m/s) masses may travel in directions of +-1, 0 where one stands."""
    h = float(np.linalg.norm(sign @ maps.momentum))  # kg m, per m/s
    rate = gravity * float(np.linalg.norm(sign @ maps.first_moment))  # N, per m/s
    torque = float(np.sqrt(2.0 * h**2 / (START * SECOND) + (rate * SECOND) ** 2 / 3.0))
    used = ((budget.torque, torque), (budget.torque_rate, rate))
    return min(limit / amount if amount > 0 else np.inf for limit, amount in used)


def longest_first(testbed: Testbed, now: Floats, goal: Floats, budget: MotionBudget) -> Floats:
    """Return displacements (m) to go to with masses of little way left standing, if that is faster.

    Masses of one move share its speed. One that goes alone may go faster: what drifts along one
    axis is otherwise followed no faster than what drifts along all.
    """
    way, masses = np.abs(goal - now), testbed.masses
    stay = np.array([in_steps(mass, float(d)) for mass, d in zip(masses, now, strict=True)])
    fewer = np.where(way < LITTLE * way.max(), stay, goal)
    faster = speed_for(testbed, fewer - now, budget) > speed_for(testbed, goal - now, budget)
    return fewer if faster else goal


def slowed(testbed: Testbed, budget: MotionBudget) -> Testbed:
    """Return the testbed with masses that are as slow as any move of the budget may be."""
    maps, g = mass_maps(testbed.masses), testbed.gravity
    signs = product((-1.0, 1.0), repeat=len(testbed.masses))
    least = min((_speed(maps, g, np.array(sign), budget) for sign in signs), default=np.inf)
    masses = tuple(replace(mass, speed=min(mass.speed, least)) for mass in testbed.masses)
    return replace(testbed, masses=masses)


def reached(testbed: Testbed, now: Floats, goal: Floats, lapse: float) -> Floats:
    """Return the displacements (m) after a while (s) on the way to a goal."""
    most = lapse * np.array([mass.speed for mass in testbed.masses])
    return now + np.clip(goal - now, -most, most)
