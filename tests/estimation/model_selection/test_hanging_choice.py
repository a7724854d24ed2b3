"""What sags is taken for a mass that hangs, for one that bends, or for neither."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.estimation.model_selection.hanging_choice import SAG, with_hanging_mass
from equipoise.model.recording import joined
from equipoise.simulation.bench import SimulatedBench
from tests.support.hanging_records import hanging_record, plain_model
from tests.support.modal_records import MOVED, modal_record, modal_testbed

BENDING = 2e-5  # m
TILTED = np.radians([15.0, -9.0, 30.0])


def bending_record(seed):
    """Return a record of a platform that bends along x and swings by some 15 deg; its testbed.

    c x x^T is c / 3 of (2, -1, -1) but for c / 3 of E, which gives no torque.
    """
    testbed = modal_testbed()
    torque = {"sag_xx": 2 * BENDING / 3, "sag_yy": -BENDING / 3}
    truth = replace(testbed.truth, torque=torque, attitude=TILTED)
    bench = SimulatedBench(replace(testbed, truth=truth), seed)
    first = bench.read(MOVED)
    bench.move({"x": 0.0006})
    return joined([first, bench.read(30.0)]), replace(testbed, truth=None)


def test_a_pendulum_hangs():
    record = hanging_record(1)
    found = with_hanging_mass(plain_model(record.recording, record.testbed))
    assert found.hanging is not None
    assert found.hanging.mass.sag == pytest.approx(record.mass.sag, rel=0.3)


def test_what_bends_is_not_taken_for_a_pendulum():
    recording, testbed = bending_record(1)
    found = with_hanging_mass(plain_model(recording, testbed))
    if found.hanging is not None:  # a spring that is stiff beside gravity
        mass = found.hanging.mass
        assert mass.spring > 0.6
        assert mass.sag == pytest.approx(BENDING, rel=0.1)


def test_nothing_hangs_in_a_rigid_platform():
    recording, testbed, _ = modal_record(4)
    model = plain_model(recording, testbed)
    assert with_hanging_mass(model) is model


def test_a_declared_sag_is_none_to_be_sought():
    record = hanging_record(1)
    model = plain_model(record.recording, record.testbed)
    declared = replace(model, params=replace(model.params, terms=SAG))
    assert with_hanging_mass(declared) is declared
