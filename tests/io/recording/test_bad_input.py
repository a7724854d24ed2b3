"""Bad recordings: one sentence with file, line or column, what was found and what was wanted."""

import numpy as np
import pytest

from equipoise.io.columns.read_options import ReadOptions
from equipoise.io.recording.recording_file import check_names, read_recording, write_recording
from equipoise.io.testbed.presets import read_preset
from equipoise.io.testbed.testbed_file import parse_testbed
from equipoise.model.errors import InputError
from equipoise.model.recording import Recording, Samples

HEAD = "time_s,q_w,q_x,q_y,q_z\n"
ROWS = [f"{0.1 * i:.1f},1,0,0,{0.0001 * i}\n" for i in range(6)]
GOOD = HEAD + "".join(ROWS)

TWICE = HEAD.replace("q_z", "q_z,q_z") + "".join(r.replace("\n", ",0\n") for r in ROWS)


def row(number: int, text: str) -> str:
    """Return the good table with one of its rows (from 1) replaced; its line is one more."""
    return HEAD + "".join([*ROWS[: number - 1], text + "\n", *ROWS[number:]])


CASES = {
    "empty": ("", "", ["an empty file"]),
    "blank": ("  \n\n", "", ["an empty file"]),
    "header only": (HEAD, "", ["a header but no rows"]),
    "two samples": (HEAD + "".join(ROWS[:2]), "", ["2 rows", "at least 3"]),
    "binary": (GOOD + "\x00\x01", "", ["binary"]),
    "text in a number column": (row(3, "0.2,abc,0,0,0"), ", line 4, column 'q_w'", ["'abc'"]),
    "NaN": (row(3, "0.2,1,0,nan,0"), ", line 4, column 'q_y'", ["'nan'", "blank"]),
    "a row of NaN": (row(2, "nan,nan,nan,nan,nan"), ", line 3, column 'time_s'", ["'nan'"]),
    "infinite": (row(3, "0.2,1,0,0,-inf"), ", line 4, column 'q_z'", ["'-inf'"]),
    "a blank among others": (row(3, "0.2,1,0,,0"), ", line 4, column 'q_y'", ["a blank cell"]),
    "a blank time": (row(3, ",1,0,0,0"), ", line 4, column 'time_s'", ["a blank cell"]),
    "time backwards": (row(3, "0.05,1,0,0,0"), ", line 4", ["0.1 s to 0.05 s", "increasing times"]),
    "far from unit": (row(5, "0.4,0.9,0,0,0"), ", line 6", ["length 0.9", "length 1"]),
    "zero quaternion": (row(5, "0.4,0,0,0,0"), ", line 6", ["length 0"]),
    "too few cells": (row(3, "0.2,1,0"), ", line 4", ["3 cells", "5, as the header"]),
    "too many cells": (row(3, "0.2,1,0,0,0,7"), ", line 4", ["6 cells"]),
    "no q_z": (
        GOOD.replace(",q_z", ",other"),
        ", header",
        ["q_w q_x q_y without q_z", "all of q_w q_x q_y q_z"],
    ),
    "no time": (GOOD.replace("time_s", "seconds"), ", header", ["no column 'time_s'"]),
    "rates in degrees": (
        GOOD.replace("q_w,q_x,q_y,q_z", "omega_x_deg_s,b,c,d"),
        ", header",
        ["'omega_x_deg_s'", "'omega_x_rad_s'"],
    ),
    "mass in metres": (GOOD.replace("q_w", "mass_x1_m"), ", header", ["'mass_<name>_mm'"]),
    "wheel in rpm": (GOOD.replace("q_w", "wheel_x_rpm"), ", header", ["'wheel_<name>_rad_s'"]),
    "gimbal in radians": (GOOD.replace("q_w", "gimbal_a_rad"), ", header", ["'gimbal_<name>_deg'"]),
    "a jet of no name": (GOOD.replace("q_w", "jet_N_m"), ", header", ["'jet_<name>_N_m'"]),
    "a dipole in Am2": (GOOD.replace("q_w", "dipole_x_Am2"), ", header", ["'dipole_<name>_A_m2'"]),
    "field in tesla": (
        GOOD.replace("q_w,q_x,q_y", "field_x_T,field_y_T,field_z_T"),
        ", header",
        ["field_x_T", "field_x_uT"],
    ),
    "temperature in kelvin": (
        GOOD.replace("q_w", "temperature_K"),
        ", header",
        ["'temperature_K'", "'temperature_degC'"],
    ),
    "half a field": (
        "time_s,q_w,q_x,q_y,q_z,field_x_uT,field_y_uT\n" + "0,1,0,0,0,20,30\n",
        ", header",
        ["field_x_uT field_y_uT without field_z_uT"],
    ),
    "one wheel blank": (
        "time_s,q_w,q_x,q_y,q_z,wheel_x_rad_s,wheel_y_rad_s\n"
        + "".join(r.replace("\n", ",1,\n") for r in ROWS),
        ", line 2, column 'wheel_y_rad_s'",
        ["a blank cell", "the other columns of devices"],
    ),
    "no sensor": ("time_s,mass_x1_mm\n0,0\n1,0\n2,0\n", "", ["neither attitude nor rate"]),
    "a column twice": (TWICE, ", header", ["two columns 'q_z'"]),
    "nobody's header": ("alpha,beta\n1,2\n3,4\n", ", header", ["alpha, beta", "--columns"]),
}


@pytest.mark.parametrize(("text", "where", "words"), CASES.values(), ids=CASES.keys())
def test_a_bad_table_is_named_with_its_place(tmp_path, text, where, words) -> None:
    """File and place come first, then found and wanted, in one line."""
    path = tmp_path / "run.csv"
    path.write_text(text)
    with pytest.raises(InputError) as caught:
        read_recording(path)
    sentence = str(caught.value)
    assert sentence.startswith(f"{path}{where}: found ")
    assert "\n" not in sentence
    for word in words:
        assert word in sentence


def test_the_good_table_is_good(tmp_path) -> None:
    """The cases above fail for the reason they state."""
    (tmp_path / "run.csv").write_text(GOOD)
    assert len(read_recording(tmp_path / "run.csv").attitude or ()) == 6


@pytest.mark.parametrize("name", ["missing.csv", "."])
def test_a_missing_file_or_a_directory_is_named(tmp_path, name) -> None:
    """Neither is a recording."""
    with pytest.raises(InputError, match=r"no such file|a directory"):
        read_recording(tmp_path / name)


def test_an_unknown_dialect_names_the_nearest(tmp_path) -> None:
    """A misspelt dialect is answered with the right one."""
    (tmp_path / "run.csv").write_text(GOOD)
    with pytest.raises(InputError, match="did you mean 'optitrack'"):
        read_recording(tmp_path / "run.csv", ReadOptions("optitrak"))


@pytest.mark.parametrize("dialect", ["optitrack", "ros"])
def test_a_table_of_another_dialect_is_refused(tmp_path, dialect) -> None:
    """A native table is neither OptiTrack's nor ROS's, whatever is claimed."""
    (tmp_path / "run.csv").write_text(GOOD)
    with pytest.raises(InputError, match="header: found"):
        read_recording(tmp_path / "run.csv", ReadOptions(dialect))


def test_a_mass_that_the_testbed_lacks_names_the_nearest(tmp_path) -> None:
    """With a testbed at hand, the recording may move its masses alone."""
    path = tmp_path / "run.csv"
    path.write_text(GOOD.replace("q_w", "mass_x12_mm,q_w").replace(",1,", ",0,1,"))
    read_recording(path)
    with pytest.raises(InputError, match=r"mass 'x12', which .*; did you mean 'x[12]'"):
        check_names(read_recording(path), read_preset("sputnix"))


def test_a_device_that_the_testbed_lacks_names_the_nearest(tmp_path) -> None:
    """With a testbed at hand, the recording may name its devices only, and their kinds."""
    text = 'name = "t"\n[platform]\nmass_kg = 9\ninertia_kg_m2 = [[1,0,0],[0,1,0],[0,0,1]]\n'
    coil = '[[magnetorquer]]\nname = "x"\naxis = [1, 0, 0]\nmax_dipole_A_m2 = 1\n'
    path = tmp_path / "run.csv"
    path.write_text(GOOD.replace("q_w", "wheel_x_rad_s,q_w").replace(",1,", ",0,1,"))
    assert read_recording(path).device_names == ("wheel:x",)
    with pytest.raises(InputError, match=r"device 'wheel:x', which .*; wanted no device"):
        check_names(read_recording(path), parse_testbed(text, "t"))
    bed = parse_testbed(text + coil + "[magnetic_field]\nfield_uT = [0, 0, 9]", "t")
    with pytest.raises(InputError, match=r"device 'wheel:x', which .*; wanted one of dipole:x"):
        check_names(read_recording(path), bed)


def test_broken_parquet_is_named(tmp_path) -> None:
    """A Parquet file cut short is said to be broken."""
    pytest.importorskip("pyarrow", reason="the parquet extra is not installed")
    t = np.arange(4.0)
    whole = tmp_path / "r.parquet"
    write_recording(Recording(rate=Samples(t, np.ones((4, 3)))), whole)
    (tmp_path / "half.parquet").write_bytes(whole.read_bytes()[:100])
    with pytest.raises(InputError, match="a Parquet file that cannot be read"):
        read_recording(tmp_path / "half.parquet")
