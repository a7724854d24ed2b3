"""Laws with magnetorquers in a cage that is not quite what it is stated to be."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.control.laws import planar_magnetic
from equipoise.io.testbed.presets import read_preset
from equipoise.model.defects import TrueCoilPair
from equipoise.model.devices import CoilPair, Magnetorquer
from equipoise.model.errors import InputError
from equipoise.model.vector_sensors import Magnetometer
from equipoise.procedure.balancing.run_law import LawOptions, first_sight, lacking, run_law
from equipoise.simulation.bench import SimulatedBench
from tests.support import thorough

FIELD = (100e-6, 0.0, -100e-6)  # T, as the preset's
SENSOR = Magnetometer(20.0, 2e-7, 0.0)


def caged(magnetometer=None):
    """The reference table in a cage that gives what its [magnetic_field] had."""
    bed = read_preset("reference-table")
    pairs = tuple(
        CoilPair(f"c{a}", axis, 2e-4, field, 0.1, 0.01, 0.003, 0.01)
        for a, axis, field in zip("xyz", np.eye(3), FIELD, strict=True)
    )
    true = (TrueCoilPair("cx", 1.01), TrueCoilPair("cz", 0.99, np.array([0.002, 0.0, 1.0])))
    truth = replace(bed.truth, cage=true)
    return replace(
        bed, coil_pairs=pairs, magnetic_field=None, magnetometer=magnetometer, truth=truth
    )


@pytest.mark.parametrize("magnetometer", thorough.some([None, SENSOR], 1))
def test_masses_and_coils_balance_in_a_cage(magnetometer):
    """It passes as on a bench whose field is stated; what is left is below 3 um."""
    bench = SimulatedBench(caged(magnetometer), 3)
    aim = LawOptions(np.zeros(3), np.full(3, 3e-6), max_time=1500.0)
    *_, last = run_law(bench, planar_magnetic.LAW, aim)
    assert last.verdict.outcome == "passed"
    assert np.abs(bench.truth().com).max() < 3e-6


def test_a_law_knows_the_field_that_the_cage_was_driven_to():
    """Without a magnetometer what the coils report, turned; with one what it measured."""
    for sensor, close in ((None, 1e-9), (SENSOR, 4e-6)):
        bench = SimulatedBench(caged(sensor), 3)
        bench.drive({"cx": 50e-6})
        bench.read(2.0)
        session, sample = first_sight(bench)
        assert np.linalg.norm(sample.field) == pytest.approx(np.hypot(50e-6, 100e-6), abs=close)
        assert len(session.eyes.states) == len(bench.testbed.devices)


def test_a_cage_is_a_field_for_coils_and_no_cage_is_none():
    card = planar_magnetic.LAW.card
    assert "magnetorquers" not in lacking(card, caged())
    assert "magnetorquers" in lacking(card, replace(caged(), coil_pairs=()))
    off = tuple(replace(pair, field=0.0) for pair in caged().coil_pairs)
    with pytest.raises(InputError, match="coils that give 0 N m"):
        planar_magnetic.LAW.begin(replace(caged(), coil_pairs=off), np.zeros(3))
    assert all(isinstance(coil, Magnetorquer) for coil in caged().magnetorquers)
