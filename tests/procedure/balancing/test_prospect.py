"""What to expect of a law on a testbed."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.control.laws.fully_actuated import LAW
from equipoise.io.testbed.presets import read_preset
from equipoise.procedure.balancing.catalogue import CARDS
from equipoise.procedure.balancing.prospect import prospect

LEVEL = np.zeros(3)


def test_a_law_that_can_calculate_its_time_says_it():
    bed = read_preset("tas2")
    found = prospect(CARDS["fully_actuated"], bed, LEVEL)
    assert (found.missing, found.refused) == ((), None)
    assert found.expected == LAW.expected(LAW.begin(bed, LEVEL)[1])


@pytest.mark.parametrize("law", ["measure_and_move", "momentum_buildup"])
def test_others_can_be_used_without_a_time(law):
    found = prospect(CARDS[law], read_preset("tas2"), LEVEL)
    assert (found.missing, found.refused, found.expected) == ((), None, None)


def test_missing_devices_are_named_and_nothing_is_begun():
    found = prospect(CARDS["fully_actuated"], read_preset("sputnix"), LEVEL)
    assert found.missing == ("momentum", "gyro")
    assert (found.refused, found.expected) == (None, None)


def test_why_a_law_would_not_be_stable():
    table = read_preset("reference-table")
    weak = replace(table, wheels=tuple(replace(w, max_torque=1e-4) for w in table.wheels))
    found = prospect(CARDS["fully_actuated"], weak, LEVEL)
    assert found.expected is None
    assert found.refused is not None
    assert "8e-05 N m" in found.refused
    assert "stronger devices" in found.refused
