"""Column maps that a person declares: units, order, frames, signs."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from equipoise.io.columns.axis_permutation import TO_Z_UP, axes_matrix
from equipoise.io.columns.column_map_file import read_column_map
from equipoise.io.columns.read_options import ReadOptions
from equipoise.io.recording.recording_file import read_recording
from equipoise.maths.attitude import conjugate, exponential, from_euler321, from_matrix, to_matrix
from equipoise.model.errors import InputError

T = np.arange(30) * 0.1
Q = exponential(np.outer(T, [0.05, -0.02, 0.4]))
W = np.outer(np.cos(T), [0.1, 0.2, 0.3])
MAP = """
[time]
column = "t"
unit = "ms"
[attitude]
columns = ["a", "b", "c", "d"]
order = "wxyz"
[rate]
columns = ["gx", "gy", "gz"]
unit = "deg/s"
[[mass]]
name = "x1"
column = "stage"
unit = "um"
[[mass]]
name = "x2"
column = "rail"
unit = "mm"
"""


def write(tmp_path, text: str, q=Q, extra: str = "") -> tuple[str, str]:
    """Write a foreign table and a map; return their paths."""
    stage = np.linspace(0, 1500, len(T))
    rows = np.column_stack([T * 1e3, q, np.degrees(W), stage, stage])
    names = ["t", "a", "b", "c", "d"][: 1 + q.shape[1]] + ["gx", "gy", "gz", "stage", "rail"]
    body = "\n".join(",".join(map(repr, map(float, r))) for r in rows)
    (tmp_path / "r.csv").write_text(f"{extra}{','.join(names)}\n{body}\n")
    (tmp_path / "map.toml").write_text(text)
    return str(tmp_path / "r.csv"), str(tmp_path / "map.toml")


def read(tmp_path, text: str, q=Q, extra: str = ""):
    """Read a foreign table through a declared map."""
    table, columns = write(tmp_path, text, q, extra)
    return read_recording(table, ReadOptions(columns=read_column_map(columns)))


def test_declared_units_become_si(tmp_path) -> None:
    """ms, deg/s, um and mm: s, rad/s and m, each mass in its own unit."""
    recording = read(tmp_path, MAP)
    np.testing.assert_allclose(recording.attitude.t, T, atol=1e-12)
    np.testing.assert_allclose(recording.rate.values, W, atol=1e-14)
    assert recording.mass_names == ("x1", "x2")
    np.testing.assert_allclose(recording.masses.values[-1], [1.5e-3, 1.5], rtol=1e-12)
    np.testing.assert_array_equal(recording.attitude.values, Q)


def test_devices_and_a_magnetometer_are_declared_with_their_units(tmp_path) -> None:
    """rpm, deg, mA m2, uT and mN m, all of one column; nT, in axes of its own."""
    device = '[[device]]\nname = "{}"\nreports = "{}"\ncolumn = "stage"\nunit = "{}"\n'
    kinds = [
        ("x", "wheel", "rpm"),
        ("a", "gimbal", "deg"),
        ("m", "dipole", "mA m2"),
        ("c", "cage", "uT"),
        ("j", "jet", "mN m"),
    ]
    field = '[field]\ncolumns = ["gx", "gy", "gz"]\nunit = "nT"\naxes = ["y", "-x", "z"]\n'
    recording = read(tmp_path, MAP + "".join(device.format(*kind) for kind in kinds) + field)
    assert recording.device_names == ("wheel:x", "gimbal:a", "dipole:m", "cage:c", "jet:j")
    last = [1500 * np.pi / 30, 1500 * np.pi / 180, 1.5, 1.5e-3, 1.5]
    np.testing.assert_allclose(recording.devices.values[-1], last, rtol=1e-12)
    turned = np.degrees(W)[:, [1, 0, 2]] * [1, -1, 1]
    np.testing.assert_allclose(recording.field.values, turned * 1e-9, rtol=1e-12)


def test_an_accelerometer_and_a_sun_sensor_are_declared(tmp_path) -> None:
    """Standard gravity in m/s2; a unit vector in axes of its own."""
    triad = '[{}]\ncolumns = ["gx", "gy", "gz"]\nunit = "{}"\n'
    axes = 'axes = ["y", "-x", "z"]\n'
    added = triad.format("accelerometer", "g0") + triad.format("sun", "1") + axes
    recording = read(tmp_path, MAP + added)
    np.testing.assert_allclose(recording.accelerometer.values, 9.80665 * np.degrees(W), rtol=1e-12)
    turned = np.degrees(W)[:, [1, 0, 2]] * [1, -1, 1]
    np.testing.assert_allclose(recording.sun.values, turned, rtol=1e-12)


@pytest.mark.parametrize(
    ("kind", "unit", "words"),
    [("wheel", "N m", "rad/s"), ("jet", "rpm", "N m"), ("rotor", "rpm", "'wheel', 'gimbal'")],
)
def test_a_device_in_a_unit_that_it_cannot_have_is_refused(tmp_path, kind, unit, words) -> None:
    """A speed is no torque, and a kind that is not known is named."""
    device = f'[[device]]\nname = "x"\nreports = "{kind}"\ncolumn = "stage"\nunit = "{unit}"\n'
    with pytest.raises(InputError, match=words):
        read(tmp_path, MAP + device)


def test_order_and_direction_are_declared(tmp_path) -> None:
    """Scalar last, laboratory to body: the same attitudes."""
    text = MAP.replace('"wxyz"', '"xyzw"\nturns = "laboratory to body"')
    recording = read(tmp_path, text, np.roll(conjugate(Q), -1, axis=1))
    np.testing.assert_allclose(recording.attitude.values, Q, atol=1e-15)


def test_skipped_rows_separator_and_decimal_comma_are_declared(tmp_path) -> None:
    """Two remark lines with numbers in them do not pass for data."""
    head = 'skip_rows = 2\nseparator = ";"\ndecimal = ","\n'
    table, columns = write(tmp_path, head + MAP)
    text = Path(table).read_text()
    foreign = "1;2;3\n4;5;6\n" + text.replace(",", ";").replace(".", ",")
    (tmp_path / "r.csv").write_text(foreign)
    recording = read_recording(table, ReadOptions(columns=read_column_map(columns)))
    np.testing.assert_array_equal(recording.attitude.values, Q)


@pytest.mark.parametrize("sequence", ["ZYX", "xyz"])
def test_angles_are_read_in_the_declared_sequence_and_wraps_are_reported(
    tmp_path, sequence
) -> None:
    """Yaw, pitch, roll about turned axes is roll, pitch, yaw about fixed ones (3-2-1)."""
    yaw = np.linspace(150, 390, 30)
    pitch, roll = np.linspace(-20, 20, 30), np.linspace(5, -5, 30)
    wrapped = (yaw + 180) % 360 - 180
    order = [wrapped, pitch, roll] if sequence == "ZYX" else [roll, pitch, wrapped]
    text = MAP.replace('"c", "d"]\norder = "wxyz"', f'"c"]\nunit = "deg"\nsequence = "{sequence}"')
    recording = read(tmp_path, text, np.column_stack(order))
    expected = from_euler321(*np.radians([roll, pitch, yaw]))
    np.testing.assert_allclose(
        to_matrix(recording.attitude.values), to_matrix(expected), atol=1e-12
    )
    assert np.all(np.sum(np.diff(recording.attitude.values, axis=0) ** 2, axis=1) < 0.1)
    assert any("1 wraps" in note for note in recording.notes)


def test_body_axes_are_relabelled_for_attitude_and_rate_alike(tmp_path) -> None:
    """Our y is their -z, our z their y: a vector fixed in the body keeps its place in the lab."""
    recording = read(tmp_path, 'body = ["x", "-z", "y"]\n' + MAP)
    ours = np.einsum("nij,nj->ni", to_matrix(recording.attitude.values), recording.rate.values)
    theirs = np.einsum("nij,nj->ni", to_matrix(Q), W)
    np.testing.assert_allclose(ours, theirs, atol=1e-14)
    np.testing.assert_allclose(recording.rate.values, W[:, [0, 2, 1]] * [1, -1, 1], atol=1e-14)


def test_a_gyro_may_have_axes_of_its_own(tmp_path) -> None:
    """An IMU mounted upside down is turned, the attitude is not."""
    text = MAP.replace('unit = "deg/s"', 'unit = "deg/s"\naxes = ["x", "-y", "-z"]')
    recording = read(tmp_path, text)
    np.testing.assert_allclose(recording.rate.values, W * [1, -1, -1], atol=1e-14)
    np.testing.assert_array_equal(recording.attitude.values, Q)


@pytest.mark.parametrize("up", TO_Z_UP)
def test_every_laboratory_turns_its_up_to_z(up) -> None:
    """The named axis becomes (0, 0, 1)."""
    axis = np.eye(3)["xyz".index(up[-1])] * (-1 if up[0] == "-" else 1)
    np.testing.assert_allclose(to_matrix(np.array(TO_Z_UP[up])) @ axis, [0, 0, 1], atol=1e-15)


@settings(max_examples=60, deadline=None)
@given(st.lists(st.floats(-3, 3), min_size=3, max_size=3))
def test_a_matrix_and_its_quaternion_are_one_rotation(vector) -> None:
    """Matrix -> quaternion -> matrix is the identity."""
    turn = to_matrix(exponential(np.array(vector)))
    np.testing.assert_allclose(to_matrix(from_matrix(turn)), turn, atol=1e-13)


def test_axes_matrix_reads_signs() -> None:
    """Row by row, our axes in theirs."""
    expected = [[0, 1, 0], [-1, 0, 0], [0, 0, 1]]
    np.testing.assert_array_equal(axes_matrix(("y", "-x", "z")), expected)


BAD = {
    "unknown unit": ('"ms"', '"msec"', ": time", ["'msec'", "'ms'"]),
    "unit of another kind": ('"deg/s"', '"deg"', ": rate", ["'deg'", "deg/s"]),
    "no order": ('order = "wxyz"', "", ": attitude", ["no 'order'"]),
    "three columns, no unit": ('"c", "d"]\norder = "wxyz"', '"c"]', ": attitude", ["sequence"]),
    "two columns": ('"gx", "gy", "gz"', '"gx", "gy"', ": rate.columns", ["list of 3"]),
    "misspelt key": ("column = ", "colum = ", ": time.colum", ["'column'"]),
    "left-handed": ("[time]", 'body = ["x", "y", "-z"]\n[time]', ": body", ["right-handed"]),
    "an axis twice": ("[time]", 'body = ["x", "x", "z"]\n[time]', ": body", ["different axes"]),
    "no such axis": ("[time]", 'lab_up = "up"\n[time]', ": lab_up", ["'up'", "'z'"]),
}


@pytest.mark.parametrize(("old", "new", "where", "words"), BAD.values(), ids=BAD.keys())
def test_a_bad_map_is_named_with_its_key(tmp_path, old, new, where, words) -> None:
    """File and key come first, then found and wanted."""
    assert old in MAP
    _, path = write(tmp_path, MAP.replace(old, new, 1))
    with pytest.raises(InputError) as caught:
        read_column_map(path)
    assert str(caught.value).startswith(f"{path}{where}")
    for word in words:
        assert word in str(caught.value)


def test_a_declared_column_that_is_not_there_names_the_nearest(tmp_path) -> None:
    """The header is named, and the column that is meant."""
    with pytest.raises(InputError, match="no column 'stages'; did you mean 'stage'"):
        read(tmp_path, MAP.replace('"stage"', '"stages"'))
