"""A testbed that is missing, or that stands where a recording does, is answered by how to give it.

Every command that needs one is tried.
"""

import inspect
from pathlib import Path

import pytest

from equipoise.app.cli import GROUPS
from equipoise.io.testbed.presets import preset_names

TESTBEDS = {
    c.__name__: inspect.signature(c).parameters.get("testbed") for cs in GROUPS.values() for c in cs
}
NEEDED = {name: p for name, p in TESTBEDS.items() if p is not None and p.default is p.empty}
del NEEDED["generate"]  # it takes no recording, and needs three options beside the testbed
BY_OPTION = [name for name, p in NEEDED.items() if p.kind == p.KEYWORD_ONLY]
BY_PLACE = [name for name in NEEDED if name not in BY_OPTION]


def said(done) -> str:
    assert (done.code, done.out) == (2, "")
    (line,) = done.err.splitlines()
    return line


@pytest.mark.parametrize("command", BY_OPTION)
def test_a_missing_testbed_is_explained(equipoise, command):
    line = said(equipoise(command, "run.csv"))
    assert line.startswith(f"equipoise: {command}: found no testbed; wanted --testbed my.toml, ")
    for word in ("describes the platform", "`equipoise new`", *preset_names()):
        assert word in line


@pytest.mark.parametrize("command", BY_PLACE)
def test_a_missing_testbed_that_has_no_option_is_explained(equipoise, command):
    line = said(equipoise(command))
    assert line.startswith(f"equipoise: {command}: found no testbed; wanted a file ")
    for word in ("describes the platform", f"'equipoise {command} my.toml'", *preset_names()):
        assert word in line


def test_both_kinds_of_command_are_tried():
    assert {"identify", "assess", "observe", "calibrate"} <= {*BY_OPTION}
    assert {"design", "simulate", "balance", "check"} <= {*BY_PLACE}


@pytest.mark.parametrize("command", BY_OPTION)
@pytest.mark.parametrize("words", [["run.csv", "my.toml"], ["my.toml", "run.csv"], ["my.toml"]])
def test_a_testbed_in_the_place_of_a_recording_is_answered_by_its_option(equipoise, command, words):
    line = said(equipoise(command, *words))
    assert "found 'my.toml' in the place of a recording; wanted --testbed my.toml" in line


def test_a_preset_in_the_place_of_a_recording_is_answered_by_its_option(equipoise):
    line = said(equipoise("identify", "run.csv", "sputnix"))
    assert "found 'sputnix' in the place of a recording; wanted --testbed sputnix" in line


def test_a_column_map_is_no_testbed(equipoise):
    assert "found no testbed" in said(equipoise("identify", "run.csv", "--columns", "map.toml"))


def test_other_missing_arguments_stay_as_they_are_said(equipoise):
    assert "parameter FILE requires an argument" in said(equipoise("identify"))


@pytest.mark.parametrize("words", [["inspect", "my.toml"], ["identify", "my.toml"]])
def test_a_testbed_file_is_no_recording(equipoise, words):
    assert equipoise("new", "sputnix", "--out", "my.toml").code == 0
    assert Path("my.toml").exists()
    line = said(equipoise(*words, "--testbed", "sputnix"))
    assert "my.toml: found a TOML file, as a testbed is; wanted a recording" in line
    assert line.endswith("a testbed is given as --testbed my.toml")
