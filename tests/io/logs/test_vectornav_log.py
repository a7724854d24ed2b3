"""A terminal's log of a VectorNav: kinds of messages, clocks in front of them, checksums."""

from math import cos, sin

import numpy as np
import pytest

from equipoise.io.columns.read_options import ReadOptions
from equipoise.io.recording.recording_file import read_recording
from equipoise.model.errors import InputError
from tests.support.flight_logs import HALF, VECTORNAV_LINES, said, terminal

OURS = [cos(HALF), 0, 0, -sin(HALF)]
ARDUINO, BRACKETS = "14:03:21.{:03d} -> ", "[14:03:21.{:03d}] "
DATED = "2026-11-28 14:03:21,{:03d}: "


def read(tmp_path, text, *topics, name="putty.log"):
    (tmp_path / name).write_bytes(text.encode() if isinstance(text, str) else text)
    return read_recording(tmp_path / name, ReadOptions(topics=topics))


@pytest.mark.parametrize("clock", [ARDUINO, BRACKETS, DATED])
@pytest.mark.parametrize("kind", ["VNQMR", "VNYMR", "VNQTN", "VNYPR"])
def test_a_heading_to_the_east_turns_the_other_way_about_up(tmp_path, kind, clock):
    """+30 deg about down, from north to east; six decimals, or three of a degree."""
    observed = read(tmp_path, terminal(kind, clock=clock))
    np.testing.assert_allclose(observed.attitude.t, 0.02 * np.arange(5), atol=1e-9)
    np.testing.assert_allclose(np.abs(observed.attitude.values @ OURS), 1, atol=1e-9)
    assert (observed.rate is not None) == (kind in ("VNQMR", "VNYMR"))
    assert any("taken from topic" in note for note in observed.notes)


@pytest.mark.parametrize("kind", ["VNQMR", "VNYMR", "VNGYR"])
def test_rates_are_those_of_ahead_left_and_up(tmp_path, kind):
    observed = read(tmp_path, terminal(kind))
    np.testing.assert_allclose(observed.rate.values, [(0.1, -0.2, -0.3)] * 5, atol=1e-12)


@pytest.mark.parametrize(
    ("body", "ours"),
    [
        (f"VNQTN,{sin(HALF):.6f},0,0,{cos(HALF):.6f}", (sin(HALF), 0, 0)),  # right side down
        (f"VNQTN,0,{sin(HALF):.6f},0,{cos(HALF):.6f}", (0, -sin(HALF), 0)),  # nose up
        ("VNYPR,0,30,0", (0, -sin(HALF), 0)),
        ("VNYPR,0,0,30", (sin(HALF), 0, 0)),
    ],
)
def test_roll_stays_and_pitch_changes_its_sign(tmp_path, body, ours):
    text = "\n".join(ARDUINO.format(20 * k) + said(body) for k in range(4)) + "\n"
    q = read(tmp_path, text).attitude.values
    np.testing.assert_allclose(np.abs(q @ [cos(HALF), *ours]), 1, atol=1e-9)


def test_attitude_and_rate_come_from_two_messages(tmp_path):
    observed = read(tmp_path, terminal("VNYPR", "VNGYR"))
    assert (len(observed.attitude), len(observed.rate)) == (5, 5)
    assert "attitude: taken from topic 'VNYPR'." in observed.notes
    assert "rate: taken from topic 'VNGYR'." in observed.notes


def test_a_message_is_chosen_by_its_name(tmp_path):
    observed = read(tmp_path, terminal("VNQMR", "VNYPR"), "VNYPR")
    assert "attitude: taken from topic 'VNYPR'." in observed.notes
    with pytest.raises(InputError, match="did you mean 'VNYPR'"):
        read(tmp_path, terminal("VNQMR", "VNYPR"), "VNYPX")


def test_the_checksum_of_sixteen_bits_is_known(tmp_path):
    line = said(VECTORNAV_LINES["VNQTN"], wide=True)
    text = "".join(f"{ARDUINO.format(20 * k)}{line}\n" for k in range(4))
    assert len(read(tmp_path, text).attitude) == 4


# --- Clocks ------------------------------------------------------------------------------------


def test_without_a_clock_the_rate_has_to_be_stated_and_the_command_is_named(tmp_path):
    with pytest.raises(InputError, match=r"without a clock.*--as vectornav --rate-hz HZ"):
        read(tmp_path, terminal("VNQMR", clock=""))


def test_midnight_is_no_step_back(tmp_path):
    clocks = ["23:59:59.980", "23:59:59.990", "00:00:00.000", "00:00:00.010"]
    text = "".join(f"{clock} -> {said(VECTORNAV_LINES['VNQMR'])}\n" for clock in clocks)
    np.testing.assert_allclose(read(tmp_path, text).rate.t, [0, 0.01, 0.02, 0.03], atol=1e-9)


def test_a_clock_that_was_set_back_costs_the_lines_until_it_is_there_again(tmp_path):
    clocks = ["14:00:00.0", "14:00:00.1", "14:00:00.0", "14:00:00.2", "14:00:00.3"]
    text = "".join(f"{clock} -> {said(VECTORNAV_LINES['VNQMR'])}\n" for clock in clocks)
    observed = read(tmp_path, text)
    np.testing.assert_allclose(observed.rate.t, [0, 0.1, 0.2, 0.3], atol=1e-9)
    assert "1 lines had a time before the last one's; left out." in observed.notes


def test_times_that_mostly_go_back_are_refused(tmp_path):
    text = "".join(f"14:00:{50 - k}.0 -> {said(VECTORNAV_LINES['VNQMR'])}\n" for k in range(9))
    with pytest.raises(InputError, match="8 of 9 lines with a time before the last one's"):
        read(tmp_path, text)


# --- Broken ------------------------------------------------------------------------------------


def test_lines_with_a_wrong_checksum_are_left_out_and_counted(tmp_path):
    lines = terminal("VNQMR", count=8).splitlines()
    lines[3] = lines[3].replace("0.1,0.2", "0.7,0.2")
    lines[5] = lines[5][:40]
    observed = read(tmp_path, "\n".join(lines))
    assert len(observed.rate) == 6
    assert "2 lines were broken, by their checksum or their numbers; left out." in observed.notes


def test_other_messages_and_text_are_passed_over(tmp_path):
    """Register answers, prompts, and a message whose numbers are too few."""
    text = "$VNRRG,01,VN-100*5A\r\nhello\r\n" + terminal("VNQMR") + ARDUINO.format(200)
    observed = read(tmp_path, text + said("VNQTN,1,2") + "\r\n")
    assert len(observed.rate) == 5
    assert "1 lines were broken, by their checksum or their numbers; left out." in observed.notes


def test_a_log_of_other_messages_alone_is_refused(tmp_path):
    with pytest.raises(InputError, match=r"no row of attitude or rate.*VNQMR, VNQTN"):
        read(tmp_path, "14:00:00.0 -> " + said("VNMAG,1,2,3") + "\n")


def test_broken_bytes_end_with_the_declared_error_or_a_table(tmp_path):
    content, rng = terminal("VNQMR", "VNYPR").encode(), np.random.default_rng(6)
    ends = []
    for k in range(200):
        at = int(rng.integers(60, len(content)))
        garbled = content[:at] + bytes([content[at] ^ (1 << int(rng.integers(8)))])
        try:
            whole = garbled + content[at + 1 :] if k % 2 else content[:at]
            ends.append(read(tmp_path, whole).source)
        except InputError as error:
            ends.append(error.where)
    assert len(ends) == 200
    assert all("putty.log" in each for each in ends)
