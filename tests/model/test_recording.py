from dataclasses import replace

import numpy as np
import pytest

from equipoise.model.devices import ControlMomentGyro, Device, JetPair, ReactionWheel
from equipoise.model.errors import InputError
from equipoise.model.recording import Recording, Samples, arranged, arranged_devices, join, window

LEVEL = [1.0, 0.0, 0.0, 0.0]


def attitude(t: np.ndarray) -> Samples:
    return Samples(t, np.tile(LEVEL, (len(t), 1)))


def ramp(t: np.ndarray, width: int) -> Samples:
    """Values that say which row they came from."""
    return Samples(t, np.outer(t, np.ones(width)))


def ten_seconds() -> Recording:
    """Camera at 1 Hz, gyro at 2 Hz from half a second on, masses moved between 3 s and 5 s."""
    return Recording(
        attitude=attitude(np.arange(0.0, 10.5)),
        rate=ramp(np.arange(0.5, 10.0, 0.5), 3),
        mass_names=("x1", "z1"),
        masses=ramp(np.array([0.0, 3.0, 5.0]), 2),
        source="hand",
        notes=("made for a test",),
    )


def test_period_is_of_most_rows():
    """Half a second between most, a row missing and a gap of ten seconds among them."""
    t = np.array([1.0, 1.5, 2.0, 3.0, 3.5, 13.5, 14.0])
    assert ramp(t, 3).period == 0.5
    assert ramp(t[2:4], 3).period == 1.0


def test_span_covers_every_sensor():
    both = Recording(attitude=attitude(np.array([1.0, 4.0])), rate=ramp(np.array([0.2, 3.0]), 3))
    assert both.span == (0.2, 4.0)


def test_span_is_of_sensors_alone():
    """Masses are known outside their rows, so their rows set no limit."""
    late = Recording(attitude=attitude(np.array([1.0, 2.0])), masses=ramp(np.array([0.0, 9.0]), 1))
    assert late.span == (1.0, 2.0)


def test_window_keeps_both_ends():
    part = window(ten_seconds(), 2.0, 4.0)
    assert part.attitude.t.tolist() == [2.0, 3.0, 4.0]
    assert part.rate.t.tolist() == [2.0, 2.5, 3.0, 3.5, 4.0]
    np.testing.assert_array_equal(part.rate.values[:, 0], part.rate.t)


def test_window_keeps_the_rows_that_masses_need():
    """From 3.5 s to 4.5 s the masses are between their rows at 3 s and 5 s: both stay."""
    assert window(ten_seconds(), 3.5, 4.5).masses.t.tolist() == [3.0, 5.0]
    assert window(ten_seconds(), 6.0, 9.0).masses.t.tolist() == [5.0]
    assert window(ten_seconds(), 3.0, 4.0).masses.t.tolist() == [3.0, 5.0]
    assert window(ten_seconds(), 0.0, 3.0).masses.t.tolist() == [0.0, 3.0]


def test_window_before_the_first_mass_row_keeps_it():
    """Masses are constant outside their rows, so the first row says where they were before."""
    recording = Recording(
        attitude=attitude(np.arange(0.0, 10.0)), mass_names=("x1",), masses=ramp(np.array([5.0]), 1)
    )
    assert window(recording, 0.0, 2.0).masses.t.tolist() == [5.0]


def test_window_does_not_change_known_values_inside():
    whole = ten_seconds()
    part = window(whole, 3.5, 8.0)
    t = np.linspace(3.5, 8.0, 50)
    for column in (0, 1):
        np.testing.assert_array_equal(
            np.interp(t, part.masses.t, part.masses.values[:, column]),
            np.interp(t, whole.masses.t, whole.masses.values[:, column]),
        )


def test_window_carries_names_and_absent_channels():
    part = window(ten_seconds(), 2.0, 4.0)
    assert part.mass_names == ("x1", "z1")
    assert part.source == "hand"
    assert part.notes == ("made for a test",)
    assert part.momentum is None
    assert part.torque is None


def test_windows_join_to_the_whole():
    whole = ten_seconds()
    again = join(window(whole, 0.0, 4.0), window(whole, 4.0, 10.0))
    for name in ("attitude", "rate", "masses"):
        np.testing.assert_array_equal(getattr(again, name).t, getattr(whole, name).t)
        np.testing.assert_array_equal(getattr(again, name).values, getattr(whole, name).values)


def test_join_takes_a_channel_that_one_side_lacks():
    camera = Recording(attitude=attitude(np.array([0.0, 1.0])))
    gyro = Recording(
        rate=ramp(np.array([0.0, 1.0]), 3), mass_names=("x1",), masses=ramp(np.array([0.0]), 1)
    )
    for both in (join(camera, gyro), join(gyro, camera)):
        assert both.attitude is camera.attitude
        assert both.rate is gyro.rate
        assert both.mass_names == ("x1",)


def test_join_after_an_empty_channel():
    empty = Recording(attitude=attitude(np.array([])))
    full = Recording(attitude=attitude(np.array([0.0, 1.0])))
    assert join(empty, full).attitude.t.tolist() == [0.0, 1.0]
    assert join(full, empty).attitude.t.tolist() == [0.0, 1.0]


def test_join_drops_duplicate_rows():
    a = Recording(rate=ramp(np.array([0.0, 1.0, 2.0]), 3))
    b = Recording(rate=ramp(np.array([1.0, 2.0, 3.0]), 3))
    assert join(a, b).rate.t.tolist() == [0.0, 1.0, 2.0, 3.0]


def with_lengths(recording: Recording) -> Recording:
    """Lengths that say which row they came from."""
    return replace(recording, attitude_norm=ramp(recording.attitude.t, 1))


def test_lengths_stay_with_the_rows_of_the_attitude():
    """Windowed, joined and arranged as they are, from both sides or from the second alone."""
    whole = with_lengths(ten_seconds())
    early, late = window(whole, 0.0, 4.0), window(whole, 3.0, 10.0)
    for rows in (early, late, join(early, late), arranged(whole, ("z1", "x1"))):
        np.testing.assert_array_equal(rows.attitude_norm.t, rows.attitude.t)
        np.testing.assert_array_equal(rows.attitude_norm.values[:, 0], rows.attitude.t)
    second_alone = join(replace(early, attitude_norm=None), late)
    assert second_alone.attitude_norm.t.tolist() == [5.0, 6.0, 7.0, 8.0, 9.0, 10.0]


X, Y = np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0])
DEVICES: tuple[Device, ...] = (
    ReactionWheel("x", X, 1e-4, 600.0, 0.01, speed=30.0),
    ReactionWheel("y", Y, 1e-4, 600.0, 0.01),
    ControlMomentGyro("a", X, Y, 1.0, 2.0, angle=0.5),
    JetPair("x", X, 0.02),
)


def of_devices(*names: str) -> Recording:
    """Rows at 0 s and 1 s; the k-th column is k + 1 throughout."""
    values = np.tile(np.arange(1.0, len(names) + 1), (2, 1))
    return Recording(device_names=names, devices=Samples(np.arange(2.0), values), source="r.csv")


def test_device_columns_come_in_the_order_of_the_devices():
    """A wheel and a jet of one name are distinguished."""
    there = arranged_devices(of_devices("jet:x", "gimbal:a", "wheel:x", "wheel:y"), DEVICES)
    assert there.device_names == ("wheel:x", "wheel:y", "gimbal:a", "jet:x")
    np.testing.assert_array_equal(there.devices.values, [[3, 4, 2, 1], [3, 4, 2, 1]])
    assert arranged_devices(there, DEVICES) is there


def test_a_device_that_was_not_recorded_stays_as_it_is_at_the_start():
    there = arranged_devices(of_devices("wheel:y"), DEVICES)
    np.testing.assert_array_equal(there.devices.values, [[30, 1, 0.5, 0], [30, 1, 0.5, 0]])


def test_a_record_without_devices_is_left_as_it_is():
    record = ten_seconds()
    assert arranged_devices(record, DEVICES) is record


@pytest.mark.parametrize(
    ("name", "devices", "words"),
    [
        ("wheel:yy", DEVICES, "r.csv: devices: found 'wheel:yy'; did you mean 'wheel:y'"),
        ("wheel:y", (), "wanted none: the testbed has none"),
    ],
)
def test_a_device_that_is_not_there_is_named_with_the_nearest(name, devices, words):
    with pytest.raises(InputError, match=words):
        arranged_devices(of_devices(name), devices)
