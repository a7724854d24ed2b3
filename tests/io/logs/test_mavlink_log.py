"""Telemetry logs of MAVLink: attitude, rate, clocks, senders, and what is broken."""

import sys
from math import cos, sin

import numpy as np
import pytest

from equipoise.io.columns.read_options import ReadOptions
from equipoise.io.recording.recording_file import read_recording
from equipoise.model.errors import InputError
from tests.support import thorough
from tests.support.flight_logs import HALF, HEADING, START, Station, flown, tlog

ARDUPILOT, PX4 = 3, 12
OURS = [cos(HALF), 0, 0, -sin(HALF)]


def read(tmp_path, content, *topics, instance=None):
    (tmp_path / "run.tlog").write_bytes(content)
    return read_recording(tmp_path / "run.tlog", ReadOptions(topics=topics, instance=instance))


@pytest.mark.parametrize("version", [1, 2])
@pytest.mark.parametrize("kind", ["turned", "angles"])
def test_a_heading_to_the_east_turns_the_other_way_about_up(tmp_path, kind, version):
    observed = read(tmp_path, flown(kind, "highres", version=version))
    np.testing.assert_allclose(observed.attitude.t, 0.02 * np.arange(5), atol=1e-9)
    np.testing.assert_allclose(np.abs(observed.attitude.values @ OURS), 1, atol=1e-6)
    np.testing.assert_allclose(observed.rate.values, [(0.1, -0.2, -0.3)] * 5, atol=1e-7)
    assert "rate: taken from topic 'HIGHRES_IMU'." in observed.notes


def test_a_quaternion_goes_before_angles(tmp_path):
    observed = read(tmp_path, flown("angles", "turned"))
    assert "attitude: taken from topic 'ATTITUDE_QUATERNION'." in observed.notes
    named = read(tmp_path, flown("angles", "turned"), "ATTITUDE")
    assert "attitude: taken from topic 'ATTITUDE'." in named.notes


def test_the_rate_beside_the_attitude_is_taken_where_no_gyros_is_there(tmp_path):
    observed = read(tmp_path, flown("turned"))
    np.testing.assert_allclose(observed.rate.values, [(0.7, -0.8, -0.9)] * 5, atol=1e-6)


def test_scaled_rates_are_in_thousandths_and_have_instances(tmp_path):
    vehicle = Station()
    rows = [
        [vehicle.turned(k), vehicle.scaled(k), vehicle.scaled(k, "2"), vehicle.scaled(k, "3")]
        for k in range(4)
    ]
    observed = read(tmp_path, tlog(*rows), instance=2)
    np.testing.assert_allclose(observed.rate.values, [(0.1, -0.2, -0.3)] * 4, atol=1e-12)
    assert "rate: taken from topic 'SCALED_IMU', instance 2 of 0, 1, 2." in observed.notes
    with pytest.raises(InputError, match="no instance 3; wanted one of 0, 1, 2"):
        read(tmp_path, tlog(*rows), instance=3)


def test_raw_rates_have_a_unit_only_where_ardupilot_sends_them(tmp_path):
    observed = read(tmp_path, flown("raw", autopilot=ARDUPILOT))
    np.testing.assert_allclose(observed.rate.values, [(0.1, -0.2, -0.3)] * 5, atol=1e-12)
    with pytest.raises(InputError, match=r"'RAW_IMU' \(5 rows: in no known unit\)"):
        read(tmp_path, flown("raw", autopilot=PX4))


def test_sensors_of_a_kind_are_chosen_by_number_and_stale_ones_left_out(tmp_path):
    vehicle = Station()
    rows = [
        [vehicle.highres(k), vehicle.highres(k, sensor=1), vehicle.highres(k, sensor=2, bits=0)]
        for k in range(4)
    ]
    observed = read(tmp_path, tlog(*rows), instance=1)
    np.testing.assert_allclose(observed.rate.values, [(0.2, -0.4, -0.6)] * 4, atol=1e-6)
    assert "rate: taken from topic 'HIGHRES_IMU', instance 1 of 0, 1." in observed.notes


# --- Clocks ------------------------------------------------------------------------------------


def test_rows_have_the_vehicles_times_not_those_of_arrival(tmp_path):
    """All but the first arrive 50 ms late."""
    vehicle = Station()
    rows = [[vehicle.turned(k), vehicle.highres(k)] for k in range(5)]
    observed = read(tmp_path, tlog(*rows, late=0.05))
    np.testing.assert_allclose(observed.attitude.t, 0.02 * np.arange(5), atol=1e-9)
    np.testing.assert_allclose(observed.rate.t, 0.02 * np.arange(5), atol=1e-9)


def test_clocks_of_boot_and_of_1970_are_put_together(tmp_path):
    vehicle, zero = Station(), round(1e6 * START) - 4_000_000
    rows = [[vehicle.turned(k), vehicle.highres(k, zero)] for k in range(5)]
    observed = read(tmp_path, tlog(*rows))
    np.testing.assert_allclose(observed.rate.t, observed.attitude.t, atol=1e-9)


def test_a_vehicle_that_began_anew_is_timed_by_arrival(tmp_path):
    vehicle = Station()
    counts = [100, 101, 102, 0, 1]
    observed = read(tmp_path, tlog(*[[vehicle.turned(k)] for k in counts]))
    np.testing.assert_allclose(observed.attitude.t, 0.02 * np.arange(5), atol=1e-6)
    assert any("clock restarted" in note for note in observed.notes)


# --- Senders -----------------------------------------------------------------------------------


def test_rows_are_of_one_vehicle_the_first_whose_autopilot_beats(tmp_path):
    """A ground station's beat is no autopilot's; a gimbal's attitude is not the vehicle's."""
    vehicle, gimbal, station = Station(2), Station(2, 154), Station(255, 190)
    rows = [[gimbal.turned(k, (1.0, 0, 0, 0)), vehicle.turned(k)] for k in range(5)]
    rows[0] = [station.beat(8), *rows[0], vehicle.beat(PX4)]
    observed = read(tmp_path, tlog(*rows))
    np.testing.assert_allclose(np.abs(observed.attitude.values @ OURS), 1, atol=1e-6)
    assert "5 rows of other systems or components were ignored." in observed.notes


def test_a_log_without_motion_lists_its_messages(tmp_path):
    vehicle = Station()
    rows = [[vehicle.beat(PX4), vehicle.packed("sys_status", *(0,) * 13)] for _ in range(3)]
    with pytest.raises(InputError, match=r"'SYS_STATUS' \(3 rows\).*ATTITUDE_QUATERNION"):
        read(tmp_path, tlog(*rows))


def test_without_the_library_the_extra_is_named(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "pymavlink.dialects.v20.common", None)
    with pytest.raises(InputError, match=r"pymavlink is not installed.*equipoise\[mavlink\]"):
        read(tmp_path, flown("turned"))


# --- Broken ------------------------------------------------------------------------------------


def test_a_broken_message_is_left_out_and_counted(tmp_path):
    """One byte of the quaternion of the third: its checksum says so."""
    content = flown("turned")
    at = content.index(Station().turned(2)[10:42])
    garbled = content[: at + 8] + bytes([content[at + 8] ^ 1]) + content[at + 9 :]
    observed = read(tmp_path, garbled)
    np.testing.assert_allclose(observed.attitude.t, [0, 0.02, 0.06, 0.08], atol=1e-9)
    assert "The log is broken in 1 places; left out." in observed.notes


def test_broken_bytes_end_with_the_declared_error_or_a_table(tmp_path):
    content, rng, ends = flown("turned", "angles", "highres"), np.random.default_rng(4), []
    draws = thorough.count(200, 80)
    for k in range(draws):
        at = int(rng.integers(1, len(content)))
        garbled = content[:at] + bytes([content[at] ^ (1 << int(rng.integers(8)))])
        try:
            whole = garbled + content[at + 1 :] if k % 2 else content[:at]
            ends.append(read(tmp_path, whole).source)
        except InputError as error:
            ends.append(error.where)
    assert len(ends) == draws
    assert all("run.tlog" in each for each in ends)
    assert HEADING[0] == pytest.approx(OURS[0])
