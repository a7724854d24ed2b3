"""Balancing by hand a platform that other code moves: every weight a body welded to another.

MuJoCo adds the weights to the platform; where each lies is worked out here from the drawing of the
grid, with no word from `actuators.placed_weights`.
"""

from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("mujoco", reason="MuJoCo is a development dependency")

from equipoise.io.testbed.presets import read_preset
from equipoise.model.hands import Hands
from equipoise.model.mass_properties import parallel_axis
from equipoise.model.units import UM
from equipoise.model.weights import places_of
from equipoise.procedure.balancing.balance import BalanceOptions
from equipoise.procedure.balancing.balance_manually import HandOptions, balance_by_hand
from equipoise.procedure.balancing.catalogue import balanced_by
from equipoise.procedure.balancing.hands_then_masses import hands_then_masses
from tests.oracle import mujoco_bench as oracle
from tests.oracle.mujoco_live import MujocoBench, platform_of
from tests.support import thorough

BED = read_preset("weights-by-hand")
TARGET = np.array([0.0, 0.0, -100 * UM])
GROW = {"deck": [0, 0, 1], "left": [0, 1, 0], "right": [0, -1, 0]}  # piles, away from the frame


class MujocoHands:
    """A platform that is off with an inertia 10 % off, and weights of one kind on it."""

    def __init__(self, seed: int, testbed=BED, off: float = 500 * UM) -> None:
        self.rng, self.testbed = np.random.default_rng(seed), testbed
        direction = self.rng.normal(size=3)
        self.com = off * direction / np.linalg.norm(direction)
        J = np.diag(np.diag(testbed.body.inertia_C) * self.rng.uniform(0.9, 1.1, 3))
        self.J_P = J + parallel_axis(testbed.body.mass, self.com)
        self.slides: tuple[oracle.Slide, ...] = ()
        self.time = 0.0

    def place(self, wanted):
        slides, (kind,) = [], self.testbed.weights
        for place, (count,) in zip(places_of(self.testbed.grids), wanted, strict=True):
            up = np.array(GROW[place.grid.name], float)
            for i in range(count):
                x = place.foot + (0.5 + i) * kind.height * up
                mass = kind.mass + self.rng.normal(0, kind.mass_sd)
                slides.append(oracle.Slide(f"w{len(slides)}", mass, x, up))
        self.slides = tuple(slides)
        return wanted

    def loaded(self):
        """Return the platform with its weights, let go about level."""
        points, bare = [(s.mass, s.home) for s in self.slides], self.testbed.body.mass
        mass = bare + sum(m for m, _ in points)
        moment = bare * self.com + sum((m * x for m, x in points), np.zeros(3))
        weights = (parallel_axis(m, x) + oracle.POINT * np.eye(3) for m, x in points)
        J = self.J_P + sum(weights, np.zeros((3, 3)))
        q, _ = oracle._random_start(self.rng, np.radians(2.0))
        rate = np.radians(self.rng.uniform(-0.3, 0.3, 3))
        return oracle.Platform(mass, J, moment / mass, self.slides, self.testbed.gravity, q, rate)

    def swing(self):
        run = oracle.simulate(self.loaded(), duration=60.0, dt=0.01, locked=True)
        lean = np.arccos(np.clip(1 - 2 * (run.q[:, 1] ** 2 + run.q[:, 2] ** 2), -1, 1))
        beyond = np.flatnonzero(lean > self.testbed.tilt_limit)
        end = run.t[beyond[0]] if len(beyond) else run.t[-1]
        log = oracle.sensor_log(
            run, self.rng, self.testbed.attitude.rate, self.testbed.attitude.noise, 50.0,
            self.testbed.gyro.noise, self.rng.normal(0.0, 0.002, 3),
        )  # fmt: skip
        observed = log.attitude.t <= end, log.rate.t <= end
        self.time += end
        rows = [
            type(c)(c.t[keep], c.values[keep])
            for c, keep in zip((log.attitude, log.rate), observed, strict=True)
        ]
        return replace(log, attitude=rows[0], rate=rows[1], mass_names=(), masses=None)


@pytest.mark.parametrize("seed", thorough.some([1, 2], 1))
def test_half_a_millimetre_becomes_five_micrometres_on_mujoco(seed):
    """Within four rounds, and what is stated of com and J on the way covers the truth."""
    hands = MujocoHands(seed)
    assert isinstance(hands, Hands)
    errors, rounds = [], 0
    for step in balance_by_hand(hands, HandOptions(TARGET)):
        if step.estimate is not None and step.kind == "estimate":
            real = hands.loaded()
            found, sd = step.estimate.com, np.sqrt(np.diag(step.estimate.covariance))
            errors += [*(found - real.com) / sd[:3]]
            errors += [*np.diag(step.estimate.inertia_P - real.inertia_P) / sd[3:6]]
        rounds += step.placing is not None
        last = step
    assert rounds <= 4
    assert last.verdict.passed
    assert np.linalg.norm(hands.loaded().com - TARGET) < 5 * UM
    assert np.abs(errors).max() < 4.0
    assert np.sqrt(np.mean(np.square(errors))) < 1.8


def test_masses_go_on_where_hands_end_on_mujoco():
    """300 um off, blocks of 5 g welded to it, then masses on slide joints: 2 um and 3 um.

    Nothing of `actuators` moves the truth: MuJoCo adds the blocks, and carries the masses.
    """
    bed = replace(read_preset("two-level"), gyro=BED.gyro)
    hands, benches = MujocoHands(3, bed, 300 * UM), []

    def go_on(known):
        loaded = hands.loaded()
        errors = np.append(known.body.com - loaded.com,
                           np.diag(known.body.inertia_P - loaded.inertia_P))  # fmt: skip
        sd = np.sqrt(np.diag(known.body_covariance))[[6, 7, 8, 0, 1, 2]]
        assert np.abs(errors / sd).max() < 4.0
        start = np.array([0.02, -0.03, 0.5]), np.radians([0.2, -0.1, 0.2])
        platform = platform_of(known, loaded.com, loaded.inertia_P, *start)
        benches.append(MujocoBench(known, platform, 3))
        return balanced_by("measure_and_move", benches[0], BalanceOptions(), None)

    *_, last = hands_then_masses(hands, HandOptions(), go_on)
    assert last.verdict.outcome.value in {"passed", "undecided"}
    assert np.all(np.abs(benches[0].com - TARGET) <= np.array([2, 2, 3]) * UM)
