"""Logs that ArduPilot writes on board: attitude, rate, instances, and what is broken."""

import contextlib
import os
from math import cos, radians, sin

import numpy as np
import pytest
from pymavlink.DFReader import DFReader_binary

from equipoise.io.columns.read_options import ReadOptions
from equipoise.io.files.file_content import Content
from equipoise.io.logs.dataflash_log import messages_of
from equipoise.io.recording.recording_file import read_recording
from equipoise.model.errors import InputError
from tests.support import thorough
from tests.support.flight_logs import HEADING, dataflash, flight, layout, logged, times

HALF = radians(30) / 2


def read(tmp_path, content, *topics, instance=None, name="run.bin"):
    (tmp_path / name).write_bytes(content)
    return read_recording(tmp_path / name, ReadOptions(topics=topics, instance=instance))


def assert_turned(observed, x=0.0, y=0.0, z=0.0, within=1e-6):
    np.testing.assert_allclose(
        np.abs(observed.attitude.values @ [cos(HALF), x, y, z]), 1, atol=within
    )


@pytest.mark.parametrize("kind", ["XKQ", "NKQ1", "AHR2", "ATT"])
def test_a_heading_to_the_east_turns_the_other_way_about_up(tmp_path, kind):
    """Yaw of +30 deg in NED; a quaternion of single precision, an angle of 0.01 deg."""
    observed = read(tmp_path, flight(kind, "IMU"))
    np.testing.assert_allclose(observed.attitude.t, [0, 0.01, 0.02, 0.03], atol=1e-12)
    assert_turned(observed, z=-sin(HALF))
    np.testing.assert_allclose(observed.rate.values, [(0.1, -0.2, -0.3)] * 4, atol=1e-7)


@pytest.mark.parametrize(
    ("turn", "ours"),
    [
        ((cos(HALF), sin(HALF), 0.0, 0.0), {"x": sin(HALF)}),  # right side down
        ((cos(HALF), 0.0, sin(HALF), 0.0), {"y": -sin(HALF)}),  # nose up
    ],
)
def test_roll_stays_and_pitch_changes_its_sign(tmp_path, turn, ours):
    assert_turned(read(tmp_path, flight("XKQ", heading=turn)), **ours)


def test_angles_are_yaw_then_pitch_then_roll(tmp_path):
    """Yaw 90, pitch 90: north-east-down to ahead-right-down by two quarter turns, by hand.

    ahead points up, right points south, down points east: so our ahead (1 0 0) is (0 0 1) in north,
    west, up, and our left (0 1 0) is north (1 0 0).
    """
    rows = [logged("ATT", us, 0, 0, 0, 9000, 0, 9000) for us in times()]
    w, x, y, z = read(tmp_path, dataflash(*rows)).attitude.values[0]
    ahead = (1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y))
    left = (2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x))
    np.testing.assert_allclose(ahead, (0, 0, 1), atol=1e-6)
    np.testing.assert_allclose(left, (1, 0, 0), atol=1e-6)


def test_a_quaternion_goes_before_angles_and_an_inertial_units_rate_before_the_raw(tmp_path):
    observed = read(tmp_path, flight("ATT", "AHR2", "XKQ", "GYR", "IMU", "BARO"))
    assert "attitude: taken from topic 'XKQ', instance 0 of 0, 1." in observed.notes
    assert "rate: taken from topic 'IMU', instance 0 of 0, 1." in observed.notes
    left = "Topics ignored: 'AHR2' (4 rows), 'ATT' (4 rows), 'GYR' (4 rows)."
    assert left in observed.notes
    named = read(tmp_path, flight("ATT", "AHR2", "XKQ", "GYR", "IMU"), "ATT", "GYR")
    assert "attitude: taken from topic 'ATT'." in named.notes
    assert "rate: taken from topic 'GYR', instance 0 of 0, 1." in named.notes


def test_a_raw_gyros_rows_have_the_times_of_its_samples(tmp_path):
    """They were logged 0.9 ms later."""
    observed = read(tmp_path, flight("ATT", "GYR"))
    np.testing.assert_array_equal(observed.rate.t, observed.attitude.t)


@pytest.mark.parametrize("old", [False, True])
def test_an_instance_of_the_inertial_unit_is_chosen(tmp_path, old):
    content = flight("ATT", "IMU", "IMU2") if not old else flight("ATT", "IMU2")
    observed = read(tmp_path, content, instance=1)
    np.testing.assert_allclose(observed.rate.values[0], (0.2, -0.4, -0.6), atol=1e-7)


def test_an_instance_that_is_not_there_is_refused_with_those_that_are(tmp_path):
    with pytest.raises(InputError, match="'IMU': found no instance 2; wanted one of 0, 1"):
        read(tmp_path, flight("ATT", "IMU"), instance=2)


def test_zeros_for_a_quaternion_are_left_out(tmp_path):
    """As before the filter has begun."""
    rows = [logged("XKQ", us, 0, *((0,) * 4 if us == 7_000_000 else HEADING)) for us in times(5)]
    assert len(read(tmp_path, dataflash(*rows)).attitude) == 4


def test_a_log_without_motion_lists_its_messages(tmp_path):
    with pytest.raises(InputError, match=r"its topics: 'BARO' \(4 rows\).*XKQ, NKQ, AHR2, ATT"):
        read(tmp_path, flight("BARO"))


def test_a_log_is_known_by_its_first_bytes(tmp_path):
    assert_turned(read(tmp_path, flight("XKQ"), name="00000042.dat"), z=-sin(HALF))


def test_pymavlink_finds_the_same_rows(tmp_path):
    """What another library reads in the same bytes."""
    path = tmp_path / "run.bin"
    path.write_bytes(flight("ATT", "IMU", "XKQ", "AHR2", "GYR"))
    ours = messages_of(Content.of(path.read_bytes(), "log"))
    names = {each.name: number for number, each in ours.layouts.items()}
    count = 0
    with DFReader_binary(os.fspath(path), zero_time_base=True) as theirs:
        while (message := theirs.recv_msg()) is not None:
            name = message.get_type()
            if name not in ("ATT", "IMU", "XKQ", "AHR2", "GYR"):
                continue
            number = names[name]
            row = ours.rows[number].pop(0)
            columns = ours.layouts[number].columns([row])
            for key in message.get_fieldnames():
                assert columns[key][0] == pytest.approx(getattr(message, key), rel=1e-12)
            count += 1
    assert count == 4 * (1 + 2 + 2 + 1 + 2)


def test_broken_bytes_between_messages_cost_those_alone(tmp_path):
    whole = flight("XKQ", count=6)
    size = 3 + 8 + 1 + 16
    at = len(whole) - 6 * 2 * size + 2 * 2 * size  # the third row of core 0
    garbled = whole[: at + 1] + b"\0" + whole[at + 2 :]
    observed = read(tmp_path, garbled)
    np.testing.assert_allclose(observed.attitude.t, [0, 0.01, 0.03, 0.04, 0.05], atol=1e-12)
    assert "The log is damaged: it was read as far as it is whole." in observed.notes


@pytest.mark.parametrize("length", [0, 1, 2, 200])
def test_a_layout_of_an_impossible_length_is_no_layout(tmp_path, length):
    """Lengths below that of a head would keep a reader at the same place."""
    bad = layout(9, length, "EVIL", "Qf", "TimeUS,Roll") + b"\xa3\x95\x09" + bytes(30)
    rows = [logged("XKQ", us, 0, *HEADING) for us in times()]
    observed = read(tmp_path, dataflash() + bad + b"".join(rows))
    assert len(observed.attitude) >= 3 if length != 200 else observed is not None


def test_broken_bytes_end_with_the_declared_error_or_a_table(tmp_path):
    content, rng, ends = flight("XKQ", "ATT", "IMU", "GYR"), np.random.default_rng(3), []
    draws = thorough.count(300, 100)
    for k in range(draws):
        at = int(rng.integers(2, len(content)))
        garbled = content[:at] + bytes([content[at] ^ (1 << int(rng.integers(8)))])
        with contextlib.suppress(InputError):
            read(tmp_path, garbled + content[at + 1 :] if k % 2 else content[:at])
        ends.append(k)
    assert len(ends) == draws
