"""[hardware] of a testbed file: units, what cannot be, and the way back."""

import math

import numpy as np
import pytest

from equipoise.io.testbed.presets import preset_text, read_preset
from equipoise.io.testbed.testbed_file import parse_testbed, text_of_testbed
from equipoise.model.errors import InputError

TEXT = preset_text("nanosat")


def test_units_become_si():
    """800 steps per mm are 800 000 per m; zero at -17 mm; 60 deg/s; 1 mm."""
    hardware = read_preset("nanosat").hardware
    (board,) = hardware.boards
    assert [axis.steps_per_m for axis in board.axes] == [8e5] * 3
    assert [axis.zero for axis in board.axes] == pytest.approx([-0.017] * 3)
    assert [axis.mass for axis in board.axes] == ["x", "y", "z"]
    assert hardware.limits.rate == pytest.approx(math.pi / 3)
    assert hardware.limits.stale == 0.5
    assert hardware.limits.mismatch == pytest.approx(1e-3)


def test_a_sensor_mounted_upside_down_is_a_rotation():
    (unit,) = read_preset("nanosat").hardware.sensors
    np.testing.assert_array_equal(unit.alignment, np.diag([1.0, -1.0, -1.0]))
    assert unit.gives == ("attitude", "rate")


def test_it_is_written_as_it_was_read():
    first = read_preset("nanosat")
    again = parse_testbed(text_of_testbed(first), "again").hardware
    assert again.boards == first.hardware.boards
    assert again.limits == first.hardware.limits
    for a, b in zip(again.sensors, first.hardware.sensors, strict=True):
        np.testing.assert_allclose(a.alignment, b.alignment, atol=1e-15)
        assert (a.name, a.driver, a.port, a.gives, a.laboratory, a.settings) == (
            b.name, b.driver, b.port, b.gives, b.laboratory, b.settings
        )  # fmt: skip


def test_settings_of_a_driver_come_back():
    table = '\n[hardware.sensor.settings]\ncolumns = ["time_ms", "q_w"]\nrate_hz = 50.0\n'
    text = TEXT.replace("\n# assumed: everything below", table + "\n# assumed: everything below")
    first = parse_testbed(text, "t").hardware.sensors[0].settings
    assert first == {"columns": ("time_ms", "q_w"), "rate_hz": 50.0}
    bed = parse_testbed(text, "t")
    assert parse_testbed(text_of_testbed(bed), "t").hardware.sensors[0].settings == first


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ('{ mass = "y", letter = "Y"', '{ mass = "w", letter = "Y"', "mass 'w'"),
        ('{ mass = "y", letter = "Y"', '{ mass = "x", letter = "Y"', "mass 'x' twice"),
        ('{ mass = "y", letter = "Y"', '{ mass = "y", letter = "X"', "each letter once"),
        (
            '{ mass = "y", letter = "Y"',
            '{ mass = "y", letter = "Q"',
            "letter.*the board's name of the axis",
        ),
        ('"serial:/dev/ttyUSB1"', '"serial:/dev/ttyUSB0"', "two devices at"),
        ('"serial:/dev/ttyUSB1"', '"/dev/ttyUSB1"', r"port.*serial:COM3"),
        ('name = "imu"', 'name = "masses"', "two devices 'masses'"),
        ("[0.0, 0.0, -1.0]]", "[0.0, 0.0, 1.0]]", "right-handed"),
        ("[0.0, 0.0, -1.0]]", "[0.0, 0.1, -1.0]]", "a rotation"),
        ("rate_limit_deg_s = 60.0", "rate_limit_deg = 60.0", "rate_limit_deg"),
    ],
)
def test_what_cannot_be_is_named(old, new, said):
    assert old in TEXT
    with pytest.raises(InputError, match=said):
        parse_testbed(TEXT.replace(old, new), "my.toml")


def test_a_testbed_without_hardware_has_none():
    assert read_preset("unb").hardware is None
