"""`equipoise methods` lists what there is; `identify --method` runs it and draws its course."""

from pathlib import Path

import numpy as np

from equipoise.estimation.methods.registry import METHODS


def test_every_method_is_listed(equipoise):
    done = equipoise("methods")
    assert done.code == 0
    first = {line.split(" ")[0] for line in done.out.splitlines()}
    assert set(METHODS) <= first


def test_one_method_is_described_in_full(equipoise):
    done = equipoise("methods", "tracker")
    assert all(word in done.out for word in ("needs", "cannot see", "Ivanov", "options"))


def test_a_method_that_does_not_exist_names_the_nearest(equipoise):
    done = equipoise("methods", "trajektory")
    assert done.code == 2
    assert "did you mean 'trajectory'" in done.err


def test_cards_are_json(equipoise, strict_json):
    document = strict_json(equipoise("methods", "--json").out)
    assert document["schema"] == "equipoise/methods/1"
    assert [card["name"] for card in document["methods"]] == list(METHODS)


def test_an_option_that_a_method_does_not_know_is_refused(equipoise, record_file):
    words = ("--testbed", "sputnix", "--method", "tracker", "--robust")
    done = equipoise("identify", record_file, *words)
    assert done.code == 2
    assert "--robust" in done.err


def test_a_course_is_in_the_document_and_drawn(equipoise, record_file, strict_json):
    """The smoother's centre of mass along the record, a row for each time, and a figure of it."""
    words = ("--testbed", "sputnix", "--method", "smoother", "--json", "--out", "found")
    done = equipoise("identify", record_file, *words)
    course = strict_json(done.out)["course"]
    assert course["names"] == ["com_x", "com_y", "com_z"]
    assert np.shape(course["values"]) == np.shape(course["sd"]) == (len(course["t_s"]), 3)
    assert "com_course" in {path.stem for path in Path("found", "figures").glob("*.svg")}


def test_error_indices_are_reported(equipoise, record_file):
    words = ("--testbed", "sputnix", "--method", "momentum_laboratory")
    assert "Error index" in equipoise("identify", record_file, *words).out
