"""A table that is converted piece by piece gives the same file as one converted as a whole."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pyarrow.parquet as parquet
import pytest

from equipoise.io.columns.column_map import ColumnMap, Columns, Euler, NamedColumn
from equipoise.io.columns.read_options import AS_IT_IS, ReadOptions
from equipoise.io.recording.long_conversion import convert_in_pieces, is_long
from equipoise.io.recording.recording_file import read_recording, write_recording
from equipoise.maths.attitude import exponential, to_matrix
from equipoise.model.errors import InputError
from tests.support import thorough

ROWS = 240
PIECES = (13, 60)  # rows: most seams are in the midst of what is wrong, or at its edge
Cells = list[list[str]]
NATIVE = [
    "time_s", "q_w", "q_x", "q_y", "q_z", "omega_x_rad_s", "omega_y_rad_s", "omega_z_rad_s",
    "mass_x1_mm", "field_x_uT", "field_y_uT", "field_z_uT", "wheel_x_rad_s",
]  # fmt: skip
FOREIGN = ["t", "qw", "qx", "qy", "qz", "gx", "gy", "gz", "m", "bx", "by", "bz", "torqueCmd"]
MAP = ColumnMap(
    time=(Columns(("t",)),),
    quaternion=Columns(("qw", "qx", "qy", "qz")),
    rate=Columns(("gx", "gy", "gz"), np.pi / 180, offset=0.01),
    field=Columns(("bx", "by", "bz"), 10.0, axes=("x", "-z", "y")),
    masses=(NamedColumn("x1", "m", 1e-3),),
    body=("-y", "x", "z"),
    lab_up="y",
)
TIME, W, GYRO, MASS, FIELD, LAST = 0, 1, 5, 8, 9, 12


def numbers() -> np.ndarray:
    """Return a record of some swings, with its sensors' noise."""
    rng = np.random.default_rng(3)
    t = 0.05 * np.arange(ROWS)
    turn = np.stack([0.4 * np.sin(t), 0.3 * np.cos(1.3 * t), 0.9 * t], axis=1)
    q, rate = exponential(turn), rng.standard_normal((ROWS, 3))
    q /= np.linalg.norm(q, axis=1)[:, None]
    rest = [np.floor(t), *(50 * rng.standard_normal((3, ROWS))), 100 + t]
    return np.column_stack([t, q, rate, *rest])


def cells() -> Cells:
    return [[repr(x) for x in row] for row in numbers().tolist()]


def text(header: list[str], rows: Cells) -> str:
    return "\n".join(",".join(row) for row in [header, *rows]) + "\n"


def put(rows: Cells, places: slice, column: int, *values: str) -> None:
    """Put values into some rows, from a column on."""
    for row in rows[places]:
        row[column : column + len(values)] = values


def shifted(rows: Cells, places: slice, change: Callable[[float], float]) -> None:
    """Change the times of some rows."""
    for row in rows[places]:
        row[TIME] = repr(change(float(row[TIME])))


def scaled(rows: Cells, places: slice, factor: float) -> None:
    """Change the length of some quaternions."""
    for row in rows[places]:
        row[W : W + 4] = [repr(factor * float(cell)) for cell in row[W : W + 4]]


def spoilt(change: Callable[[Cells], object]) -> Cells:
    rows = cells()
    change(rows)
    return rows


def several(rows: Cells) -> None:
    """Put many faults into one table."""
    put(rows, slice(3, 4), TIME, "")
    put(rows, slice(20, 22), GYRO, "oops")
    put(rows, slice(50, 51), W, "nan")
    shifted(rows, slice(60, 61), lambda t: t - 1.0)
    rows[80] = rows[80][:4]
    rows[81] = [*rows[81], "7"]
    scaled(rows, slice(100, 130), -1.0)
    scaled(rows, slice(140, 142), 1.5)
    shifted(rows, slice(150, 151), lambda t: t - 0.05)


BLANK3, ZERO3 = ["", "", ""], ["0", "0", "0"]
FAULTS: dict[str, Callable[[Cells], object]] = {
    "none": lambda rows: None,
    "a gyro at every other row": lambda rows: put(rows, slice(0, None, 2), GYRO, *BLANK3),
    "an attitude that comes late": lambda rows: put(rows, slice(0, 100), W, "", *BLANK3),
    "a magnetometer that ends": lambda rows: put(rows, slice(90, None), FIELD, *BLANK3),
    "a gyro that is zero at first": lambda rows: put(rows, slice(0, 70), GYRO, *ZERO3),
    "a gyro that is dead": lambda rows: put(rows, slice(None), GYRO, *ZERO3),
    "an axis that is dead": lambda rows: put(rows, slice(None), GYRO + 1, "0.0"),
    "a magnetometer that is dead": lambda rows: put(rows, slice(None), FIELD, *ZERO3),
    "no time in a row": lambda rows: put(rows, slice(100, 102), TIME, ""),
    "a time that is no number": lambda rows: put(rows, slice(7, 8), TIME, "later"),
    "a wrong time": lambda rows: shifted(rows, slice(66, 67), lambda t: t + 500.0),
    "a time that goes back": lambda rows: shifted(rows, slice(70, 72), lambda t: t - 2.0),
    "a time twice": lambda rows: shifted(rows, slice(60, 61), lambda t: t - 0.05),
    "times of which each comes twice": lambda rows: shifted(
        rows, slice(1, None, 2), lambda t: t - 0.05
    ),
    "a clock that restarts": lambda rows: shifted(
        rows, slice(None), lambda t: (t + 65530.0) % 65536.0
    ),
    "times of another clock at the end": lambda rows: shifted(
        rows, slice(237, None), lambda t: t + 1e6
    ),
    "times from a date on": lambda rows: shifted(rows, slice(None), lambda t: t + 1.7e9),
    "a gap": lambda rows: shifted(rows, slice(120, None), lambda t: t + 3.0),
    "many gaps": lambda rows: [
        shifted(rows, slice(k, None), lambda t, k=k: t + 0.1 * k) for k in range(20, 200, 19)
    ],
    "a word among numbers": lambda rows: put(rows, slice(61, 62), GYRO + 1, "oops"),
    "a row of no numbers": lambda rows: put(rows, slice(59, 61), GYRO, "nan", "nan", "nan"),
    "a blank cell beside numbers": lambda rows: put(rows, slice(119, 121), W + 2, ""),
    "a number for no reading": lambda rows: put(rows, slice(5, 240, 60), GYRO, "-999"),
    "one such number alone": lambda rows: put(rows, slice(60, 61), GYRO, "-999"),
    "a number beyond any": lambda rows: put(rows, slice(200, 201), FIELD, "1.7e308"),
    "quaternions that are short": lambda rows: scaled(rows, slice(50, 52), 0.7),
    "quaternions that are off": lambda rows: scaled(rows, slice(100, 103), 1.003),
    "quaternions that are off by a digit": lambda rows: scaled(rows, slice(201, 202), 1 + 1e-10),
    "means of quaternions": lambda rows: scaled(rows, slice(0, None), 0.98),
    "signs that change": lambda rows: scaled(rows, slice(50, 170), -1.0),
    "signs that change at a seam": lambda rows: scaled(rows, slice(60, 120), -1.0),
    "signs that change at each row": lambda rows: scaled(rows, slice(0, None, 2), -1.0),
    "a half turn at a seam": lambda rows: [
        put(rows, slice(0, 60), W, "-1", "0", "0", "0"),
        put(rows, slice(60, 61), W, "0", "1", "0", "0"),
    ],
    "a row that is cut": lambda rows: rows.__setitem__(60, rows[60][:5]),
    "a row that is too wide": lambda rows: rows.__setitem__(119, [*rows[119], "1"]),
    "a last row that is cut": lambda rows: rows.__setitem__(-1, rows[-1][:5]),
    "blank lines": lambda rows: rows.__setitem__(60, [""]),
    "several": several,
    "too many": lambda rows: put(rows, slice(30, 90), GYRO, "oops"),
    "no time at all": lambda rows: put(rows, slice(None), TIME, ""),
    "two records": lambda rows: shifted(rows, slice(120, None), lambda t: t - 6.0),
    "too few rows": lambda rows: rows.__delitem__(slice(2, None)),
}


def contents(path: Path) -> object:
    """Return what is in a file, to be compared to the last bit."""
    if path.suffix != ".parquet":
        return path.read_bytes()
    table = parquet.read_table(path)
    return {name: table.column(name).to_pylist() for name in table.column_names}


def as_a_whole(path: Path, out: Path, options: ReadOptions) -> object:
    """Return the file, and what is said of it; or the sentence why there is none."""
    try:
        recording = read_recording(path, options)
    except InputError as error:
        return str(error)
    write_recording(recording, out)
    return contents(out), recording.notes, recording.gaps, recording.unread


def in_pieces(path: Path, out: Path, options: ReadOptions, size: int) -> object:
    """Return the same of a conversion in pieces of so many rows."""
    try:
        said = convert_in_pieces(path, out, options, lambda _: None, size)
    except InputError as error:
        assert not out.exists()
        return str(error)
    return contents(out), said.notes, said.gaps, said.unread


def check(folder: Path, made: str, options: ReadOptions, suffixes: tuple[str, ...]) -> None:
    """Check that a text is converted in pieces as it is as a whole."""
    path = folder / "table.csv"
    path.write_text(made)
    for suffix in suffixes:
        whole = as_a_whole(path, folder / f"whole{suffix}", options)
        for size in PIECES:
            assert in_pieces(path, folder / f"pieces{size}{suffix}", options, size) == whole


LOOSE = replace(AS_IT_IS, bad_rows=0.2)


@pytest.mark.parametrize("name", thorough.some(list(FAULTS), 12))
def test_a_table_of_ours_is_the_same_in_pieces(name, tmp_path) -> None:
    check(tmp_path, text(NATIVE, spoilt(FAULTS[name])), LOOSE, (".csv",))


@pytest.mark.parametrize("name", thorough.some(list(FAULTS)[::-1], 25))
def test_a_foreign_table_is_the_same_in_pieces(name, tmp_path) -> None:
    options = replace(LOOSE, columns=MAP)
    check(tmp_path, text(FOREIGN, spoilt(FAULTS[name])), options, (".csv",))


@pytest.mark.parametrize("name", ["none", "several", "a gyro at every other row", "a gap"])
def test_every_format_that_grows_is_the_same_in_pieces(name, tmp_path) -> None:
    made = text(NATIVE, spoilt(FAULTS[name]))
    check(tmp_path, made, LOOSE, (".parquet", ".mcap"))


def angles() -> str:
    t = 0.05 * np.arange(ROWS)
    yaw, rest = np.degrees((0.9 * t + np.pi) % (2 * np.pi) - np.pi), np.sin(t)
    rows = np.column_stack([t, yaw, 10 * rest, 5 * rest]).tolist()
    return text(["t", "a", "b", "c"], [[repr(x) for x in row] for row in rows])


def matrices() -> str:
    made = numbers()
    turns = to_matrix(made[:, W : W + 4]).reshape(ROWS, 9)
    turns[61:64] = 0.0
    turns[100] *= -1.0
    header = ["t", *(f"r{k}" for k in range(9))]
    rows = np.column_stack([made[:, TIME], turns]).tolist()
    return text(header, [[repr(x) for x in row] for row in rows])


def dated() -> str:
    rows = cells()
    for k, row in enumerate(rows):
        row[TIME] = f"2024-05-03T14:{k // 60:02d}:{k % 60:02d}.5"
    put(rows, slice(60, 61), TIME, "soon")
    return text(FOREIGN, rows)


def in_two_columns() -> str:
    rows = [
        [str(1_700_000_000 + k // 20), str(k % 20 * 50_000_000), *row[W:]]
        for k, row in enumerate(cells())
    ]
    return text(["s", "ns", *FOREIGN[1:]], rows)


ANGLES = ColumnMap((Columns(("t",)),), euler=Euler(Columns(("a", "b", "c"), np.pi / 180), "ZYX"))
MATRIX = ColumnMap((Columns(("t",)),), matrix=Columns(tuple(f"r{k}" for k in range(9))))
TWO = replace(MAP, time=(Columns(("s",)), Columns(("ns",), 1e-9)))
KINDS = {
    "angles": (angles, ANGLES),
    "a rotation vector": (angles, replace(ANGLES, euler=None, rotation_vector=ANGLES.sensed[1])),
    "matrices": (matrices, MATRIX),
    "dates": (dated, replace(MAP, time_format="ISO")),
    "seconds and nanoseconds": (in_two_columns, TWO),
}


@pytest.mark.parametrize(("made", "columns"), KINDS.values(), ids=KINDS.keys())
def test_every_kind_of_time_and_of_rotation_is_the_same_in_pieces(made, columns, tmp_path) -> None:
    check(tmp_path, made(), replace(LOOSE, columns=columns), (".csv",))


def test_decimal_commas_are_joined_in_pieces_too(tmp_path) -> None:
    rows = [[cell.replace(".", ",") for cell in row] for row in cells()]
    check(tmp_path, text(NATIVE, rows), AS_IT_IS, (".csv",))


def test_only_a_long_text_is_converted_in_pieces(tmp_path) -> None:
    path = tmp_path / "table.csv"
    path.write_text(text(NATIVE, cells()))
    assert is_long(path, Path("out.csv"), 1000)
    assert not is_long(path, Path("out.mat"), 1000)
    assert not is_long(path, Path("out.csv"))
    assert not is_long(tmp_path / "none.csv", Path("out.csv"), 1000)
    write_recording(read_recording(path), tmp_path / "table.parquet")
    assert not is_long(tmp_path / "table.parquet", Path("out.csv"), 1000)


def test_progress_grows_to_the_whole(tmp_path) -> None:
    path = tmp_path / "table.csv"
    path.write_text(text(NATIVE, cells()))
    shares: list[float] = []
    convert_in_pieces(path, tmp_path / "out.csv", AS_IT_IS, shares.append, 50)
    assert shares == sorted(shares)
    assert shares[-1] == 1.0
    assert sorted(each.name for each in tmp_path.iterdir()) == ["out.csv", "table.csv"]
