"""Tables of phyphox, and of roll, pitch and yaw, made by hand of a known turn."""

import numpy as np
import pytest

from equipoise.model.errors import InputError
from tests.io.columns.known_turns import TILT, TURN, YAW, T, cells, is_known_turn, read

W = np.column_stack([np.sin(T), np.cos(T), 0.1 + T])


def table(header: list[str], *columns, separator: str = ",") -> str:
    """Return a table with quoted names."""
    names = separator.join(f'"{name}"' for name in header)
    return "\n".join([names, *(separator.join(row) for row in cells(*columns))]) + "\n"


@pytest.mark.parametrize("separator", [",", ";", "\t"])
def test_the_gyroscope_of_a_phone_is_read(tmp_path, separator) -> None:
    """As phyphox exports it, with the magnitude beside it."""
    names = ["Time (s)", *(f"Gyroscope {axis} (rad/s)" for axis in "xyz"), "Absolute (rad/s)"]
    text = table(names, T, W, np.linalg.norm(W, axis=1), separator=separator)
    recording = read(tmp_path, text)
    np.testing.assert_array_equal(recording.rate.values, W)
    np.testing.assert_array_equal(recording.rate.t, T)
    assert recording.attitude is None


def test_the_attitude_of_a_phone_is_read(tmp_path) -> None:
    """Scalar first, device to east-north-up."""
    q = np.roll(TURN.as_quat(), 1, axis=1)
    is_known_turn(read(tmp_path, table(["Time (s)", "w", "x", "y", "z"], T, q)))


def test_phyphox_without_its_columns_is_refused(tmp_path) -> None:
    """A named dialect that does not fit says what it would have."""
    with pytest.raises(InputError, match="neither gyroscope nor attitude; wanted 'Time"):
        read(tmp_path, table(["Time (s)", "Light (lx)"], T, T), dialect="phyphox")


# Roll, pitch and yaw (deg, about turned axes Z, Y, X) of the known turn: the tilt is about x.
ROLL, PITCH = np.full(8, TILT), np.zeros(8)
NAMES = {
    "underscores": (["time_s", "roll_deg", "pitch_deg", "yaw_deg"], 1.0, 1.0),
    "brackets": (["Time (s)", "Roll (deg)", "Pitch (deg)", "Yaw (deg)"], 1.0, 1.0),
    "radians": (["ms", "yaw[rad]", "pitch[rad]", "roll[rad]"], 1e3, np.pi / 180),
    "a sign": (["timestamp_us", "roll (°)", "pitch (°)", "yaw (°)"], 1e6, 1.0),
}


@pytest.mark.parametrize(("names", "time", "angle"), NAMES.values(), ids=NAMES.keys())
def test_angles_with_units_are_read_in_the_sequence_that_is_said(
    tmp_path, names, time, angle
) -> None:
    """Columns in any order; the assumption is a note."""
    by_name = {"r": ROLL, "p": PITCH, "y": YAW}
    columns = [by_name[name[0].lower()] * angle for name in names[1:]]
    recording = read(tmp_path, table(names, T * time, *columns))
    is_known_turn(recording)
    np.testing.assert_allclose(recording.attitude.t, T, atol=1e-12)
    assert any("ZYX" in note and "--columns" in note for note in recording.notes)


def test_a_pitch_turns_about_the_turned_y(tmp_path) -> None:
    """Yaw 90 deg, then pitch 20 deg nose-down about the turned y: x ends at (0, cos, -sin)."""
    names = ["t", "roll_deg", "pitch_deg", "yaw_deg", "spare"]
    columns = np.tile([0.0, 20.0, 90.0, 1.0], (8, 1)) + np.outer(np.arange(8), [0, 0, 0, 1.0])
    recording = read(tmp_path, table(names, T, columns))
    w, x, y, z = recording.attitude.values[0]
    nose = [1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)]
    np.testing.assert_allclose(
        nose, [0, np.cos(np.radians(20)), -np.sin(np.radians(20))], atol=1e-12
    )
    assert any("'t' was taken as seconds" in note for note in recording.notes)
    assert any("'spare'" in note for note in recording.notes)


BAD = {
    "no unit": (["t", "roll", "pitch", "yaw"], ["without a unit", "'yaw_deg'", "column map"]),
    "no unit of time": (["timestamp", "roll_deg", "pitch_deg", "yaw_deg"], ["no time column"]),
    "one angle short": (["t", "roll_deg", "pitch_deg", "heading"], ["known dialect"]),
}


@pytest.mark.parametrize(("names", "words"), BAD.values(), ids=BAD.keys())
def test_angles_that_leave_something_open_are_refused(tmp_path, names, words) -> None:
    """Nothing is guessed."""
    with pytest.raises(InputError) as caught:
        read(tmp_path, table(names, T, ROLL, PITCH, YAW))
    assert all(word in str(caught.value) for word in words)


def test_a_named_dialect_says_which_angle_lacks(tmp_path) -> None:
    """The header is named."""
    names = ["t", "roll_deg", "pitch_deg", "heading"]
    with pytest.raises(InputError, match="header: found no yaw; wanted roll, pitch and yaw"):
        read(tmp_path, table(names, T, ROLL, PITCH, YAW), dialect="euler")
