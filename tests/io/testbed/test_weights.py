"""Weights and their places in a testbed file: units, round trip, and what cannot be."""

import numpy as np
import pytest

from equipoise.io.testbed.presets import read_preset
from equipoise.io.testbed.testbed_file import json_schema, parse_testbed, text_of_testbed
from equipoise.model.errors import InputError
from equipoise.model.weights import places_of

PLATFORM = """
name = "t"
[platform]
mass_kg = 10.0
inertia_kg_m2 = [[0.3, 0, 0], [0, 0.3, 0], [0, 0, 0.3]]
"""
WEIGHT = """
[[weight]]
name = "washer"
mass_g = 1.02
count = 30
mass_sd_g = 0.01
height_mm = 1.6
"""
GRID = """
[[weight_grid]]
name = "deck"
first_mm = [-100.0, -50.0, 120.0]
letter_axis = [2.0, 0.0, 0.0]
number_axis = [0.0, 1.0, 0.0]
step_mm = 25.0
letters = 9
numbers = 5
capacity = 8
place_sd_mm = 0.3
taken = ["E3"]
"""
PLATFORM = PLATFORM.replace("[[0.3, 0, 0], [0, 0.3, 0], [0, 0, 0.3]]",
                            "[[0.3, 0.0, 0.0], [0.0, 0.3, 0.0], [0.0, 0.0, 0.3]]")  # fmt: skip
WHOLE = PLATFORM + WEIGHT + GRID


def test_units_of_the_file_become_si():
    testbed = parse_testbed(WHOLE, "t.toml")
    (weight,), (grid,) = testbed.weights, testbed.grids
    assert (weight.name, weight.count) == ("washer", 30)
    assert weight.mass == pytest.approx(1.02e-3)
    assert weight.mass_sd == pytest.approx(1e-5)
    assert weight.height == pytest.approx(1.6e-3)
    np.testing.assert_allclose(grid.first, [-0.1, -0.05, 0.12])
    np.testing.assert_allclose(grid.letter_axis, [1, 0, 0])
    assert grid.step == pytest.approx(0.025)
    assert grid.place_sd == pytest.approx(3e-4)
    assert len(places_of(testbed.grids)) == 9 * 5 - 1


@pytest.mark.parametrize("source", ["file", "preset"])
def test_written_and_read_again_it_is_the_same(source):
    first = parse_testbed(WHOLE, "t") if source == "file" else read_preset("weights-by-hand")
    text = text_of_testbed(first)
    again = parse_testbed(text, "t")
    assert text_of_testbed(again) == text
    assert [p.name for p in places_of(again.grids)] == [p.name for p in places_of(first.grids)]
    for a, b in zip(places_of(again.grids), places_of(first.grids), strict=True):
        np.testing.assert_allclose([*a.foot, *a.up], [*b.foot, *b.up], atol=1e-15)
    for key in ("name", "mass", "count", "mass_sd", "height"):
        assert getattr(again.weights[0], key) == getattr(first.weights[0], key)


BAD = {
    "unknown key": (WHOLE.replace("height_mm", "hight_mm"), r"weight\[1\].hight_mm.*'height_mm'"),
    "another unit": (WHOLE.replace("step_mm", "step_cm"), "the unit belongs to the key"),
    "no weights": (PLATFORM + WEIGHT.replace("count = 30", "count = 0") + GRID, "at least 1"),
    "two of one name": (PLATFORM + WEIGHT + WEIGHT + GRID, "a second 'washer'"),
    "two grids of one name": (WHOLE + GRID, "a second 'deck'"),
    "a place that is not": (WHOLE.replace('"E3"', '"J1"'), r"taken.*'J1', which is not a place"),
    "a skew grid": (WHOLE.replace("[0.0, 1.0, 0.0]", "[1.0, 1.0, 0.0]"), "letters' axis"),
    "weights without places": (PLATFORM + WEIGHT, r"no \[\[weight_grid\]\]"),
    "places without weights": (PLATFORM + GRID, r"no \[\[weight\]\]"),
    "too many letters": (WHOLE.replace("letters = 9", "letters = 27"), "at most 26"),
}


@pytest.mark.parametrize(("text", "reported"), BAD.values(), ids=BAD.keys())
def test_an_impossible_value_is_reported_with_its_key(text, reported):
    with pytest.raises(InputError, match=reported):
        parse_testbed(text, "t.toml")


def test_the_schema_knows_both_tables():
    tables = json_schema()["$defs"]
    assert "mass_g" in tables["Weight"]["properties"]
    assert "letter_axis" in tables["WeightGrid"]["properties"]
