"""Presets hold the numbers the papers print and mark the others."""

import math

import numpy as np
import pytest

from equipoise.io.presets import preset_names, preset_text, read_preset
from equipoise.model.errors import InputError


def test_sputnix_has_the_numbers_of_ivanov_2021_section_1() -> None:
    """Mass, CAD inertia about C, six loads of 15.6 g on +-50 mm rails, 0.2 deg at 5 Hz, no gyro."""
    testbed = read_preset("sputnix")
    cad = [[0.3309, 0.0018, 0.0373], [0.0018, 0.5253, 0.0012], [0.0373, 0.0012, 0.8120]]
    assert testbed.body.mass == 14.24
    np.testing.assert_allclose(testbed.body.inertia_C, cad, atol=1e-12)
    assert [m.name for m in testbed.masses] == ["x1", "x2", "y1", "y2", "z1", "z2"]
    assert all(m.mass == pytest.approx(0.0156) for m in testbed.masses)
    assert all(m.travel == pytest.approx((-0.05, 0.05)) for m in testbed.masses)
    assert all(3 * m.accuracy == pytest.approx(1e-3, rel=2e-3) for m in testbed.masses)
    assert all(m.axis["xyz".index(m.name[0])] == 1.0 for m in testbed.masses)
    assert testbed.attitude is not None
    assert testbed.attitude.rate == 5.0
    assert math.degrees(testbed.attitude.noise) == pytest.approx(0.2)
    assert testbed.gyro is None


def test_what_the_paper_does_not_print_is_marked_in_text_and_noun() -> None:
    """Rail positions, speed, tilt limit, gravity and the first guess are assumptions."""
    assumed = read_preset("sputnix").assumed
    for key in ("sliding_mass.home_mm", "sliding_mass.speed_mm_s", "platform.gravity_m_s2"):
        assert key in assumed
    assert "assumed:" in preset_text("sputnix")


@pytest.mark.parametrize("name", preset_names())
def test_every_preset_can_be_read_and_simulated(name: str) -> None:
    """Each has a truth for the simulator."""
    assert read_preset(name).truth is not None


def test_an_unknown_preset_names_the_nearest() -> None:
    """A misspelt name is answered with the right one."""
    with pytest.raises(InputError, match="did you mean 'sputnix'"):
        preset_text("sputniks")
