"""Names become objects, and moves displacements in metres."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from equipoise.app.arguments import inputs
from equipoise.app.arguments.inputs import move_of, part_of
from equipoise.io.testbed.presets import read_preset
from equipoise.model.errors import InputError
from equipoise.model.recording import Recording, Samples, arranged

BED = read_preset("sputnix")


@given(time=st.floats(0, 1e4), x=st.floats(-50, 50), z=st.floats(-50, 50))
def test_a_move_is_read_as_written(time, x, z):
    at, goals = move_of(f"{time}: x1={x} z2={z}", BED)
    assert at == time
    assert goals == pytest.approx({"x1": x * 1e-3, "z2": z * 1e-3})


@pytest.mark.parametrize("text", ["60:x1=-10,z1=5", " 60 : x1=-10  z1=5 ", "60: x1=-10, z1=5"])
def test_blanks_and_commas_are_free(text):
    assert move_of(text, BED) == (60.0, pytest.approx({"x1": -0.01, "z1": 0.005}))


BAD_MOVES = ["60", "60:", ": x1=1", "60 70: x1=1", "60: x1", "60: x1=", "60: =1", "60: x1=1,"]


@pytest.mark.parametrize("text", [*BAD_MOVES, "60: ,x1=1", f"60: {'x1=1,' * 1000}!"])
def test_what_is_no_move_is_refused_with_an_example(text):
    with pytest.raises(InputError, match=r"wanted 'seconds: mass=mm mass=mm', such as"):
        move_of(text, BED)


def test_a_preset_needs_no_file():
    assert inputs.testbed_from("sputnix").name == BED.name


def test_masses_come_in_the_testbeds_order():
    """A file may name some of them, in any order; the others are at home."""
    t = np.arange(3.0)
    values = np.array([[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]]) * 1e-3
    there = arranged(Recording(mass_names=("z1", "x2"), masses=Samples(t, values)), BED.mass_names)
    assert there.mass_names == ("x1", "x2", "y1", "y2", "z1", "z2")
    assert there.masses is not None
    np.testing.assert_array_equal(there.masses.values[:, [1, 4]], values[:, ::-1])
    assert not there.masses.values[:, [0, 2, 3, 5]].any()


def test_a_move_behind_the_last_row_is_left_out():
    """Whole or not: of the inputs one row is kept beyond the sensors' last, at 9 s."""
    q = np.tile([1.0, 0, 0, 0], (10, 1))
    masses = Samples(np.array([0.0, 5.0, 20.0, 21.0]), np.array([[0.0], [0.0], [0.0], [0.01]]))
    recording = Recording(Samples(np.arange(10.0), q), None, ("x1",), masses)
    for start in (None, 2.0):
        known = part_of(recording, start, None).masses
        assert known is not None
        assert known.t[-1] == 20.0


def test_a_window_that_leaves_nothing_is_refused():
    q = np.tile([1.0, 0, 0, 0], (10, 1))
    recording = Recording(attitude=Samples(np.arange(10.0), q), source="run.csv")
    assert len(part_of(recording, 2.0, 6.0).attitude or ()) == 5
    with pytest.raises(InputError, match="within 0 to 9 s"):
        part_of(recording, 20.0, None)
