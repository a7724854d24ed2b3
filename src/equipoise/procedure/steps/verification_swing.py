"""Verify a balance on a fresh swing; a platform that stands still is set swinging first.

A platform that hangs still in one attitude shows nothing of the centre of mass along gravity. Its
finest masses, which come back nearest to where they were, go out and back once:

    m g int s dt = J w,    s a triangle of height S at speed v:  S = sqrt(J w v / (m g))

towards where the vertical leans, so that it passes level on its way.
"""

import numpy as np

from equipoise.actuators.sliding_masses import mass_maps
from equipoise.estimation.motion.attitude_filter import AttitudeState
from equipoise.maths.attitude import to_matrix
from equipoise.maths.axes_across import axes_across
from equipoise.maths.linalg import cross
from equipoise.model.arrays import Floats, Vector3
from equipoise.model.bench import Bench
from equipoise.model.recording import Recording, join
from equipoise.model.testbed import SlidingMass, Testbed
from equipoise.procedure.steps.planned_move import by_name
from equipoise.procedure.steps.sampler import Eyes, last_row
from equipoise.procedure.steps.tilt_guard import guarded

STILL = np.deg2rad(0.1)  # rad/s, chosen: slower than this it hangs still, as far as a proof goes
WANTED = np.deg2rad(0.2)  # rad/s, chosen: 8 deg in a proof of 40 s, where sag hardly bends yet
BEFORE = 1.0  # s, chosen: recorded before a push
ALIKE = 2.0  # -, chosen: masses that err by up to so many times the least are the finest


def watched_swing(bench: Bench, eyes: Eyes, duration: float) -> Recording:
    """Return a fresh record of ``duration`` seconds; it begins with a push where one is needed."""
    begun, left = bench.read(BEFORE), duration - BEFORE
    if eyes.attitude is None or swinging(eyes.attitude) > STILL:
        return join(begun, guarded(bench, left))
    here = last_row(begun.masses, eyes.displacement)
    out = push(bench.testbed, eyes, here)
    wait = float(np.abs(out - here).max()) / slowest(bench.testbed)
    bench.move(by_name(bench.testbed, out))
    going = bench.read(wait)
    bench.move(by_name(bench.testbed, here))
    return join(join(begun, going), guarded(bench, left - wait))


def swinging(now: AttitudeState) -> float:
    """Return the rate (rad/s) at which the vertical turns in the body: no spin about it."""
    return float(np.linalg.norm(cross(now.rate, to_matrix(now.q)[2])))


def slowest(testbed: Testbed) -> float:
    """Return the speed of the slowest of the masses that push, m/s."""
    return min(testbed.masses[i].speed for i in finest(testbed.masses))


def finest(masses: tuple[SlidingMass, ...]) -> list[int]:
    """Return the masses that come back nearest to where they were."""
    error = [mass.mass * max(mass.accuracy, mass.resolution, mass.backlash) for mass in masses]
    return [i for i, each in enumerate(error) if each <= ALIKE * min(error)]


def push(testbed: Testbed, eyes: Eyes, here: Floats) -> Floats:
    """Return where the masses turn back, m, from where they are."""
    masses, chosen = testbed.masses, finest(testbed.masses)
    gain = mass_maps([masses[i] for i in chosen]).first_moment / testbed.body.mass
    way: Floats = np.linalg.pinv(gain.T) @ direction(testbed, eyes)  # m a metre of shift
    speed = slowest(testbed) / float(np.abs(way).max())  # m/s of the centre of mass
    weight = testbed.weight
    moment = testbed.body.mean_moment
    reach = float(np.sqrt(moment * WANTED * speed / weight))
    goal = here.copy()
    goal[chosen] = within([masses[i] for i in chosen], goal[chosen], reach * way)
    return goal


def direction(testbed: Testbed, eyes: Eyes) -> Vector3:
    """Return the horizontal direction (body) in which the vertical leans; any, if it is level."""
    assert eyes.attitude is not None
    up, vertical = testbed.up, to_matrix(eyes.attitude.q)[2]
    lean = vertical - (vertical @ up) * up
    size = float(np.linalg.norm(lean))
    return lean / size if size > 1e-3 else axes_across(up)[0]


def within(masses: list[SlidingMass], now: Floats, way: Floats) -> Floats:
    """Return goals (m) a way on, or back if that has more room, in whole steps inside the rails."""
    low: Floats = np.array([mass.travel[0] for mass in masses])
    high: Floats = np.array([mass.travel[1] for mass in masses])
    step = np.array([mass.resolution for mass in masses])

    def share(sign: float) -> float:
        room: Floats = np.where(sign * way > 0, high - now, now - low)
        return min(1.0, float((room / np.maximum(np.abs(way), 1e-12)).min()))

    sign = 1.0 if share(1.0) >= share(-1.0) else -1.0
    goal = now + sign * share(sign) * way
    whole = np.where(step > 0, np.round(goal / np.where(step > 0, step, 1.0)) * step, goal)
    return np.clip(whole, low, high)
