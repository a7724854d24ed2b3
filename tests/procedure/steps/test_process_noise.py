"""Process noise as a testbed states it: its size, and what a short record then claims to know."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.io.testbed.presets import read_preset
from equipoise.model.estimate import COM, RATE
from equipoise.procedure.steps.joint_fit import learn_alone
from equipoise.procedure.steps.process_noise import process_noise
from equipoise.simulation.bench import SimulatedBench

FINE = read_preset("nanosat-fine")
AIR = 4e-7  # N m, as the preset states it and its truth has it
NEARLY = np.array([20e-9, 20e-9, 50e-9])  # m, as after balancing
LASTS, SEEDS = 40.0, 16


def test_it_is_as_large_as_the_testbed_states_it():
    """4e-7 N m for 30 s, white: 2 s of it turn 0.043 kg m^2 by 4e-7 sqrt(120) / 0.043 rad/s."""
    bed = replace(FINE, air_torque=4e-7, com_walk=1e-8, body=replace(
        FINE.body, com=np.zeros(3), inertia_P=np.diag([0.043, 0.043, 0.027])))  # fmt: skip
    jumps = process_noise(bed, (100.0, 110.0))
    assert [jump.t for jump in jumps] == pytest.approx([102.0, 104.0, 106.0, 108.0])
    (first, *_) = jumps
    assert first.is_noise
    assert first.names == (*RATE, *COM)
    across, along = 1.0190e-4, 1.6229e-4  # rad/s
    walked = 1e-8 * (2 / 60) ** 0.5
    assert first.sd == pytest.approx([across, across, along, walked, walked, walked], rel=1e-4)


def errors_in_sd(stated):
    """Errors of com of nearly balanced platforms in real air, a row a seed, if so much is stated"""
    assert FINE.truth is not None
    truth = replace(FINE.truth, com_low=-NEARLY, com_high=NEARLY, noise_torque=AIR, torque={})
    out = []
    for seed in range(SEEDS):
        bench = SimulatedBench(replace(FINE, truth=truth, air_torque=stated), seed)
        known = learn_alone(bench.read(LASTS), bench.testbed)
        out.append((known.com - bench.truth().com) / known.sd)
    return np.array(out)


def test_a_record_in_air_errs_by_as_much_as_it_says():
    """The noise is a bound of the play's density: intervals are up to twice too wide."""
    z = errors_in_sd(AIR)
    assert 0.4 < float(np.sqrt(np.mean(z**2))) < 1.2


def test_it_is_wrong_where_air_is_not_stated():
    assert float(np.sqrt(np.mean(errors_in_sd(AIR / 100) ** 2))) > 1.5
