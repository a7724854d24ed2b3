"""A plain loop around a law: the true platform between steps, masses that travel, ideal jets.

Masses travel at their speed and stop on whole steps. Jets and wheels give what is asked, at once. A
look is an Estimate near the truth: no estimator is run here.
"""

from dataclasses import dataclass, replace

import numpy as np

from equipoise.actuators.mass_allocation import rails_of, without_delay
from equipoise.actuators.sliding_masses import com_shift, mass_maps
from equipoise.control.law import Law, Sample
from equipoise.dynamics.propagation import body_of
from equipoise.dynamics.rigid_body import KNOWN_D
from equipoise.maths.attitude import exponential, level, multiply, to_matrix
from equipoise.maths.linalg import pack_symmetric
from equipoise.model.command import Command
from equipoise.model.devices import JetPair
from equipoise.model.estimate import COM, Estimate, Parameter
from equipoise.model.mass_properties import MassProperties
from equipoise.model.reasons.reason import Reason
from equipoise.model.testbed import AttitudeSensor, Gyro, SlidingMass, Testbed
from equipoise.simulation.motion import run
from tests.support.outcomes import of_use

MASS, GRAVITY = 14.0, 9.81
INERTIA = np.diag([0.30, 0.28, 0.45])
OFFSET = np.array([60.0, -40.0, -150.0]) * 1e-6
UP = np.array([0.0, 0.0, 1.0])
CALM = (0.0, 0.0)  # rad, rad/s: perfect sensors
NOISE = (2e-4, 2e-4)  # rad and rad/s per axis, of attitude and rate as filtered


def masses(speed: float = 1e-3, coarse: float = 1e-4, fine: float = 1e-5) -> tuple:
    """Three masses of 200 g and three of 20 g along x, y, z; m/s and m a step."""
    homes = (np.array([0.2, 0, 0]), np.array([0, 0.2, 0]), np.array([0, 0, 0.15]))
    kinds = ((0.2, 0.07, coarse, "coarse"), (0.02, 0.02, fine, "fine"))
    return tuple(
        SlidingMass(
            f"{kind} {'xyz'[i]}", mass, homes[i], np.eye(3)[i], (-reach, reach), step, 0.0, 0.0,
            speed, 0.0, 0.0,
        )
        for mass, reach, step, kind in kinds
        for i in range(3)
    )  # fmt: skip


def table(com=OFFSET, inertia=INERTIA, **kwargs) -> Testbed:
    """The reference table; as guessed where ``com`` and ``inertia`` are guesses."""
    jets = tuple(JetPair(f"jet {'xyz'[i]}", np.eye(3)[i], 0.2) for i in range(3))
    guess = MassProperties(MASS, np.asarray(com, dtype=float), inertia)
    return Testbed(
        "table", guess, 0.1, np.full(3, 50e-6), UP, np.radians(30), GRAVITY,
        kwargs.pop("masses", masses()), AttitudeSensor(50.0, NOISE[0]),
        Gyro(50.0, NOISE[1], 1e-3), jets=jets, **kwargs,
    )  # fmt: skip


def guess() -> Testbed:
    """What is known beforehand: 50 um high and sideways off, moments 7 % off."""
    return table(np.array([0.0, 0.0, -100e-6]), np.diag([0.32, 0.26, 0.45]))


@dataclass(eq=False)
class Run:
    """What happened, a row a step."""

    t: np.ndarray
    tilt: np.ndarray  # rad
    rate: np.ndarray  # (n, 3) rad/s
    com: np.ndarray  # (n, 3) m, the centre of mass as it truly was
    commands: list[Command]
    states: list
    measurements: int = 0

    @property
    def finished(self) -> tuple[Reason, ...]:
        return self.commands[-1].finished

    @property
    def left(self) -> np.ndarray:
        """Where the centre of mass is at the end, m."""
        return self.com[-1]


class Plant:
    """The true platform and where its masses are."""

    def __init__(self, truth: Testbed, tilt, rate):
        self.testbed, self.maps = truth, mass_maps(truth.masses)
        body = truth.body
        inertia = pack_symmetric(body.inertia_P)
        self.body = body_of(body.mass, truth.gravity, inertia, body.first_moment)
        self.d, self.rails = np.zeros(len(truth.masses)), rails_of(truth.masses, body.mass)
        self.goal = self.d.copy()
        q = multiply(exponential(np.asarray(tilt, dtype=float)), level(truth.up))
        self.y = np.concatenate([q, body.inertia_P @ np.asarray(rate, dtype=float)])
        self.rate = np.asarray(rate, dtype=float)
        self.time, self.momentum = 0.0, np.zeros(3)

    @property
    def shift(self):
        return com_shift(self.maps, self.testbed.body.mass, self.d)

    @property
    def com(self):
        return self.testbed.body.com + self.shift

    def request(self, shift):
        """To whole steps, the fine masses first and the coarse ones as far as they must."""
        self.goal = without_delay(self.rails, self.goal, self.d, np.asarray(shift, dtype=float))

    def go(self, period, torque=None, impulse=None):
        """Let ``period`` s pass."""
        n = max(2, int(np.ceil(period / 0.05)) + 1)
        t = np.linspace(0.0, period, n)
        speed = np.array([mass.speed for mass in self.testbed.masses])
        way = self.goal - self.d
        share = np.minimum(t[:, None] * speed, np.abs(way))
        known = np.zeros((n, KNOWN_D + len(way)))
        known[:, 3:6] = 0.0 if torque is None else torque
        known[:, KNOWN_D:] = self.d + np.sign(way) * share
        if impulse is not None:
            self.y[4:] += impulse
        path = run(self.body, np.hstack(self.maps), self.y, t, known)
        self.y, self.rate, self.d = path.y[-1].copy(), path.rate[-1], known[-1, KNOWN_D:]
        self.time += period


def estimate(plant: Plant, scale_error: float) -> Estimate:
    """The centre of mass as a look might give it: the scale of free motion is open by so much."""
    com = (1 + scale_error) * plant.com - plant.shift
    sd = np.abs(plant.com) * abs(scale_error) + 1e-8
    rows = tuple(Parameter(*each) for each in zip(COM, "mmm", com, sd, strict=True))
    return Estimate("trajectory", of_use(), rows, np.diag(sd**2))


class Loop:
    """A law, a plant, noise from a seed."""

    def __init__(self, plant, noise=CALM, seed=0):
        self.plant, self.noise, self.rng = plant, noise, np.random.default_rng(seed)

    def sample(self, torque, impulse):
        plant, (attitude, rate) = self.plant, self.noise
        q = multiply(plant.y[:4], exponential(attitude * self.rng.normal(size=3)))
        w = plant.rate + rate * self.rng.normal(size=3)
        gravity = to_matrix(q).T @ np.array([0.0, 0.0, -plant.testbed.gravity])
        return Sample(
            plant.time, q, w, gravity, plant.shift, plant.momentum, torque, impulse, None
        )  # fmt: skip


def fly(law: Law, begun, loop, duration, scale_error=0.05) -> Run:
    """Run a law until it has finished, or for ``duration`` s.

    As ``procedure.run_law`` does: with a look or the end nothing is moved any more.
    """
    plant, (state, params) = loop.plant, begun
    out = Run(*(np.zeros(0) for _ in range(4)), [], [])
    rows: list[tuple] = []
    observed = loop.sample(np.zeros(3), np.zeros(3))
    while plant.time < duration:
        state, command = law.step(state, observed, params)
        out.commands.append(command)
        out.states.append(state)
        if command.finished:
            break
        if command.shift is not None and command.measurement is None:
            plant.request(command.shift)
        if command.measurement is not None:
            plant.go(command.measurement.duration)
            out.measurements += 1
            observed = estimate(plant, scale_error)
        else:
            plant.go(law.card.period, command.torque, command.impulse)
            torque = np.zeros(3) if command.torque is None else command.torque
            impulse = np.zeros(3) if command.impulse is None else command.impulse
            observed = loop.sample(torque, impulse)
        up_N = to_matrix(plant.y[:4]) @ plant.testbed.up
        rows.append((plant.time, np.arccos(np.clip(up_N[2], -1, 1)), plant.rate, plant.com))
    t, tilt, rate, com = (np.array(column) for column in zip(*rows, strict=True))
    return replace(out, t=t, tilt=tilt, rate=rate, com=com)
