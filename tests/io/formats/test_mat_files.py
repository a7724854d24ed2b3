"""MAT files of every version: matrices, structures, what is left out, and what is broken."""

import contextlib
import gzip
import struct
import sys
from pathlib import Path

import numpy as np
import pytest

from equipoise.io.columns.column_map import ColumnMap, Columns
from equipoise.io.columns.read_options import ReadOptions
from equipoise.io.files.file_content import Content
from equipoise.io.formats.mat_table import read_mat
from equipoise.io.formats.matlab import hdf5_process
from equipoise.io.recording.recording_file import read_recording
from equipoise.model.errors import InputError, UnforeseenError
from tests.support.broken_files import times_refused
from tests.support.mat_files import mat_4, mat_4_of, mat_5, mat_73, mat_73_without_end
from tests.support.thorough import count

ROWS = 40
T = np.arange(ROWS)[:, np.newaxis] / 7
HALF = 0.02 * np.arange(ROWS)
Q = np.stack([np.cos(HALF), np.sin(HALF), 0 * HALF, 0 * HALF], axis=1)
W = np.stack([0.28 + 0 * HALF, 0.001 * np.arange(ROWS), -1e-17 * np.arange(ROWS)], axis=1)
SIMPLE = {"t": T, "q": Q, "w": W}
STRUCTURE = {"data": {"t": T} | {f"q{k}": Q[:, [i]] for i, k in enumerate("wxyz")}}
VERSIONS = {
    "4": mat_4, "5": mat_5, "7": lambda variables: mat_5(variables, packed=True), "7.3": mat_73,
}  # fmt: skip
WITH_STRUCTURES = [name for name in VERSIONS if name != "4"]


def table(content: bytes):
    return read_mat(Content.of(content, "run.mat"), "run.mat")


def mapped(**columns: tuple[str, ...]) -> ReadOptions:
    named = {name: Columns(names) for name, names in columns.items() if name != "t"}
    return ReadOptions(columns=ColumnMap(time=(Columns(columns["t"]),), **named))


# --- Shapes --------------------------------------------------------------------------------------


@pytest.mark.parametrize("version", VERSIONS)
def test_the_columns_of_a_matrix_are_numbered(tmp_path, version):
    """To the last bit, in a recording by a column map."""
    (tmp_path / "run.mat").write_bytes(VERSIONS[version](SIMPLE))
    turn, rate = tuple(f"q({k})" for k in (1, 2, 3, 4)), tuple(f"w({k})" for k in (1, 2, 3))
    options = mapped(t=("t",), quaternion=turn, rate=rate)
    found = read_recording(tmp_path / "run.mat", options)
    np.testing.assert_array_equal(found.rate.t, T[:, 0])
    np.testing.assert_array_equal(found.rate.values, W)
    np.testing.assert_allclose(found.attitude.values, Q, atol=1e-15)


@pytest.mark.parametrize("version", VERSIONS)
def test_a_matrix_that_lies_on_its_side_is_turned(version):
    found = table(VERSIONS[version]({"t": T.T, "q": Q.T, "w": W}))
    assert set(found.names) == {"t", *(f"q({k})" for k in (1, 2, 3, 4)),
                                *(f"w({k})" for k in (1, 2, 3))}  # fmt: skip
    np.testing.assert_array_equal(found.numbers("t").values, T[:, 0])
    for k in range(4):
        np.testing.assert_array_equal(found.numbers(f"q({k + 1})").values, Q[:, k])


@pytest.mark.parametrize("version", WITH_STRUCTURES)
def test_the_fields_of_a_structure_are_columns(tmp_path, version):
    (tmp_path / "run.mat").write_bytes(VERSIONS[version](STRUCTURE))
    turn = tuple(f"data.q{k}" for k in "wxyz")
    found = read_recording(tmp_path / "run.mat", mapped(t=("data.t",), quaternion=turn))
    np.testing.assert_array_equal(found.attitude.t, T[:, 0])
    np.testing.assert_allclose(found.attitude.values, Q, atol=1e-15)


@pytest.mark.parametrize("version", WITH_STRUCTURES)
def test_structures_are_opened_three_deep(version):
    """Vectors and matrices stand at every depth; a fourth structure stays closed."""
    deepest = {"w": W, "d": {"hidden": T}}
    variables = {"t": T, "a": {"u": T, "b": {"v": T.T, "c": deepest}}}
    found = table(VERSIONS[version](variables))
    wanted = {"t", "a.u", "a.b.v", "a.b.c.w(1)", "a.b.c.w(2)", "a.b.c.w(3)"}
    assert set(found.names) == wanted
    np.testing.assert_array_equal(found.numbers("a.b.c.w(2)").values, W[:, 1])


@pytest.mark.parametrize("version", VERSIONS)
def test_what_is_no_column_is_left_out_and_named(version):
    """A workspace: a scalar, an inertia, a calibration of another length, a text, a picture."""
    beside = {"mass": 4.5, "J": np.eye(3), "bias": np.ones((7, 2)), "name": "platform",
              "picture": np.ones((100, 65))}  # fmt: skip
    found = table(VERSIONS[version](beside | SIMPLE))
    assert len(found.names) == 8
    (note,) = found.notes
    assert note.startswith("Left out of the table of 40 rows: ")
    for words in ("'mass' (1 x 1)", "'J' (3 x 3)", "'bias' (7 x 2)", "'picture' (100 x 65)"):
        assert words in note
    assert "name" not in note


def test_a_long_note_is_cut_short():
    scalars = {f"gain{k}": float(k) for k in range(15)}
    (note,) = table(mat_5(scalars | SIMPLE)).notes
    assert note.endswith("'gain11' (1 x 1) and 3 more.")


def test_small_matrices_do_not_outvote_the_rows_of_a_recording():
    """Three turns and two inertias are fifteen columns of three rows; the recording has eight."""
    small = {f"R{k}": np.eye(3) for k in range(5)}
    assert table(mat_5(small | SIMPLE)).count == ROWS


@pytest.mark.parametrize("shape", [(3, 16), (17, 3), (2, 9)])
def test_a_matrix_of_few_columns_stays_as_it_is(shape):
    """It is turned only if it has more than 16 columns and at most 16 rows."""
    values = np.arange(shape[0] * shape[1], dtype=float).reshape(shape)
    found = table(mat_5({"m": values}))
    assert (found.count, len(found.names)) == shape
    np.testing.assert_array_equal(found.numbers("m(2)").values, values[:, 1])


@pytest.mark.parametrize("version", VERSIONS)
def test_a_file_in_which_nothing_fits_is_refused(version):
    content = VERSIONS[version]({"mass": 4.5, "J": np.eye(3), "empty": np.zeros((0, 0))})
    with pytest.raises(InputError, match=r"no variable with rows of numbers, only .*'J' \(3 x 3\)"):
        table(content)


def test_complex_numbers_cells_and_arrays_of_structures_are_left_aside():
    kind = [("v", "O")]
    several = np.array([(T,), (T,)], dtype=kind)
    cell = np.empty((1, 2), dtype=object)
    cell[0, 0], cell[0, 1] = T, W
    found = table(mat_5(SIMPLE | {"z": T * 1j, "several": several, "cell": cell}))
    assert len(found.names) == 8


@pytest.mark.parametrize("dtype", ["f4", "i4", "u1", "bool"])
@pytest.mark.parametrize("version", ["5", "7.3"])
def test_numbers_of_every_type_are_read(version, dtype):
    values = (np.arange(ROWS)[:, np.newaxis] % 2).astype(dtype)
    found = table(VERSIONS[version](SIMPLE | {"lamp": values}))
    np.testing.assert_array_equal(found.numbers("lamp").values, np.arange(ROWS) % 2)


# --- Version 4 -----------------------------------------------------------------------------------

CODES = [(10, "f4"), (20, "i4"), (30, "i2"), (40, "u2"), (50, "u1"), (0, "f8")]


@pytest.mark.parametrize(("first", "order"), [(0, "<"), (1000, ">")])
@pytest.mark.parametrize(("code", "dtype"), CODES)
def test_every_type_of_version_4_is_read(code, dtype, first, order):
    """Tens of the type: single, int32, int16, uint16, uint8; thousands: the order of bytes."""
    values = np.arange(12).reshape(6, 2)
    found = table(mat_4_of(order, dtype, first + code, "counts", values))
    np.testing.assert_array_equal(found.numbers("counts(2)").values, values[:, 1])


def test_texts_and_complex_numbers_of_version_4_are_left_aside():
    content = mat_4({"name": "platform", "z": T * 1j} | SIMPLE)
    assert len(table(content).names) == 8


def test_a_matrix_of_version_4_that_is_cut_is_refused():
    with pytest.raises(
        InputError, match=r"a MAT file that cannot be read \(a matrix beyond the end\)"
    ):
        table(mat_4(SIMPLE)[:-1])
    with pytest.raises(
        InputError, match=r"a MAT file that cannot be read \(byte \d+ begins no matrix\)"
    ):
        table(mat_4(SIMPLE) + b"more")


# --- Version 7.3 ---------------------------------------------------------------------------------


def test_without_h5py_the_sentence_names_the_extra(tmp_path, monkeypatch):
    (tmp_path / "run.mat").write_bytes(mat_73(SIMPLE))
    monkeypatch.setitem(sys.modules, "h5py", None)
    with pytest.raises(InputError, match=r'pip install "equipoise\[matlab\]"`.*.-v7.'):
        read_recording(tmp_path / "run.mat")


def test_a_data_set_that_its_file_cannot_hold_is_refused():
    """40 rows become 1e12 where the size of the data set stands, and that of its piece."""
    content = mat_73({"t": T})
    size = struct.pack("<QQ", 1, ROWS)
    assert size in content
    with pytest.raises(InputError, match="more than 256 MB once it is read"):
        table(content.replace(size, struct.pack("<QQ", 1, 10**12)))


# --- Broken --------------------------------------------------------------------------------------


def tries_of(version: str) -> int:
    """How many broken files are tried; each of HDF5 takes a process."""
    return count(300, 20 if version == "7.3" else 300)


def test_a_file_whose_library_comes_to_no_end_is_refused():
    with pytest.raises(InputError, match="not read within 3 s of processor time"):
        table(mat_73_without_end())


CRASH = "import os, signal; os.kill(os.getpid(), signal.SIGSEGV)"
FAULT = (
    "import json, sys; request = json.loads(sys.argv[1]); sys.path[:] = request.pop('path'); "
    "import equipoise.io.formats.matlab.hdf5_process as process; "
    "process.variables_73 = lambda *_: 1 / 0; process.hand_on(**request)"
)


def test_a_library_that_crashes_takes_nothing_with_it(monkeypatch):
    monkeypatch.setattr(hdf5_process, "BEGIN", CRASH)
    with pytest.raises(InputError, match="the library that reads it ended by SIGSEGV"):
        table(mat_73(SIMPLE))


def test_a_fault_of_ours_beside_the_library_is_no_broken_file(monkeypatch, tmp_path):
    monkeypatch.setattr(hdf5_process, "BEGIN", FAULT)
    with pytest.raises(UnforeseenError, match=r"(?s)RuntimeError.*division by zero"):
        read_of(tmp_path / "run.mat", mat_73(SIMPLE))


@pytest.mark.parametrize("version", VERSIONS)
def test_a_broken_file_is_refused_or_read(tmp_path, version):
    """Columns are those of our own files, so that what is read becomes a recording."""
    rates = {f"omega_{k}_rad_s": W[:6, [i]] for i, k in enumerate("xyz")}
    content = VERSIONS[version]({"time_s": T[:6], "J": np.eye(3)} | rates)
    assert len(read_of(tmp_path / "run.mat", content).rate) == 6
    tries = tries_of(version)
    assert times_refused(content, tmp_path / "run.mat", tries) > tries // 10


@pytest.mark.parametrize("version", WITH_STRUCTURES)
def test_a_broken_structure_is_refused_or_read(version):
    content = VERSIONS[version]({"a": {"t": T[:5], "b": {"w": W[:5]}}})
    rng = np.random.default_rng(1)
    for _ in range(tries_of(version)):
        at = int(rng.integers(len(content)))
        garbled = content[:at] + rng.bytes(1) + content[at + 1 :]
        with contextlib.suppress(InputError):
            found = table(garbled)
            assert {len(found.numbers(name).values) for name in found.names} == {found.count}


@pytest.mark.parametrize("version", VERSIONS)
def test_a_compressed_file_is_read_too(tmp_path, version):
    path = tmp_path / "run.mat.gz"
    path.write_bytes(gzip.compress(VERSIONS[version](SIMPLE)))
    options = mapped(t=("t",), rate=("w(1)", "w(2)", "w(3)"))
    np.testing.assert_array_equal(read_recording(path, options).rate.values, W)


def read_of(path: Path, content: bytes):
    path.write_bytes(content)
    return read_recording(path)
