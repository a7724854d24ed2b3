"""Steps, expected torque and surroundings against numbers worked by hand."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.io.testbed.presets import read_preset
from equipoise.model.mass_properties import MassProperties
from equipoise.planning.sizing.environment import (
    Surroundings,
    not_stated,
    sag_of,
    surrounding_lines,
)
from equipoise.planning.sizing.expected_torque import ASSUMED, PARTLY, expected_torque
from equipoise.planning.sizing.mass_steps import mass_steps
from tests.planning.sizing.layouts import X, Z, box, testbed

TILT = np.radians(20.0)
WEIGHT = 100.0  # N, of the platform of 10 kg at 10 m/s^2
STILL = Surroundings(air=0.0)


def line_of(name, around, bed=None, tilt=TILT):
    lines = surrounding_lines(box() if bed is None else bed, around, tilt)
    return next(line for line in lines if line.name == name)


def test_a_step_of_sputnix():
    """1 mm of 15.6 g: 1.096 um of 14.24 kg, and 15.6e-3 x 9.81 x 1e-3 = 1.53e-4 N m."""
    steps = mass_steps(read_preset("sputnix"), np.radians(0.1))
    assert [step.shift for step in steps] == pytest.approx([1.0955e-6] * 6, rel=1e-4)
    assert [step.torque for step in steps] == pytest.approx([1.530e-4] * 6, rel=1e-3)
    assert [step.stop_sd for step in steps] == pytest.approx([0.333 * 1.0955e-6] * 6, rel=1e-4)
    level = [step.within_tilt for step in steps]
    assert level[0] == pytest.approx(steps[0].torque, rel=1e-5)  # near level x counts in full
    assert level[4] < 2e-3 * steps[4].torque  # and z by the sine of the tilt


def test_expected_torque_is_the_mean_over_directions_and_offsets():
    """By drawing both: a cap of 20 deg has its cosine spread evenly. 40 000 draws: within 2 %."""
    rng, spread = np.random.default_rng(1), np.array([[2.0, 0, 0], [0.5, 1, 0], [-1, 0.3, 4]])
    cosine, heading = rng.uniform(np.cos(TILT), 1, 40000), rng.uniform(0, 2 * np.pi, 40000)
    sine = np.sqrt(1 - cosine**2)
    down = -np.column_stack([sine * np.cos(heading), sine * np.sin(heading), cosine])
    r = 1e-6 * rng.normal(size=(40000, 3)) @ spread.T
    drawn = WEIGHT * np.sqrt(np.mean(np.sum(np.cross(r, down) ** 2, axis=1)))
    moment = 1e-12 * spread @ spread.T
    assert expected_torque(box(), moment, TILT) == pytest.approx(drawn, rel=0.02)


def test_expected_torque_of_two_slanted_offsets_by_hand():
    """1 um along (0.6, 0, 0.8) and 2 um along y; of n_z^2 the mean is (1 - c^3) / (3 (1 - c))."""
    c = np.cos(TILT)
    up = (1 - c**3) / (3 * (1 - c))
    side = (1 - up) / 2
    first, second = np.array([0.6, 0, 0.8]), np.array([0, 2.0, 0])
    square = (1 - 0.36 * side - 0.64 * up) + 4 * (1 - side)
    moment = 1e-12 * (np.outer(first, first) + np.outer(second, second))
    expected = WEIGHT * 1e-6 * np.sqrt(square)
    assert expected_torque(box(), moment, TILT) == pytest.approx(expected, rel=1e-4)


def test_warmth_moves_by_seven_tenths_of_a_micrometre_a_kelvin():
    """23e-6 x 0.3 m x 10 % = 0.69 um; any direction: two thirds of its square lie across n."""
    line = line_of("warmth", replace(STILL, temperature=2.0))
    assert np.sqrt(np.trace(line.moment)) == pytest.approx(2 * 0.69e-6)
    assert line.torque == pytest.approx(WEIGHT * 2 * 0.69e-6 * np.sqrt(2 / 3))
    assert line.basis == PARTLY
    reported = replace(STILL, temperature=2.0, expansion=1e-5, length=0.2, lopsided=0.2)
    assert line_of("warmth", reported).basis == "stated"


@pytest.mark.parametrize(("bending", "sag"), [(30.0, 276e-6), (50.0, 99e-6), (100.0, 24.8e-6)])
def test_sag_by_its_frequency(bending, sag):
    bed = replace(box(), gravity=9.81)
    assert sag_of(bed, replace(STILL, bending=bending)) == pytest.approx(sag, rel=5e-3)
    part = replace(STILL, bending=bending, bending_share=0.25)
    assert sag_of(bed, part) == pytest.approx(sag / 4, rel=5e-3)


def test_the_best_trim_of_a_deck_leaves_twelve_micronewton_metres():
    """25 um of the reference table: 12 uN m rms within 20 deg, as the demonstration of laws has."""
    bed = read_preset("reference-table")
    line = line_of("sag", replace(STILL, bending=bed.gravity**0.5 / (2 * np.pi * 0.005)), bed)
    assert line.torque == pytest.approx(12e-6, rel=0.03)


def test_form_error_and_air_and_earth():
    assert line_of("sphericity", replace(STILL, form_error=0.2e-6)).torque == pytest.approx(2e-5)
    denser = replace(STILL, volume=0.02, air_change=0.01, lever=0.05)  # 1.2e-5 kg m on 10 kg
    assert line_of("buoyancy", denser).torque == pytest.approx(WEIGHT * 1.2e-6 * np.sqrt(2 / 3))
    turned = line_of("Earth's rate", replace(STILL, slew=0.05)).torque
    assert turned == pytest.approx(0.5 * 0.05 * 7.292e-5)


def test_gravity_gradient_of_two_moments_by_hand():
    """3 (g / R) (J_zz - J_xx) sin cos of the tilt; its mean square over a cap, by Simpson."""
    bed = replace(box(), body=MassProperties(10.0, np.zeros(3), np.diag([0.3, 0.3, 0.5])))
    c = np.linspace(np.cos(TILT), 1.0, 20001)
    mean = np.trapezoid((1 - c**2) * c**2, c) / (1 - c[0])
    expected = 3 * 10.0 / 6.371e6 * 0.2 * np.sqrt(mean)
    assert line_of("gravity gradient", STILL, bed).torque == pytest.approx(expected, rel=1e-5)


def test_what_is_not_stated_is_named_and_counts_nothing():
    assert len(not_stated(STILL)) == 5
    assert "warmth" not in not_stated(replace(STILL, temperature=1.0))
    unstated = [line for line in surrounding_lines(box(), STILL, TILT) if line.torque > 0]
    assert [line.name for line in unstated] == ["gravity gradient"]
    assert line_of("air", Surroundings()).basis == ASSUMED
    assert line_of("air", Surroundings()).torque == 1e-6


def test_a_step_along_the_vertical_counts_by_the_sine_of_the_tilt():
    bed = testbed(*(m for m in box().masses if abs(m.axis @ Z) > 0.5 or abs(m.axis @ X) > 0.5))
    x, z = mass_steps(bed, TILT)
    c = np.linspace(np.cos(TILT), 1.0, 20001)
    sine = np.sqrt(np.trapezoid(1 - c**2, c) / (1 - c[0]))
    assert z.within_tilt == pytest.approx(z.torque * sine, rel=1e-6)
    assert x.within_tilt == pytest.approx(x.torque * np.sqrt(1 - sine**2 / 2), rel=1e-6)
