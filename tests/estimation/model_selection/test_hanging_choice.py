"""What sags is taken for a mass that hangs, for one that bends, or for neither."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.estimation.events.record_model import improbability
from equipoise.estimation.model_selection.hanging_choice import SAG, is_shaken, with_hanging_mass
from equipoise.model.defects import Contact
from equipoise.model.recording import joined
from equipoise.simulation.bench import SimulatedBench
from tests.support.hanging_records import hanging_record, plain_model
from tests.support.modal_records import MOVED, modal_testbed

BENDING = 2e-5  # m
TILTED = np.radians([15.0, -9.0, 30.0])


def record_of(seed, **changed):
    """Return a record of a platform whose truth is changed so, and its testbed."""
    testbed = modal_testbed()
    truth = replace(testbed.truth, **changed)
    bench = SimulatedBench(replace(testbed, truth=truth), seed)
    first = bench.read(MOVED)
    bench.move({"x": 0.0006})
    return joined([first, bench.read(30.0)]), replace(testbed, truth=None)


def bending_record(seed):
    """Return a record of a platform that bends along x and swings by some 15 deg; its testbed.

    c x x^T is c / 3 of (2, -1, -1) but for c / 3 of E, which gives no torque.
    """
    torque = {"sag_xx": 2 * BENDING / 3, "sag_yy": -BENDING / 3}
    return record_of(seed, torque=torque, attitude=TILTED)


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


@pytest.mark.parametrize("contacts", [(), (Contact(27.0, np.array([5e-4, -3e-4, 2e-4])),)])
def test_a_touch_is_an_event_and_hangs_nowhere(contacts):
    """It changes rates by 1 mrad/s, six times the noise of one row of the gyro."""
    model = plain_model(*record_of(4, contacts=contacts))
    assert is_shaken(model, improbability(model)) is bool(contacts)
    assert with_hanging_mass(model) is model


def test_a_declared_sag_is_none_to_be_sought():
    record = hanging_record(1)
    model = plain_model(record.recording, record.testbed)
    declared = replace(model, params=replace(model.params, terms=SAG))
    assert with_hanging_mass(declared) is declared
