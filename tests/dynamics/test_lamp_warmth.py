"""The warmth of a lamp, by hand and as superposed."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.dynamics.lamp_warmth import MOST, lamp_warmth, temperature_of, warms
from equipoise.io.testbed.presets import read_preset
from equipoise.maths.straight_lines import read_at
from equipoise.model.devices import Lamp
from equipoise.model.recording import Recording, Samples

LAMP = Lamp(warms=3.0, time_constant=100.0)


def rows(*pairs) -> Samples:
    t, values = zip(*pairs, strict=True)
    return Samples(np.array(t), np.array(values)[:, None])


def at(warmth: Samples, t: float) -> float:
    return float(read_at(np.array([t]), warmth.t, warmth.values)[0, 0])


def test_it_comes_and_goes_as_one_minus_an_exponential():
    """On at 50 s, off at 150 s: 3 K (1 - 1/e) by then, which is down to 1/e of it 100 s later."""
    warmth = lamp_warmth(rows((0.0, 0.0), (50.0, 1.0), (150.0, 0.0)), LAMP, 250.0)
    peak = 3.0 * (1.0 - np.exp(-1.0))
    assert at(warmth, 50.0) == 0.0
    assert at(warmth, 150.0) == pytest.approx(peak, rel=1e-12)
    assert at(warmth, 250.0) == pytest.approx(peak * np.exp(-1.0), rel=1e-12)
    assert at(warmth, 100.7) == pytest.approx(3.0 * -np.expm1(-0.507), rel=2e-4)


def test_before_the_first_row_it_is_settled():
    warmth = lamp_warmth(rows((0.0, 0.5), (10.0, 0.5)), LAMP, 60.0)
    np.testing.assert_allclose(warmth.values, 1.5, rtol=1e-12)


def test_switches_superpose():
    """Half on at 20 s and full at 70 s is half of each by itself."""
    both = lamp_warmth(rows((0.0, 0.0), (20.0, 0.5), (70.0, 1.0)), LAMP, 200.0)
    first, second = (lamp_warmth(rows((0.0, 0.0), (t, 1.0)), LAMP, 200.0) for t in (20.0, 70.0))
    assert at(both, 200.0) == pytest.approx(0.5 * (at(first, 200.0) + at(second, 200.0)), rel=1e-12)


def test_nodes_do_not_grow_with_a_time_stamp():
    assert len(lamp_warmth(rows((0.0, 0.0), (1.0, 1.0)), LAMP, 1e12)) <= MOST + 2


def test_a_thermometer_knows_better():
    """And without a lamp in the testbed a switch says nothing."""
    testbed = replace(read_preset("sputnix"), lamp=LAMP)
    record = Recording(rate=Samples(np.array([0.0, 9.0]), np.zeros((2, 3))),
                       lamp=rows((0.0, 0.0), (1.0, 1.0)))  # fmt: skip
    assert warms(record, testbed)
    assert not warms(record, replace(testbed, lamp=None))
    read = replace(record, temperature=rows((0.0, 21.0), (9.0, 22.0)))
    assert temperature_of(read, testbed) is read.temperature
