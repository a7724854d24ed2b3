"""How much an interval is widened for what a model leaves, by hand."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.dynamics.propagation import body_of
from equipoise.estimation.output_error.fit_estimate import conclude, widening
from equipoise.estimation.output_error.trajectory import Params, fit
from equipoise.maths.linalg import unpack_symmetric
from equipoise.model.estimate import COM as COM_NAMES
from equipoise.model.estimate import INERTIA as INERTIA_NAMES
from equipoise.model.estimate import Residual
from equipoise.model.mass_properties import MassProperties
from equipoise.model.recording import Recording, Samples
from tests.support.builders import (
    COM,
    GRAVITY,
    INERTIA,
    MASS,
    level,
    line_of,
    move_at,
    noisy,
    platform,
    travel,
)


def left(chi_square, peak, degrees_of_freedom=1000):
    """What a model leaves: its chi-square, and the peak of its spectral density over its mean."""
    return Residual(0.003, None, chi_square, degrees_of_freedom, 0.0, 1.0, spectral_peak=peak)


def test_noise_as_stated_and_white_widens_nothing():
    assert widening(left(1000.0, 1.0)) == 1.0


def test_colour_widens_by_the_root_of_its_peak():
    assert widening(left(1000.0, 6.25)) == pytest.approx(2.5)


def test_a_residual_larger_than_stated_widens_by_its_root():
    """Beyond four sd of its own chance, 4 sqrt(2 / 1000) = 0.18; a smaller excess is chance."""
    assert widening(left(1440.0, 1.0)) == pytest.approx(1.2)
    assert widening(left(1150.0, 1.0)) == 1.0


def test_both_together_multiply():
    assert widening(left(1440.0, 6.25)) == pytest.approx(3.0)


def test_what_is_held_at_zero_hides_nothing():
    """No products in truth, all three held so: moments and com are observable, to 5 %."""
    principal = INERTIA * [1, 1, 1, 0, 0, 0]
    t, track = np.arange(601) / 5.0, move_at(60.0, 120.0)
    line = line_of(t, track)
    q = travel(line, body_of(MASS, GRAVITY, principal, MASS * COM)).q[line.attitude_node]
    record = noisy(Recording(Samples(t, q), None, ("x", "y", "z"), track), 1)
    body = MassProperties(MASS, COM, unpack_symmetric(principal))
    testbed = replace(level(platform()), body=body)
    found = conclude(fit(record, testbed, Params(hold=INERTIA_NAMES[3:])), "fit", record)
    assert found.unobservable == ()
    assert found.sees((*INERTIA_NAMES, *COM_NAMES))
    sd = np.sqrt(np.diag(found.covariance_of(INERTIA_NAMES)))
    assert np.all(sd[:3] < 0.05 * INERTIA[:3])
    assert np.all(sd[3:] < 1e-9)
