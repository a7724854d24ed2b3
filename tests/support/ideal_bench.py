"""A platform in a plain loop, for laws: every device does what it is told, or nearly.

Between two steps of a law the motion is integrated by ``simulation.motion``. Masses jump where they
are told, or go there at a speed; wheels take up h' = -torque evenly over a period. No filters.
"""

from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np

from equipoise.actuators.sliding_masses import com_shift, mass_maps
from equipoise.control.law import Sample
from equipoise.dynamics.propagation import body_of, stacked
from equipoise.maths.attitude import exponential, multiply, to_matrix
from equipoise.maths.linalg import pack_symmetric
from equipoise.model.command import Command
from equipoise.model.devices import ReactionWheel
from equipoise.model.estimate import COM, Estimate, Parameter
from equipoise.model.mass_properties import MassProperties
from equipoise.model.testbed import AttitudeSensor, Gyro, SlidingMass, Testbed
from equipoise.simulation.motion import run
from tests.support.outcomes import of_use

MASS, GRAVITY, INERTIA = 14.0, 9.81, np.diag([0.30, 0.28, 0.45])
UP = np.array([0.0, 0.0, 1.0])
AT_P = np.zeros((3, 3))
LEVEL = np.array([1.0, 0.0, 0.0, 0.0])
AT_REST = (LEVEL, np.zeros(3))


def rails(mass=5.0, speed=0.05, travel=0.05, resolution=0.0, home=AT_P):
    """Three masses along x, y and z; at P and heavy they hardly change the inertia."""
    return tuple(
        SlidingMass(name, mass, place, axis, (-travel, travel), resolution, 0.0, 0.0, speed)
        for name, place, axis in zip("xyz", home, np.eye(3), strict=True)
    )


def wheels(momentum=2.0, torque=0.5):
    """Three wheels along the body axes: N m s and N m."""
    return tuple(
        ReactionWheel(f"w{name}", axis, 1e-3, momentum / 1e-3, torque)
        for name, axis in zip("xyz", np.eye(3), strict=True)
    )


def platform(com_sd=1e-4, com=(0.0, 0.0, 0.0), inertia=INERTIA, mass=MASS, gravity=GRAVITY, **more):
    """What is known beforehand: little of the centre of mass."""
    given = {
        "masses": rails(),
        "attitude": AttitudeSensor(20.0, 1e-4),
        "gyro": Gyro(20.0, 1e-5, 0.0),
    }
    return Testbed(
        "ideal", MassProperties(mass, np.array(com), inertia), 0.0, np.full(3, com_sd), UP,
        np.radians(30), gravity, **(given | more),
    )  # fmt: skip


@dataclass(frozen=True)
class Bench:
    """What the platform really is, and how its devices do as they are told."""

    testbed: Testbed  # masses, gravity; its first guess is not looked at
    com: np.ndarray  # m, masses at home
    inertia: np.ndarray = None  # kg m^2; None: the testbed's
    instant: bool = True  # masses jump
    period: float = 0.1
    noise: tuple = (0.0, 0.0)  # rad, rad/s, one sd of a sample
    seed: int = 0
    reported: tuple = (0.0, 0.0)  # relative error of what a look tells, and its noise, m
    momentum: np.ndarray = None  # N m s, stored at the start

    @cached_property
    def maps(self):
        return mass_maps(self.testbed.masses)

    @cached_property
    def body(self):
        J = self.testbed.body.inertia_P if self.inertia is None else self.inertia
        return body_of(self.testbed.body.mass, self.testbed.gravity, pack_symmetric(J),
                       self.testbed.body.mass * self.com)  # fmt: skip


class Row(NamedTuple):
    """One step of the loop, as things really were."""

    t: float
    q: np.ndarray
    rate: np.ndarray
    gravity: np.ndarray
    shift: np.ndarray
    momentum: np.ndarray
    state: object  # the law's, after the step
    command: Command | None


class Now(NamedTuple):
    t: float
    y: np.ndarray  # q, H
    rate: np.ndarray
    d: np.ndarray
    h: np.ndarray
    torque: np.ndarray  # mean of -h' over the last period


def sample(now, bench, rng):
    """What a law sees."""
    q = multiply(now.y[:4], exponential(bench.noise[0] * rng.normal(size=3)))
    rate = now.rate + bench.noise[1] * rng.normal(size=3)
    return Sample(now.t, q, rate, gravity_at(q, bench), shift_of(now.d, bench), now.h, now.torque,
                  np.zeros(3), None)  # fmt: skip


def gravity_at(q, bench):
    return -bench.testbed.gravity * to_matrix(q)[2, :]


def shift_of(d, bench):
    return com_shift(bench.maps, bench.testbed.body.mass, d)


def displacements(shift, bench):
    """Where the masses should go, to whole motor steps and within their rails; orthogonal rails."""
    masses = bench.testbed.masses
    d = np.linalg.solve(bench.maps.first_moment.T, bench.testbed.body.mass * shift)
    step = np.array([m.resolution for m in masses])
    d = np.where(step > 0, np.round(d / np.where(step > 0, step, 1)) * step, d)
    return np.clip(d, [m.travel[0] for m in masses], [m.travel[1] for m in masses])


def onward(now, bench, goal, torque, duration):
    """Integrate for ``duration``; the masses are on their way to ``goal``."""
    d, goal = (goal, goal) if bench.instant else (now.d, goal)
    speed = np.array([m.speed for m in bench.testbed.masses])
    ends = np.abs(goal - d) / speed
    inner = np.unique(ends[(ends > 1e-9) & (ends < duration - 1e-9)])
    t = np.concatenate([[0.0], inner, [duration]])
    share = np.minimum(t[:, None] / np.maximum(ends, 1e-12), 1.0)
    way = d + share * (goal - d)
    h = now.h - t[:, None] * torque
    known = np.hstack([h, np.zeros((len(t), 4)), way])
    path = run(bench.body, stacked(bench.maps), now.y, t, known)
    # The rate at the end, from the momentum: masses that arrive there no longer count.
    return Now(now.t + duration, path.y[-1], path.rate[-1], way[-1], h[-1], torque)


def measured(now, bench, rng):
    """What a look tells of the centre of mass with the masses at home: its scale is that of J."""
    there = shift_of(now.d, bench)
    com = (
        (bench.com + there) * (1 + bench.reported[0])
        - there
        + bench.reported[1] * rng.normal(size=3)
    )
    parameters = tuple(Parameter(n, "m", float(x), 1e-6) for n, x in zip(COM, com, strict=True))
    return Estimate("told", of_use(), parameters, 1e-12 * np.eye(3))


def started(bench, q, rate):
    """The platform with its masses at home."""
    J = bench.testbed.body.inertia_P if bench.inertia is None else bench.inertia
    h = np.zeros(3) if bench.momentum is None else bench.momentum
    return Now(0.0, np.concatenate([q, J @ rate + h]), np.asarray(rate, float), np.zeros(3), h,
               np.zeros(3))  # fmt: skip


def row(now, bench, state, command):
    q = now.y[:4]
    return Row(now.t, q, now.rate, gravity_at(q, bench), shift_of(now.d, bench), now.h, state,
               command)  # fmt: skip


def closed_loop(bench, step, begun, end, first=AT_REST):
    """Return the rows of a law's run until ``end`` (s) or until it has finished."""
    (state, params), rng = begun, np.random.default_rng(bench.seed)
    now, rows = started(bench, *first), []
    goal, observed = now.d, None
    while now.t < end - 1e-9:
        observed = sample(now, bench, rng) if observed is None else observed
        state, command = step(state, observed, params)
        rows.append(row(now, bench, state, command))
        if command.finished:
            return rows
        observed = None
        if command.shift is not None:
            goal = displacements(command.shift, bench)
        if command.measurement is not None:
            now = onward(now, bench, now.d, np.zeros(3), command.measurement.duration)
            goal, observed = now.d, measured(now, bench, rng)
            continue
        torque = np.zeros(3) if command.torque is None else command.torque
        now = onward(now, bench, goal, torque, bench.period)
    rows.append(row(now, bench, state, None))
    return rows


def total(rows, bench):
    """The centre of mass, masses where they are, (n, 3) m."""
    return np.array([r.shift for r in rows]) + bench.com


def tilts(rows):
    """Tilt, (n,) rad."""
    g = np.array([r.gravity for r in rows])
    return np.arccos(np.clip(-g @ UP / np.linalg.norm(g, axis=1), -1, 1))


def spring(gains):
    """Return X (m): how far the centre of mass would hang below P to swing as fast."""
    return gains.gamma * gains.mass * gains.gravity


def with_params(begun, **changes):
    """A beginning with other parameters."""
    return begun[0], replace(begun[1], **changes)
