"""Laws on a platform that other code moves: MuJoCo's bodies, rotors on hinges, masses on rails.

A simulator and a law that share a mistake agree with each other; here they share nothing but the
testbed. The inertia is 3 % off what the law is told.
"""

from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("mujoco", reason="MuJoCo is a development dependency")

from equipoise.control.coarse_fine import SAFE
from equipoise.io.presets import read_preset
from equipoise.model.bench import Bench
from equipoise.procedure.balance import BalanceOptions
from equipoise.procedure.laws import CARDS, balanced_and_followed, balanced_by
from tests.oracle.mujoco_live import MujocoBench, platform_of

LEVEL = np.zeros(3)
ASIDE, HEIGHT = 0.15e-6, 1.0e-6  # m
AN_HOUR = {"fully_actuated"}  # with the preset's wheels
LONGEST = {"planar_magnetic": 1500.0}  # s, its coils are weak


def bench_of(seed):
    bed = read_preset("reference-table")
    assert bed.magnetic_field is not None
    bed = replace(bed, magnetic_field=replace(bed.magnetic_field, noise=None))
    rng = np.random.default_rng(seed)
    com = rng.uniform([-8e-6, -8e-6, -140e-6], [8e-6, 8e-6, -80e-6])
    off = 1 + 0.03 * rng.normal(size=(3, 3))
    J = bed.body.inertia_P * (off + off.T) / 2
    start = np.array([0.04, -0.03, 0.5]), np.radians([0.2, -0.1, 0.2])
    return MujocoBench(bed, platform_of(bed, com, J, *start), seed)


def test_it_is_a_bench():
    assert isinstance(bench_of(0), Bench)


@pytest.mark.parametrize("law", sorted(set(CARDS) - AN_HOUR))
def test_it_balances_and_its_verdict_is_true(law):
    bench = bench_of(sum(map(ord, law)))
    *_, last = balanced_by(law, bench, BalanceOptions(LEVEL), LONGEST.get(law, 600.0))
    wanted = LEVEL - ([0.0, 0.0, SAFE] if law == "coarse_fine" else 0.0)
    off = np.abs(bench.com - wanted)
    assert off[:2].max() < ASIDE
    assert off[2] < HEIGHT
    told = last.verdict
    assert told.passed == (law != "coarse_fine")
    assert np.all(np.abs(told.com - bench.com) < 4 * told.sd + 0.05e-6)


def test_momentum_build_up_finds_it_to_a_twentieth_of_a_micrometre_and_masses_follow():
    """No sag, no drift: what it found of them is next to nothing, and following does no harm."""
    bench = bench_of(5)
    steps = list(
        balanced_and_followed("momentum_buildup", bench, BalanceOptions(LEVEL), 600.0, 60.0)
    )
    told = next(step.following for step in steps if step.following is not None)
    assert np.abs(told.sag).max() < 2e-6
    assert np.abs(told.drift).max() * 600 < 0.5e-6
    assert "masses followed" in steps[-2].sentence
    assert np.abs(bench.com[:2]).max() < 0.05e-6
    assert abs(bench.com[2]) < 0.3e-6
    assert steps[-1].verdict.passed
