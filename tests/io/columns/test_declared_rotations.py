"""Rotations of every kind that a column map may declare; counts of a gyro; layouts."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from equipoise.io.columns.column_map import Layout
from equipoise.io.columns.column_map_file import read_column_map
from equipoise.io.columns.read_options import ReadOptions
from equipoise.io.recording.recording_file import read_recording
from equipoise.maths.attitude import to_matrix
from equipoise.model.errors import InputError
from tests.io.columns.known_turns import TURN, T, cells, is_known_turn

TIME = '[time]\ncolumn = "t"\nunit = "s"\n'
NINE = [f"r{row}{column}" for row in range(3) for column in range(3)]
BY_ROWS = TURN.as_matrix().reshape(8, 9)
# Columns, their numbers, and what an [attitude] says of them: one motion throughout.
KINDS = {
    "matrix": (NINE, BY_ROWS, ""),
    "its inverse": (
        NINE,
        TURN.inv().as_matrix().reshape(8, 9),
        'turns = "laboratory to body"',
    ),
    "rotation vector": (
        ["vx", "vy", "vz"],
        TURN.as_rotvec(degrees=True),
        'kind = "rotation vector"\nunit = "deg"',
    ),
    "angles": (
        ["yaw", "pitch", "roll"],
        TURN.as_euler("ZYX"),
        'unit = "rad"\nsequence = "ZYX"',
    ),
    "signs": (
        ["yaw", "pitch", "roll"],
        TURN.as_euler("ZXY", degrees=True) * [1, -1, -1],
        'unit = "deg"\nsequence = "ZXY"\nsigns = [1, -1, -1]',
    ),
    "a heading of a compass": (
        ["heading", "pitch", "roll"],
        TURN.as_euler("ZYX", degrees=True) * [-1, 1, 1],
        'unit = "deg"\nsequence = "ZYX"\ncompass = true',
    ),
    "a heading about fixed axes": (
        ["roll", "pitch", "heading"],
        TURN.as_euler("xyz", degrees=True) * [1, 1, -1],
        'unit = "deg"\nsequence = "xyz"\ncompass = true',
    ),
}


def declared(tmp_path, names, more: str, rest: str = ""):
    """Write a map of one attitude and read it."""
    columns = ", ".join(f'"{name}"' for name in names)
    text = f"{rest}{TIME}[attitude]\ncolumns = [{columns}]\n{more}\n"
    (tmp_path / "map.toml").write_text(text)
    return read_column_map(tmp_path / "map.toml")


def read(tmp_path, names, values, columns, **options):
    """Write a table and read it through a map."""
    rows = [",".join(row) for row in cells(T, values)]
    (tmp_path / "r.csv").write_text("\n".join([",".join(["t", *names]), *rows]) + "\n")
    return read_recording(tmp_path / "r.csv", ReadOptions(columns=columns, **options))


@pytest.mark.parametrize(("names", "values", "more"), KINDS.values(), ids=KINDS.keys())
def test_every_kind_of_rotation_gives_the_same_attitudes(tmp_path, names, values, more) -> None:
    """Each made by SciPy of one motion."""
    is_known_turn(read(tmp_path, names, values, declared(tmp_path, names, more)))


def test_a_clockwise_heading_turns_the_nose_to_the_east_of_north(tmp_path) -> None:
    """By hand: level, heading 30 deg; the nose, at north for 0, is 30 deg to its right."""
    names = ["heading", "pitch", "roll"]
    values = np.tile([30.0, 0.0, 0.0], (8, 1))
    columns = declared(tmp_path, names, 'unit = "deg"\nsequence = "ZYX"\ncompass = true')
    nose = to_matrix(read(tmp_path, names, values, columns).attitude.values)[:, :, 0]
    to_the_left = np.arctan2(nose[:, 1], nose[:, 0])  # counted up about Z
    np.testing.assert_allclose(np.degrees(to_the_left), -30.0, atol=1e-12)


def test_a_matrix_in_other_body_axes_and_another_laboratory(tmp_path) -> None:
    """The whole map holds for a matrix as it does for a quaternion."""
    of_q = 'order = "xyzw"'
    rest = 'lab_up = "y"\nbody = ["x", "-z", "y"]\n'
    q = read(tmp_path, [*"abcd"], TURN.as_quat(), declared(tmp_path, [*"abcd"], of_q, rest))
    matrix = read(tmp_path, NINE, BY_ROWS, declared(tmp_path, NINE, "", rest))
    np.testing.assert_allclose(
        to_matrix(matrix.attitude.values), to_matrix(q.attitude.values), atol=1e-12
    )


def test_a_matrix_of_few_digits_becomes_the_nearest_rotation(tmp_path) -> None:
    """Three digits: the attitude errs by less than a thousandth."""
    recording = read(tmp_path, NINE, np.round(BY_ROWS, 3), declared(tmp_path, NINE, ""))
    found = Rotation.from_matrix(to_matrix(recording.attitude.values))
    assert (found * TURN.inv()).magnitude().max() < 1e-3
    np.testing.assert_allclose(np.linalg.norm(recording.attitude.values, axis=1), 1, atol=1e-15)


NO_ROTATIONS = {
    "stretched": (1.2 * BY_ROWS, "no rotation", "unit length"),
    "a mirror image": (-BY_ROWS, "a mirror image", "right-handed"),
}


@pytest.mark.parametrize(("values", "found", "wanted"), NO_ROTATIONS.values(), ids=NO_ROTATIONS)
def test_a_matrix_that_is_no_rotation_is_refused(tmp_path, values, found, wanted) -> None:
    """The first such line is named."""
    with pytest.raises(InputError) as caught:
        read(tmp_path, NINE, values, declared(tmp_path, NINE, ""))
    assert all(word in str(caught.value) for word in ("line 2: ", found, wanted))


def test_few_matrices_that_are_no_rotations_are_left_out(tmp_path) -> None:
    """As any other faulty row: counted and named."""
    values = BY_ROWS.copy()
    values[3] *= 1.2
    columns = declared(tmp_path, NINE, "")
    recording = read(tmp_path, NINE, values, columns, bad_rows=0.2)
    is_known_turn(recording, [0, 1, 2, 4, 5, 6, 7])
    assert "1 row with a matrix that is no rotation, line 5; left out." in recording.notes


BAD = {
    "five columns": ("abcde", "", ".columns: found 5 columns; wanted four"),
    "a vector without a unit": ("abc", 'kind = "rotation vector"', "no 'unit'"),
    "angles without a sequence": ("abc", 'unit = "deg"', "no 'sequence'"),
    "a unit of a matrix": (NINE, 'unit = "deg"', ".unit: found 'unit' of a matrix"),
    "signs of a quaternion": ("abcd", 'order = "wxyz"\nsigns = [1, 1, 1]', "'signs' of a quat"),
    "a vector in a sequence": (
        "abc",
        'kind = "rotation vector"\nunit = "deg"\nsequence = "ZYX"',
        "'sequence' of a rotation vector",
    ),
    "a compass in a sequence of the body": (
        "abc",
        'unit = "deg"\nsequence = "XYZ"\ncompass = true',
        "compass with the sequence XYZ; wanted a sequence that begins with Z",
    ),
    "a sign of two": ("abc", 'unit = "deg"\nsequence = "XYZ"\nsigns = [1, 2, 1]', "1 or -1"),
    "another kind": ("abc", 'unit = "deg"\nkind = "vector"', "'rotation vector'"),
}


@pytest.mark.parametrize(("names", "more", "words"), BAD.values(), ids=BAD.keys())
def test_an_attitude_that_is_not_clear_is_refused(tmp_path, names, more, words) -> None:
    """The key is named, and what it may be."""
    with pytest.raises(InputError) as caught:
        declared(tmp_path, names, more)
    assert str(caught.value).startswith(f"{tmp_path / 'map.toml'}: attitude")
    assert words in str(caught.value)


def gyro(tmp_path, more: str):
    """Write a map of a gyro in counts and read it."""
    text = f'{TIME}[rate]\ncolumns = ["gx", "gy", "gz"]\nunit = "deg/s"\n{more}\n'
    (tmp_path / "map.toml").write_text(text)
    return read_column_map(tmp_path / "map.toml")


COUNTS = np.outer(np.arange(8), [100, -50, 25]) + [3, -8, 1]


@pytest.mark.parametrize(
    ("more", "offset"),
    [("offset = [3, -8, 1]\n", [3, -8, 1]), ("offset = 2\n", [2, 2, 2]), ("", [0, 0, 0])],
)
def test_counts_of_a_gyro_become_si(tmp_path, more, offset) -> None:
    """An MPU-6050 at 131 counts for a deg/s: SI is (raw - offset) factor unit."""
    columns = gyro(tmp_path, more + f"factor = {1 / 131}")
    recording = read(tmp_path, ["gx", "gy", "gz"], COUNTS, columns)
    expected = np.radians((COUNTS - offset) / 131)
    np.testing.assert_allclose(recording.rate.values, expected, rtol=1e-13)


@pytest.mark.parametrize(
    ("more", "words"),
    [
        ("factor = 0", "rate.factor: found 0; wanted a number above 0"),
        ("offset = [1, 2]", "rate.offset: found [1, 2]; wanted a list of 3"),
        ('offset = "3"', "rate.offset: found '3'; wanted a list in square brackets"),
    ],
)
def test_counts_that_make_no_sense_are_refused(tmp_path, more, words) -> None:
    """Key, found and wanted."""
    with pytest.raises(InputError) as caught:
        gyro(tmp_path, more)
    assert words in str(caught.value)


def test_a_layout_is_declared(tmp_path) -> None:
    """What is left out is detected; a header is there unless it is said that none is."""
    stated = 'separator = "tab"\ndecimal = ","\nskip_rows = 3\n'
    stated += "no_header = true\nunits_row = false\n"
    columns = declared(tmp_path, NINE, "", stated)
    assert columns.layout == Layout("\t", ",", 3, header=False, units_row=False)
    assert declared(tmp_path, NINE, "").layout == Layout(header=True, units_row=None)


def test_a_body_beside_a_column_map_is_refused(tmp_path) -> None:
    """The map names columns, which are one body's."""
    columns = declared(tmp_path, NINE, "")
    read(tmp_path, NINE, BY_ROWS, columns)
    with pytest.raises(InputError, match=r"--body and --columns: found both"):
        read_recording(tmp_path / "r.csv", ReadOptions(columns=columns, body="Platform"))
