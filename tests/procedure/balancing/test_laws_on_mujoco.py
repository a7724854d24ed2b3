"""Laws on a platform that other code moves: `verification/laws_on_mujoco.py` with few laws."""

import numpy as np
import pytest

pytest.importorskip("mujoco", reason="MuJoCo is a development dependency")

from equipoise.app.runs.balancing import Goal, Limits, procedure
from equipoise.model.bench import Bench
from equipoise.procedure.balancing.balance import BalanceOptions
from tests.support import thorough
from verification import laws_on_mujoco
from verification.laws_on_mujoco import bench_of


def test_it_is_a_bench():
    assert isinstance(bench_of(0), Bench)


@pytest.mark.parametrize("law", thorough.some(["measure_and_move", "coarse_fine"], 1))
def test_it_balances_and_its_verdict_is_true(law):
    assert laws_on_mujoco.measure([sum(map(ord, law))], laws=(law,)).missed == ()


@thorough.whole
def test_momentum_build_up_finds_it_to_a_twentieth_of_a_micrometre_and_masses_follow():
    """No sag, no drift: what it found of them is next to nothing, and following does no harm.

    The verdict before, a minute of following, and the verdict after, as `balance --hold-min 1`.
    """
    bench, goal = bench_of(5), Goal(np.zeros(3), BalanceOptions().tolerance)
    limits = Limits(max_time=600.0, hold=60.0, law="momentum_buildup")
    steps = list(procedure(bench, goal, limits))
    reported = next(step.following for step in steps if step.following is not None)
    assert np.abs(reported.sag).max() < 2e-6
    assert np.abs(reported.drift).max() * 600 < 0.5e-6
    assert steps[-2].sentence == "follow for 59 s of bench time: Masses followed tilt and drift."
    assert sum(step.verdict is not None and step.verdict.passed for step in steps) >= 2
    assert np.abs(bench.com[:2]).max() < 0.05e-6
    assert abs(bench.com[2]) < 0.3e-6
    assert steps[-1].verdict.passed
