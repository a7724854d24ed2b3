"""`equipoise replay`: what it refuses before a page is served."""

import json
import socket

import numpy as np
import pytest

from equipoise.io.stream.gravity_datagram import unpacked
from equipoise.model.gravity_torque import TorqueStatus


def test_a_recording_needs_its_testbed(equipoise, record_file):
    reported = equipoise("replay", record_file)
    assert reported.code == 2
    assert "--testbed" in reported.err


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (("--speed", 2), "--terminal"),
        (("--terminal", "--speed", -1), "--speed"),
        (("--port", 65536), "65535"),
        (("--feed-forward", "8766"), "HOST:PORT"),
        (("--feed-forward", "localhost:0"), "HOST:PORT"),
        (("--feed-forward", "localhost:65536"), "HOST:PORT"),
        (("--feed-forward", ":8766"), "HOST:PORT"),
        (("--estimate", "there"), "--feed-forward"),
        (("--feed-forward", "127.0.0.1:8766", "--estimate", "nowhere"), "nowhere"),
    ],
)
def test_what_makes_no_sense_is_refused_by_its_option(equipoise, record_file, words, named):
    reported = equipoise("replay", record_file, "--testbed", "sputnix", *words)
    assert reported.code == 2
    assert named in reported.err


def test_a_part_that_is_empty_is_refused(equipoise, record_file):
    words = ("--from-s", 5000, "--to-s", 6000)
    reported = equipoise("replay", record_file, "--testbed", "sputnix", *words)
    assert reported.code == 2
    assert "--from-s" in reported.err


def test_a_recording_is_fed_forward_from_an_estimate(equipoise, tmp_path):
    """Datagrams in order, and the centre of mass that the identification found."""
    words = ("--duration-s", 30, "--move", "15: z=-5", "--seed", 2, "--out", "run.csv")
    assert equipoise("simulate", "nanosat", *words).code == 0
    assert equipoise("identify", "run.csv", "--testbed", "nanosat", "--out", "found").code == 0
    document = json.loads((tmp_path / "found" / "estimate.json").read_text())
    values = {each["name"]: each["value"] for each in document["parameters"]}
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as receiver:
        receiver.bind(("127.0.0.1", 0))
        receiver.settimeout(5.0)
        to = ("--feed-forward", f"127.0.0.1:{receiver.getsockname()[1]}")
        done = equipoise("replay", "run.csv", "--testbed", "nanosat", "--estimate", "found", *to,
                         "--speed", 0)  # fmt: skip
        assert done.code == 0
        sent = [unpacked(receiver.recv(4096)) for _ in range(30)]
    assert [each.sequence for each in sent] == list(range(30))
    assert {each.content.status for each in sent} == {TorqueStatus.USABLE}
    early = sent[1].content
    assert early.first_moment == pytest.approx(
        4.0 * np.array([values[f"com_{axis}"] for axis in "xyz"]), abs=4.0 * 3e-6
    )
    late = sent[-1].content
    assert late.first_moment[2] - early.first_moment[2] == pytest.approx(-0.060 * 0.005, rel=0.02)
