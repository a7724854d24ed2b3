"""What reading sets right, it reports."""

import numpy as np
import pytest

from equipoise.io.columns.read_options import BAD_ROWS, ReadOptions
from equipoise.io.recording.recording_file import read_recording
from equipoise.maths.attitude import exponential
from equipoise.model.errors import InputError

HEAD = "time_s,q_w,q_x,q_y,q_z,omega_x_rad_s,omega_y_rad_s,omega_z_rad_s\n"
T = np.arange(20) * 0.1
Q = exponential(np.outer(T, [0.0, 0.0, 0.3]))


def table(t=T, q=Q, w=None, head: str = HEAD) -> str:
    """Return a native table; the rate is a small made-up one."""
    w = np.tile([0.01, 0.02, 0.3], (len(t), 1)) if w is None else w
    rows = np.column_stack([t, q, w])
    return head + "".join(",".join(map(repr, map(float, r))) + "\n" for r in rows)


def read(tmp_path, text: str, bad_rows: float = BAD_ROWS):
    """Write and read a table."""
    (tmp_path / "r.csv").write_text(text)
    return read_recording(tmp_path / "r.csv", ReadOptions(bad_rows=bad_rows))


def test_sign_flips_are_made_continuous_and_counted(tmp_path) -> None:
    """Rows 5 to 9 negated are two changes of sign; the attitudes are the same."""
    q = Q.copy()
    q[5:10] *= -1
    recording = read(tmp_path, table(q=q))
    np.testing.assert_array_equal(recording.attitude.values, Q)
    assert any("changed its sign 2 times" in note for note in recording.notes)


def test_short_quaternions_are_normalised_and_the_worst_line_is_named(tmp_path) -> None:
    """A row 1 % short is normalised; header is line 1, so the row of index 6 is line 8."""
    q = Q.copy()
    q[6] *= 0.99
    recording = read(tmp_path, table(q=q))
    np.testing.assert_allclose(recording.attitude.values, Q, atol=1e-15)
    assert any("1 of 20" in n and "0.990000 at line 8" in n for n in recording.notes)


def test_lengths_are_kept_at_the_rows_of_the_attitude(tmp_path) -> None:
    """One row 1 % short; a row with a second time stamp goes from both channels."""
    q, t = Q.copy(), T.copy()
    q[6] *= 0.99
    t[3] = t[2]
    recording = read(tmp_path, table(t=t, q=q))
    np.testing.assert_array_equal(recording.attitude_norm.t, recording.attitude.t)
    assert recording.attitude_norm.values.shape == (19, 1)
    assert recording.attitude_norm.values[5, 0] == pytest.approx(0.99, abs=1e-15)


@pytest.mark.parametrize("decimals", [4, 7])
def test_lengths_that_are_rounding_are_not_kept(tmp_path, decimals) -> None:
    """Four rounded components change a length by 10^-d at most; single precision by 1e-7."""
    assert read(tmp_path, table(q=np.round(Q, decimals))).attitude_norm is None
    assert read(tmp_path, table(q=Q.astype(np.float32).astype(float))).attitude_norm is None
    short = np.round(Q * (1 - 3 * 10.0**-decimals), decimals)
    assert read(tmp_path, table(q=short)).attitude_norm is not None


def test_duplicates_are_left_out_and_counted(tmp_path) -> None:
    """The first of each time stamp stays."""
    t = T.copy()
    t[7] = t[6]
    recording = read(tmp_path, table(t=t))
    assert len(recording.attitude) == len(recording.rate) == 19
    np.testing.assert_array_equal(recording.attitude.values[6], Q[6])
    assert sum("1 row with a duplicate time stamp, line 9; left out" in n for n in recording.notes)


def test_gaps_are_reported(tmp_path) -> None:
    """Eight rows lost out of a 0.1 s beat make a gap of 0.9 s."""
    keep = np.r_[0:6, 14:20]
    recording = read(tmp_path, table(t=T[keep], q=Q[keep]))
    assert any("attitude: 1 gap: 0.9 s from 0.5 s" in note for note in recording.gaps)


def test_a_gyro_of_zeros_is_ignored_and_reported(tmp_path) -> None:
    """Nothing was connected."""
    recording = read(tmp_path, table(w=np.zeros((20, 3))))
    assert recording.rate is None
    assert any("rate: zero in every row" in n and "ignored" in n for n in recording.notes)


def test_one_dead_axis_of_our_own_is_kept_and_reported(tmp_path) -> None:
    """An exact simulation may turn about two axes only."""
    recording = read(tmp_path, table(w=np.tile([0.1, 0.0, 0.2], (20, 1))))
    assert recording.rate is not None
    assert any("omega_y_rad_s" in note for note in recording.notes)


def test_a_last_row_cut_short_is_left_out(tmp_path) -> None:
    """A logger that lost power leaves half a row."""
    recording = read(tmp_path, table() + "2.0,0.9")
    assert len(recording.attitude) == 20
    assert any("last row (line 22) is cut short" in note for note in recording.notes)


@pytest.mark.parametrize("change", [str, lambda s: "\ufeff" + s, lambda s: s.replace("\n", "\r\n")])
@pytest.mark.parametrize("separator", [",", ";", "\t"])
def test_marks_line_ends_and_separators_do_not_matter(tmp_path, change, separator) -> None:
    """Byte-order mark, CRLF, semicolon and tab give the same recording."""
    text = change(table().replace(",", separator))
    (tmp_path / "r.csv").write_bytes(text.encode())
    np.testing.assert_array_equal(read_recording(tmp_path / "r.csv").attitude.values, Q)


def test_decimal_commas_are_read_between_semicolons(tmp_path) -> None:
    """As spreadsheets write them in half of Europe."""
    recording = read(tmp_path, table().replace(",", ";").replace(".", ","))
    np.testing.assert_array_equal(recording.attitude.values, Q)


def test_utf_16_is_read(tmp_path) -> None:
    """As PowerShell redirects text."""
    (tmp_path / "r.csv").write_bytes(table().encode("utf-16"))
    np.testing.assert_array_equal(read_recording(tmp_path / "r.csv").attitude.values, Q)


ROS = "__time,/imu/orientation/x,/imu/orientation/y,/imu/orientation/z,/imu/orientation/w\n"


def foreign(t) -> str:
    """Return a table of another program."""
    rows = np.column_stack([t, Q[:, 1:], Q[:, 0]])
    return ROS + "".join(",".join(map(repr, map(float, r))) + "\n" for r in rows)


def test_a_stamp_of_another_clock_at_the_end_is_left_out(tmp_path) -> None:
    """1e9 s beyond a record of 1.9 s."""
    t = T.copy()
    t[-1] += 1e9
    recording = read(tmp_path, foreign(t))
    np.testing.assert_array_equal(recording.attitude.t, T[:-1])
    assert any("1 row of another time, line 21; left out" in n for n in recording.notes)


def test_a_stamp_of_another_clock_at_either_end_is_left_out(tmp_path) -> None:
    """The first is 0 while the clock counts from 1970, the last is of 2286."""
    t = T + 1.7e9
    t[0], t[-1] = 0.0, 1e10
    recording = read(tmp_path, foreign(t), bad_rows=0.1)
    np.testing.assert_allclose(recording.attitude.t, T[1:-1] - T[1], atol=1e-6)


def test_rows_behind_a_gap_that_a_bench_may_have_are_kept(tmp_path) -> None:
    """A quarter of an hour after two seconds; and a gap with half of the rows behind it."""
    t = T.copy()
    t[-1] += 1000.0
    assert len(read(tmp_path, foreign(t)).attitude) == 20
    t[10:] += 1e6
    assert len(read(tmp_path, foreign(t)).attitude) == 20


def test_seconds_beside_a_time_since_1970_are_refused(tmp_path) -> None:
    """Half of the rows each: neither is a stray; the whole would be a record of fifty years."""
    t = T.copy()
    t[10:] += 1.7e9
    with pytest.raises(InputError, match=r"1\.7e\+09 s; wanted at most 1e\+07 s: is the unit"):
        read(tmp_path, foreign(t))


def test_rows_closer_than_any_sensor_gives_are_refused(tmp_path) -> None:
    """A clock of nanoseconds that was divided once too often."""
    with pytest.raises(InputError, match=r"20 rows within .*is the unit of the time right"):
        read(tmp_path, foreign(T * 1e-9))
