"""Balancing a platform that drag brakes or a steady torque turns, which nobody declared."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.io.testbed.presets import read_preset
from equipoise.model.reasons.estimate_reasons import EstimateReason as Why
from equipoise.model.torque_terms import expand
from equipoise.procedure.balancing.balance import BalanceOptions, balance
from equipoise.simulation.bench import SimulatedBench
from tests.support import thorough

SPUTNIX = read_preset("sputnix")
MOMENTS = np.diag(SPUTNIX.body.inertia_P)  # kg m2
TORQUES = {
    "viscous": MOMENTS / 200.0,  # N m s: rates fall by a factor e in 200 s
    "swirl": np.array([2e-5]),  # N m, of the air: a turn of 10 deg in two minutes
}


def balanced(group: str, seed: int):
    """Return the true offset (m) and the steps of a platform with such a torque."""
    torque = dict(zip(expand((group,)), TORQUES[group].tolist(), strict=True))
    testbed = replace(SPUTNIX, truth=replace(SPUTNIX.truth, torque=torque))
    bench = SimulatedBench(testbed, seed)
    steps = list(balance(bench, BalanceOptions()))
    return bench.truth().com - BalanceOptions().target, steps


@pytest.mark.parametrize("group", TORQUES)
@pytest.mark.parametrize("seed", thorough.some((0, 1), 1))
def test_a_torque_that_nobody_declared_is_explained_and_balanced(group, seed) -> None:
    """With drift alone among what is considered, no such record explained itself.

    Damping is named as such. A steady torque may be of the air or of the body: neither is named for
    sure, nor is it damping.
    """
    off, steps = balanced(group, seed)
    judged = steps[-1].verdict
    assert judged.passed
    assert np.all(np.abs(off) < BalanceOptions().tolerance)
    assert np.all(np.abs(judged.com - BalanceOptions().target - off) < 4.0 * judged.sd)
    named = {name for step in steps for r in step.reasons if r.code is Why.TERMS_TO_DECLARE
             for name in r.parameters}  # fmt: skip
    assert named == {"viscous"} if group == "viscous" else named <= {"swirl", "constant"}
