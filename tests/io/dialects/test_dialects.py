"""Tables of other programs: made by hand here from a known motion, read back to it."""

import numpy as np
import pytest

from equipoise.io.columns.read_options import ReadOptions
from equipoise.io.recording.recording_file import read_recording
from equipoise.maths.attitude import exponential, to_matrix
from equipoise.model.errors import InputError

T = np.arange(12) * 0.1
# Body to laboratory, Z up: a lean about x, then a spin about the vertical.
Q = exponential(np.outer(T, [0.02, 0.0, 0.5]))
W = np.tile([0.02, 0.01, 0.5], (12, 1))
# The same in a laboratory whose Y points up: (x, y, z) there is (x, -z, y) of Z-up.
Z_FROM_Y = np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]])


def same_attitude(q, expected, atol: float = 1e-12) -> None:
    """Compare rotations, whatever the sign of the quaternions."""
    np.testing.assert_allclose(to_matrix(q), to_matrix(expected), atol=atol)


def csv_of(header: str, *columns: np.ndarray, separator: str = ",") -> str:
    """Return a table."""
    rows = np.column_stack(columns)
    text = [header, *(separator.join(map(repr, map(float, r))) for r in rows)]
    return "\n".join(text) + "\n"


def read(tmp_path, text: str, dialect: str | None = None, **stated):
    """Write and read a table."""
    (tmp_path / "r.csv").write_text(text)
    return read_recording(tmp_path / "r.csv", ReadOptions(dialect, **stated))


def optitrack(q: np.ndarray = Q) -> str:
    """Return a table as derived from Motive, with a row number and derived rates."""
    head = ",Time (Seconds),W,X,Y,Z,omega_x rad,omega_y rad,omega_z rad"
    return csv_of(head, np.arange(12), T, q, W)


def test_optitrack_rotates_a_y_up_laboratory_to_z_up_and_keeps_body_axes(tmp_path) -> None:
    """R_Z = Z_FROM_Y R_Y, so a body vector ends where it was, in new laboratory axes."""
    recording = read(tmp_path, optitrack())
    expected = np.einsum("ij,njk->nik", Z_FROM_Y, to_matrix(Q))
    np.testing.assert_allclose(to_matrix(recording.attitude.values), expected, atol=1e-12)
    np.testing.assert_array_equal(recording.attitude.t, T)
    assert recording.rate is None
    assert any("derived" in note for note in recording.notes)


def test_optitrack_rows_may_be_means_of_frames(tmp_path) -> None:
    """10 % short is no error there; the lengths are kept."""
    q = 0.9 * Q
    q[-1] = Q[-1]
    recording = read(tmp_path, optitrack(q))
    assert "means of several frames" in " ".join(recording.notes)
    lengths = np.append(np.full(len(Q) - 1, 0.9), 1.0)
    np.testing.assert_allclose(recording.attitude_norm.values[:, 0], lengths, atol=1e-12)


def motive() -> str:
    """Return an export of Motive itself: header lines, X Y Z W, positions, an occluded frame."""
    lines = [
        "Format Version,1.23,Take Name,T1,Export Frame Rate,10,Rotation Type,Quaternion",
        "",
        ",,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid Body",
        ",,Table,Table,Table,Table,Table,Table,Table,Table",
        ',,"1","1","1","1","1","1","1","1"',
        ",,Rotation,Rotation,Rotation,Rotation,Position,Position,Position,Mean Marker Error",
        "Frame,Time (Seconds),X,Y,Z,W,X,Y,Z,",
    ]
    for i, (t, q) in enumerate(zip(T, Q, strict=True)):
        cells = [*np.roll(q, -1), 0.1, 1.2, 0.3, 0.0001]
        shown = [""] * 8 if i == 5 else [repr(float(c)) for c in cells]
        lines.append(",".join([str(i), repr(float(t)), *shown]))
    return "\r\n".join(lines) + "\r\n"


def test_a_motive_export_is_read_past_its_header_lines(tmp_path) -> None:
    """X, Y, Z occur twice; the rotation is meant, W last, and the occluded frame is absent."""
    recording = read(tmp_path, motive())
    expected = np.einsum("ij,njk->nik", Z_FROM_Y, to_matrix(np.delete(Q, 5, axis=0)))
    np.testing.assert_allclose(to_matrix(recording.attitude.values), expected, atol=1e-12)


def test_a_motive_export_with_angles_says_what_to_export(tmp_path) -> None:
    """Without W there is no quaternion."""
    with pytest.raises(InputError, match="rotation as a quaternion"):
        read(tmp_path, "Frame,Time (Seconds),X,Y,Z\n0,0,1,2,3\n1,0.1,1,2,3\n")


AXES = "xyzw"


def ros_names(pattern: str, topic: str) -> str:
    """Return column names of an Imu message."""
    names = [f"{topic}/orientation/{a}" for a in AXES]
    names += [f"{topic}/angular_velocity/{a}" for a in "xyz"]
    return ",".join(names).replace("/", pattern) if pattern == "." else ",".join(names)


def test_plotjuggler_columns_are_read(tmp_path) -> None:
    """__time counts from 1970: it starts at zero here, and that is said."""
    header = "__time," + ros_names("/", "/imu/data")
    recording = read(tmp_path, csv_of(header, 1.7e9 + T, np.roll(Q, -1, axis=1), W))
    same_attitude(recording.attitude.values, Q)
    np.testing.assert_array_equal(recording.rate.values, W)
    np.testing.assert_allclose(recording.rate.t, T, atol=1e-6)  # a double near 1.7e9: 2.4e-7
    assert any("clock starts at 1700000000.000 s" in note for note in recording.notes)


def test_stamps_in_seconds_and_nanoseconds_keep_their_nanoseconds(tmp_path) -> None:
    """Seconds are taken off before the parts are added: 1e-9 s survive 1.7e9 s."""
    header = "header.stamp.sec,header.stamp.nanosec," + ros_names(".", "imu")
    seconds, nanos = np.divmod(np.arange(12) * 300_000_001, 1_000_000_000)
    stamps = np.column_stack([1_700_000_000 + seconds, nanos])
    recording = read(tmp_path, csv_of(header, stamps, np.roll(Q, -1, axis=1), W))
    steps = np.diff(recording.rate.t)
    np.testing.assert_allclose(steps, 0.300000001, atol=1e-12)


def test_text_columns_beside_the_numbers_do_no_harm(tmp_path) -> None:
    """frame_id is text and nobody asks for it."""
    lines = csv_of("__time," + ros_names("/", "/imu"), T, np.roll(Q, -1, axis=1), W).splitlines()
    text = "\n".join([lines[0] + ",frame_id", *(line + ",imu_link" for line in lines[1:])])
    assert len(read(tmp_path, text).rate) == 12


def test_two_topics_at_their_own_times_share_a_table(tmp_path) -> None:
    """PlotJuggler leaves cells blank where a topic is silent."""
    header = "__time," + ros_names("/", "/a")
    rows = []
    for i, t in enumerate(T):
        q = ",".join(map(repr, map(float, np.roll(Q[i], -1))))
        w = ",".join(map(repr, map(float, W[i])))
        rows.append(f"{t},{q},,," if i % 2 else f"{t},,,,,{w}")
    recording = read(tmp_path, "\n".join([header, *rows]))
    assert len(recording.attitude) == len(recording.rate) == 6


@pytest.mark.parametrize("columns", [[3], [0, 1, 2]])
def test_dead_channels_of_other_programs_are_ignored_and_reported(tmp_path, columns) -> None:
    """A gyro with a dead axis, or an orientation nobody computed, goes as a whole."""
    q, w = np.roll(Q, -1, axis=1), W.copy()
    if columns == [3]:
        q = np.zeros_like(q)
    else:
        w[:, 1] = 0.0
    recording = read(tmp_path, csv_of("__time," + ros_names("/", "/imu"), T, q, w))
    gone = recording.attitude if columns == [3] else recording.rate
    assert gone is None
    assert any("ignored" in note for note in recording.notes)


def test_backward_rows_of_other_programs_are_left_out_and_counted(tmp_path) -> None:
    """Messages that arrive late are dropped; a clock that starts anew is an error."""
    late = T.copy()
    late[6] = 0.33
    header = "__time," + ros_names("/", "/imu")
    recording = read(tmp_path, csv_of(header, late, np.roll(Q, -1, axis=1), W), bad_rows=0.1)
    assert len(recording.rate) == 11
    assert any("1 row whose time is out of order, line 8" in note for note in recording.notes)
    anew = np.append(T[:4] + 50, T[:8])
    with pytest.raises(InputError, match="line 6: found time going backwards"):
        read(tmp_path, csv_of(header, anew, np.roll(Q, -1, axis=1), W))


def test_rostopic_echo_tables_have_stamps_in_nanoseconds(tmp_path) -> None:
    """The columns begin with field., the time with %."""
    names = "%time,field.header.stamp," + ros_names(".", "field").replace("field/", "field.")
    nanos = 1_700_000_000_000_000_000 + np.arange(12) * 100_000_000
    rows = [
        ",".join([str(n), str(n), *(repr(float(v)) for v in (*np.roll(q, -1), *w))])
        for n, q, w in zip(nanos.tolist(), Q, W, strict=True)
    ]
    recording = read(tmp_path, "\n".join([names, *rows]))
    np.testing.assert_allclose(recording.rate.t, T, atol=1e-6)


@pytest.mark.parametrize("title", ["imu_orientation_{}", "pose.pose.orientation.{}"])
def test_other_spellings_of_topics_are_read(tmp_path, title) -> None:
    """Underscores and nested messages."""
    names = ",".join(["Time", *(title.format(a) for a in AXES)])
    recording = read(tmp_path, csv_of(names, T, np.roll(Q, -1, axis=1)))
    same_attitude(recording.attitude.values, Q)
