"""`equipoise replay`: what it refuses before a page is served."""

import pytest


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
