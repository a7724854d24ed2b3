"""Derivatives of a modal fit, by differences of another kind than the fit's own."""

import numpy as np
import pytest

from equipoise.estimation.events.record_model import refitted
from equipoise.estimation.modes.modal_estimate import by_unknowns, values_of
from equipoise.estimation.modes.modal_fit import modes_at, moment_of, profile_of, vector_of
from equipoise.estimation.modes.modal_response import ground_of, inertia_of, response
from equipoise.estimation.modes.profile_descent import derivative, fit_with, total
from equipoise.model.modes import FreeMode, Mode, freed, held
from tests.support.modal_records import INERTIA, modal_record, rigid_model

MODE = Mode(1.3, 0.004, np.array([0.1, 0.06, 0.02]), deflection=1e-3)


@pytest.fixture(scope="module")
def fitted():
    """The fit with the true mode, its profile and its derivative."""
    recording, testbed, _ = modal_record(2, MODE)
    model, first = rigid_model(recording, testbed), [freed(MODE, INERTIA)]
    profile, theta = profile_of(model, first), vector_of(first, first, moment_of(model))
    model = profile.at(profile.at(model, theta), theta)
    _, varied = derivative(profile, model, theta, profile.varied)
    by_theta, _ = derivative(profile, model, theta, varied)
    return profile, fit_with(profile, model, theta, by_theta), by_theta


def test_numbers_of_a_mode_vary_with_its_unknowns(fitted):
    _, fit, _ = fitted
    first, moment, h = fit.model.modes, moment_of(fit.model), 1e-6
    theta = vector_of(first, first, moment)

    def numbers(at):
        return np.array(values_of(modes_at(at, first, moment)[0]))

    slopes = [(numbers(theta + s) - numbers(theta - s)) / (2 * h) for s in h * np.eye(7)]
    assert by_unknowns(fit, first, moment) == pytest.approx(np.array(slopes).T, abs=1e-8)


@pytest.mark.parametrize("k", [0, 1, 3, 4, 5, 6])  # not ln |d|, which this record leaves open
def test_the_information_is_the_curvature_of_chi_square(fitted, k):
    """Its second difference, everything else fitted anew, is 2 (J^T J + P) h^2; h is some sd."""
    profile, fit, by_theta = fitted
    information = by_theta[:, k] @ by_theta[:, k] + profile.sd[k] ** -2.0
    h = 3.0 * information**-0.5 * np.eye(7)[k]
    ahead, behind, here = (
        total(profile, profile.at(fit.model, at), at)
        for at in (fit.theta + h, fit.theta - h, fit.theta)
    )
    assert ahead + behind - 2 * here == pytest.approx(2 * 9.0, rel=0.05)


def response_of(model, mode, **changed):
    """Return e along the nodes in the motion of a fit, and their times."""
    free = FreeMode(
        changed.get("frequency", mode.frequency),
        changed.get("damping", mode.damping),
        mode.coupling,
        changed.get("deflection", mode.deflection),
        mode.velocity,
    )
    real = held(free, inertia_of(model))
    found = response(ground_of(model, 2 * np.pi * mode.frequency), [real], model.testbed)
    return found.t, found.deflection[:, 0]


@pytest.mark.parametrize("name", ["frequency", "damping", "deflection"])
def test_the_response_varies_as_a_free_oscillation_does(name):
    """A mode that begins turned is e_0 exp(-z W t) (cos V t + z / r sin V t), V = W r.

    With r = (1 - z^2)^(1/2), its derivatives are those below; the platform about it is at rest.
    """
    recording, testbed, _ = modal_record(2, MODE)
    model = refitted(rigid_model(recording, testbed))
    mode = FreeMode(2.0, 0.01, np.array([1e-3, 0.0, 0.0]), 1e-3)
    h = {"frequency": 1e-4, "damping": 1e-4, "deflection": 1e-6}[name]
    value = getattr(mode, name)
    t, ahead = response_of(model, mode, **{name: value + h})
    _, behind = response_of(model, mode, **{name: value - h})
    found, t = (ahead - behind) / (2 * h), t - t[0]
    W, z, e_0 = 2 * np.pi * 2.0, 0.01, 1e-3
    r = (1 - z * z) ** 0.5
    fading, sine, cosine = np.exp(-z * W * t), np.sin(W * r * t), np.cos(W * r * t)
    by_hand = {
        "frequency": -2 * np.pi * t * e_0 * fading * sine / r,
        "damping": e_0 * fading * (sine / r - W * t * cosine) / r**2,
        "deflection": fading * (cosine + z / r * sine),
    }[name]
    assert found == pytest.approx(by_hand, abs=5e-3 * np.abs(by_hand).max())
