"""Faulty rows are left out by one rule, whatever the file; a clock is set right before that."""

import numpy as np
import pytest

from equipoise.io.columns.column_map_file import read_column_map
from equipoise.io.columns.read_options import ReadOptions
from equipoise.io.formats.mat_table import mat_bytes
from equipoise.io.formats.parquet_table import parquet_bytes, parquet_of_cells
from equipoise.io.recording.recording_file import read_recording
from equipoise.maths.attitude import exponential
from equipoise.model.errors import InputError
from equipoise.model.growing_times import longest_rising

N = 100
T = np.arange(N) * 0.1
Q = exponential(np.outer(T, [0.0, 0.0, 0.3]))
NAMES = ("time_s", "q_w", "q_x", "q_y", "q_z", "omega_x_rad_s", "omega_y_rad_s", "omega_z_rad_s")
GOOD = np.column_stack([T, Q, np.tile([0.01, 0.02, 0.3], (N, 1))])


def lines(rows) -> list[str]:
    """Return rows as lines of a table."""
    return [",".join(map(repr, map(float, r))) for r in rows]


def read(tmp_path, body: list[str], header: str = ",".join(NAMES), **stated):
    """Write and read a table; data begin on line 2."""
    (tmp_path / "r.csv").write_text("\n".join([header, *body]) + "\n")
    return read_recording(tmp_path / "r.csv", ReadOptions(**stated))


# What a line (counted from 0) becomes, and how it is said; the header is line 1.
FAULTS = {
    "a cut line": ("1.0,0.98", "with fewer cells than the header, line 12"),
    "two lines in one": (lines(GOOD[10:12])[0] * 2, "with more cells than the header, line 12"),
    "no time": ("," + lines(GOOD[10:11])[0].split(",", 1)[1], "without a time, line 12"),
    "a stamp ahead": ("7.05," + lines(GOOD[10:11])[0].split(",", 1)[1], "out of order, line 12"),
    "a stamp far ahead": ("9e9," + lines(GOOD[10:11])[0].split(",", 1)[1], "out of order, line 12"),
    "a stamp behind": ("0.25," + lines(GOOD[10:11])[0].split(",", 1)[1], "out of order, line 12"),
    "a repeat": (lines(GOOD[9:10])[0], "with a duplicate time stamp, line 12"),
    "garbage": ("1.0,x1,0,0,0,0.01,0.02,0.3", "with a value that is no number, line 12"),
    "nothing but NaN": ("1.0" + ",NaN" * 7, "with a value that is no number, line 12"),
    "one NaN": ("1.0,nan,0,0,0.1,0.01,0.02,0.3", "with a value that is no number, line 12"),
    "infinity": ("1.0,inf,0,0,0.1,0.01,0.02,0.3", "with a value that is no number, line 12"),
    "one blank": ("1.0,,0,0,0.1,0.01,0.02,0.3", "with a blank cell beside numbers, line 12"),
    "zeros": ("1.0,0,0,0,0,0.01,0.02,0.3", "not unit length, line 12"),
    "a long quaternion": ("1.0,3,0,0,0,0.01,0.02,0.3", "not unit length, line 12"),
    "a header again": (",".join(NAMES), "without a time, line 12"),
}


@pytest.mark.parametrize(("bad", "words"), FAULTS.values(), ids=FAULTS.keys())
def test_a_faulty_row_is_left_out_and_named_and_no_other(tmp_path, bad, words) -> None:
    """Every other row stays as it is."""
    body = lines(GOOD)
    body[10] = bad
    recording = read(tmp_path, body)
    np.testing.assert_array_equal(recording.attitude.t, np.delete(T, 10))
    np.testing.assert_array_equal(recording.attitude.values, np.delete(Q, 10, axis=0))
    noted = [note for note in recording.notes if note.startswith("1 row ")]
    assert len(noted) == 1
    assert words in noted[0]


def test_rows_are_counted_over_all_faults_against_the_share(tmp_path) -> None:
    """Five of a hundred are left out, six are refused; the error names the most frequent fault."""
    body = lines(GOOD)
    for k in (10, 30, 50):
        body[k] = body[k].split(",", 1)[0] + ",0,0,0,0,0.01,0.02,0.3"
    for k in (20, 40):
        body[k] = body[k][:20]
    recording = read(tmp_path, body)
    assert len(recording.attitude) == N - 5
    assert len(recording.rate) == N - 2  # a quaternion of zeros says nothing of the gyro
    body[60] = body[60].split(",", 1)[0] + ",0,0,0,0,0.01,0.02,0.3"
    with pytest.raises(InputError, match=r"line 12: found a quaternion of length 0 \(6 of 100"):
        read(tmp_path, body)
    with pytest.raises(InputError, match=r"--bad-rows 0\.06"):
        read(tmp_path, body)
    assert len(read(tmp_path, body, bad_rows=0.06).attitude) == N - 6


def test_a_camera_that_was_lost_is_no_fault_where_the_gyro_went_on(tmp_path) -> None:
    """Thirty rows of NaN in one channel are rows of the other."""
    rows = GOOD.copy()
    rows[40:70, 1:5] = np.nan
    recording = read(tmp_path, lines(rows))
    assert (len(recording.attitude), len(recording.rate)) == (N - 30, N)
    assert not any("left out" in note for note in recording.notes)


@pytest.mark.parametrize("kind", ["mat", "parquet"])
def test_the_rule_is_the_same_in_other_files(tmp_path, kind) -> None:
    """NaN throughout, a zero quaternion, a repeat and infinity, each in one row."""
    rows = GOOD.copy()
    rows[10, 1:] = np.nan
    rows[20, 1:5] = 0.0
    rows[30, 0] = rows[29, 0]
    rows[40, 3] = np.inf
    columns = dict(zip(NAMES, rows.T, strict=True))
    path = tmp_path / f"r.{kind}"
    cells = {name: [float(x) for x in column] for name, column in columns.items()}
    path.write_bytes(mat_bytes(columns) if kind == "mat" else parquet_of_cells(cells, "r"))
    recording = read_recording(path)
    np.testing.assert_array_equal(recording.attitude.t, np.delete(T, [10, 20, 30, 40]))
    noted = " ".join(recording.notes)
    for words in ("no number, row 11, row 41", "unit length, row 21", "duplicate time stamp"):
        assert words in noted


def test_null_in_parquet_is_no_fault(tmp_path) -> None:
    """NaN that we write ourselves comes back as no reading."""
    rows = GOOD.copy()
    rows[10:60, 1:] = np.nan
    (tmp_path / "r.parquet").write_bytes(parquet_bytes(dict(zip(NAMES, rows.T, strict=True)), "r"))
    assert len(read_recording(tmp_path / "r.parquet").attitude) == N - 50


ROS = "__time," + ",".join(f"/imu/orientation/{a}" for a in "wxyz")


@pytest.mark.parametrize(
    ("start", "modulus"),
    [(2.0**32 * 1e-6 - 5, 2.0**32 * 1e-6), (86_395.0, 86_400.0), (604_797.0, 604_800.0)],
)
def test_a_clock_that_begins_anew_goes_on(tmp_path, start, modulus) -> None:
    """A board's microseconds, a clock of the day, a week of satellite navigation."""
    wrapped = (start + T) % modulus
    body = lines(np.column_stack([wrapped, Q]))
    recording = read(tmp_path, body, ROS)
    np.testing.assert_allclose(recording.attitude.t, T + start, atol=1e-6)
    assert any("restarted" in note for note in recording.notes)


def test_a_wrap_with_rows_lost_goes_on_too(tmp_path) -> None:
    """Seven rows are lost where a clock of the day restarts."""
    keep = np.r_[0:48, 55:N]
    body = lines(np.column_stack([(86_395.0 + T) % 86_400.0, Q])[keep])
    recording = read(tmp_path, body, ROS)
    np.testing.assert_allclose(recording.attitude.t, (T + 86_395.0)[keep], atol=1e-6)


def test_a_clock_that_restarts_is_refused_at_its_line(tmp_path) -> None:
    """Two records in one file: which is meant is for a person to say."""
    body = lines(np.column_stack([np.append(T[:60], T[:40]), Q]))
    with pytest.raises(InputError, match=r"line 62: found time going backwards, from 5\.9 s"):
        read(tmp_path, body, ROS)


def test_the_longest_run_that_does_not_fall_is_found() -> None:
    """By hand: of 3 1 2 9 2 4 the run 1 2 2 4 is the longest."""
    assert longest_rising(np.array([3.0, 1.0, 2.0, 9.0, 2.0, 4.0])).tolist() == [1, 2, 4, 5]


def test_of_two_records_in_one_file_none_is_spliced_from_both(tmp_path) -> None:
    """However many rows may be left out: the run that grows longest begins in the first."""
    body = lines(np.column_stack([np.append(T[:45], T[:55]), Q]))
    with pytest.raises(InputError, match=r"line 47: found time going backwards.* cut the file"):
        read(tmp_path, body, ROS, bad_rows=0.6)


def test_a_factor_beyond_any_bench_is_refused(tmp_path) -> None:
    """A map of such a factor made a recording of rates that no bench has."""
    (tmp_path / "m.toml").write_text(
        'time = {column = "time_s", unit = "s"}\n[rate]\nunit = "rpm"\nfactor = 1e5\n'
        'columns = ["omega_x_rad_s", "omega_y_rad_s", "big"]\n'
    )
    body = [f"{line},1e9" for line in lines(GOOD)]
    columns = read_column_map(tmp_path / "m.toml")
    with pytest.raises(
        InputError, match=r"line 2, column 'big'.*beyond 10000 in SI, more than any bench reaches"
    ):
        read(tmp_path, body, ",".join([*NAMES, "big"]), columns=columns)
