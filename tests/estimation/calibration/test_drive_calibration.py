"""What a fit says of drives, by hand: numbers a person wants, and which masses are alike."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.estimation.calibration.calibration import guess
from equipoise.estimation.calibration.drive_calibration import (
    Drive,
    groups,
    of_drive,
    scatter_of,
    together,
)
from equipoise.io.testbed.presets import read_preset
from equipoise.model.estimate import Estimate, Parameter
from equipoise.model.testbed import DriveDoubt
from tests.support.outcomes import of_use

X1 = replace(
    read_preset("sputnix").mass_named("x1"),
    mass=0.5, gain=2.0, accuracy=1e-4, doubt=DriveDoubt(0.1, 0.1, 1e-3),
)  # fmt: skip


def drive(*columns):
    return Drive(X1, X1.axis, np.array(columns), True)


def test_the_numbers_of_a_drive():
    """k = (1 + 1) x + 1.5 y = 2.5 (0.8, 0.6, 0): gain 2 x 2.5, first moment 0.5 kg x 5, 36.87 deg
    towards y, and 1 mm of lost motion is 0.4 mm of command.
    """
    gain, product, *axis, first, second, backlash = of_drive(
        drive(0, 1, 2, 3), np.array([1.0, 1.5, 0.0, 1e-3])
    )
    assert (gain, product) == (pytest.approx(5.0), pytest.approx(2.5))
    np.testing.assert_allclose(axis, [0.8, 0.6, 0.0], atol=1e-15)
    assert np.degrees(first) == pytest.approx(36.8699, abs=1e-4)
    assert second == pytest.approx(0.0)
    assert backlash == pytest.approx(0.4e-3)


def test_a_trusted_drive_keeps_its_gain():
    """Without a gain sought: k = x + 0.75 z, of length 1.25, and the rail leans up."""
    gain, product, *axis, _, second, backlash = of_drive(drive(-1, 0, 1, -1), np.array([0.0, 0.75]))
    assert (gain, product, backlash) == (2.0, 1.0, 0.0)
    np.testing.assert_allclose(axis, [0.8, 0.0, 0.6], atol=1e-15)
    assert np.degrees(second) == pytest.approx(36.8699, abs=1e-4)


def test_the_next_fit_is_about_the_rail_and_the_play_that_were_found():
    """As above; a negative play, which noise may give, cannot be crossed."""
    found = guess(drive(0, 1, 2, 3), np.array([1.0, 1.5, 0.0, 1e-3]))
    np.testing.assert_allclose(found.axis, [0.8, 0.6, 0.0], atol=1e-15)
    assert found.backlash == pytest.approx(0.4e-3)
    assert (found.mass, found.gain) == (X1.mass, X1.gain)
    assert guess(drive(0, 1, 2, 3), np.array([1.0, 1.5, 0.0, -1e-3])).backlash == 0.0


def stops(*pairs):
    """Return an estimate with errors of stops of two masses, value and sd in mm."""
    found = [Parameter(f"error_x1_{k + 1}", "m", 1e-3 * v, 1e-3 * s)
             for k, (v, s) in enumerate(pairs)]  # fmt: skip
    other = Parameter("error_x10_1", "m", 1.0, 1e-9)
    return Estimate("fit", of_use(), (*found, other), np.eye(len(found) + 1))


def test_a_scatter_is_of_what_the_record_freed():
    """Each of two stops is known to half its prior's sd: 2 x 3/4 of freedom. 0.3 mm along k of
    length 2 are sqrt(0.09 / 1.5) / 2 = 0.12247 mm, to 1 in sqrt(3).
    """
    found = scatter_of(drive(0, 1, 2, 3), stops((0.3, 0.05), (0.0, 0.05)), 2.0)
    assert 1e3 * found.value == pytest.approx(0.122474, abs=1e-6)
    assert 1e3 * found.sd == pytest.approx(0.122474 / np.sqrt(3.0), abs=1e-6)


def test_a_small_scatter_is_no_surer_than_the_one_stated():
    found = scatter_of(drive(0, 1, 2, 3), stops((0.0, 0.05), (0.0, 0.05)), 1.0)
    assert 1e3 * found.sd == pytest.approx(0.1 / np.sqrt(3.0))


def test_a_single_stop_does_not_determine_a_scatter():
    found = scatter_of(drive(0, 1, 2, 3), stops((0.3, 0.05)), 1.0)
    assert not found.observable
    assert np.isinf(found.sd)


def test_masses_that_open_directions_run_along_are_one_group():
    """The first and the third always against each other: their difference is as it was before."""
    P = 0.5 * np.array([[1.0, 0.0, -1.0], [0.0, 0.02, 0.0], [-1.0, 0.0, 1.0]])
    assert groups(P, np.array([0, 1, 2])) == [(0, 2)]
    assert groups(0.5 * P, np.array([0, 1, 2])) == []


def test_a_common_scale_alone_mixes_no_gains():
    """All gains alike is what nothing shows; their difference is known."""
    pair = (drive(0, -1, -1, -1), drive(1, -1, -1, -1))
    prior = X1.doubt.gain**2
    alike = prior * np.ones((2, 2))
    opposed = prior * np.array([[0.5, -0.5], [-0.5, 0.5]])
    assert together(pair, alike) == {"gains": []}
    assert together(pair, opposed) == {"gains": [(0, 1)]}
