"""The truth that torque by cause is judged by, on platforms whose torque is known by hand."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.io.testbed.presets import read_preset
from equipoise.model.torque_by_cause import AIR, CONTACTS, DRIFT, GRAVITY, MOVES
from equipoise.study.true_torque import TrueTorqueBench

COM = np.array([0.0, 0.0, -1e-4])
WEIGHT = 14.24 * 9.81


def bench_of(**truth):
    testbed = read_preset("sputnix")
    given = {"com": COM, "attitude": np.zeros(3), "rate": np.zeros(3)} | truth
    return TrueTorqueBench(replace(testbed, truth=replace(testbed.truth, **given)), 1)


def test_a_platform_that_hangs_level_has_no_torque():
    bench = bench_of()
    bench.read(3.0)
    assert np.abs(bench.torque_by_cause(np.arange(4.0))).max() < 1e-10


def test_weight_off_to_one_side_turns_the_platform_at_first():
    bench = bench_of(com=np.array([2e-6, 0.0, -1e-4]))
    bench.read(1.0)
    found = bench.torque_by_cause(np.array([0.0, 0.2]))[0]
    assert found[GRAVITY] == pytest.approx([0.0, 2e-6 * WEIGHT, 0.0], rel=2e-3, abs=1e-7)
    assert np.abs(found[[MOVES, CONTACTS, DRIFT]]).max() < 1e-8


def test_constant_torque_and_drift_are_their_own():
    bench = bench_of(torque={"constant_z": 4e-6, "drift_x": 1e-7})
    bench.read(4.0)
    found = bench.torque_by_cause(np.arange(5.0))
    assert found[:, AIR, 2] == pytest.approx(np.full(4, 4e-6), rel=1e-9)
    middle = 1e-7 * (np.arange(4) + 0.5) * WEIGHT  # near level still
    assert found[:, DRIFT, 1] == pytest.approx(middle, rel=1e-3)


def test_a_mass_that_went_adds_its_weight():
    bench = bench_of()
    bench.read(1.0)
    bench.move({"x1": 2e-3})
    bench.read(2.0)
    found = bench.torque_by_cause(np.arange(4.0))
    where = bench.displacements[0]
    assert np.abs(found[0]).max() < 5e-9
    assert found[2, MOVES, 1] == pytest.approx(0.0156 * where * 9.81, rel=2e-2)
