"""Charts of residuals, correlations and motions, by numbers worked out by hand."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.app.charts.of_correlation import MOST, correlations_of
from equipoise.app.charts.of_fit import attitude_panels, rate_panel
from equipoise.app.charts.of_motion import of_motion
from equipoise.app.charts.of_residuals import of_residuals
from equipoise.app.text.blocks import Table, number
from equipoise.app.text.blocks import table as text_table
from equipoise.app.text.testbed_comparison import beside_testbed
from equipoise.model.estimate import BODY, Estimate, Parameter
from equipoise.model.outcome import outcome
from equipoise.model.reasons.estimate_reasons import EstimateReason
from equipoise.model.recording import Recording, Samples
from equipoise.model.units import DEG
from equipoise.procedure.identification.fitted_motion import FittedMotion, residuals_of


def estimate_with(values, sd, covariance=None):
    """Return an estimate of the body: inertia, then centre of mass."""
    units = ["kg m2"] * 6 + ["m"] * 3
    parameters = tuple(map(Parameter, BODY, units, map(float, values), map(float, sd)))
    full = np.diag(np.square(sd)) if covariance is None else covariance
    found = outcome(EstimateReason.NOT_CONVERGED)
    return Estimate("a method", found, parameters, np.asarray(full, dtype=np.float64))


VALUES = (0.05, 0.06, 0.07, 0.0, 0.0, 0.0, 10e-6, 0.0, -100e-6)
SD = (1e-3,) * 6 + (3e-6,) * 3


def panels_by_name(charts):
    return {chart.name: chart.panels for chart in charts}


def white(n, sd, seed=1):
    return Samples(np.arange(n) / 10.0, np.random.default_rng(seed).normal(0, sd, (n, 3)))


def test_a_histogram_is_a_density_in_units_of_the_stated_noise(nanosat):
    """White noise of twice the stated sd: half as high in the middle, and of area one."""
    camera = white(20_000, 2 * nanosat.attitude.noise)
    panels = panels_by_name(of_residuals(residuals_of(nanosat, camera, None)))
    bars, line = panels["residual_histogram"][0].rows
    middle = bars.x.index(0.0)
    assert bars.columns[0][middle] == pytest.approx(0.5 * line.columns[0][middle], rel=0.1)
    assert line.columns[0][middle] == pytest.approx(1 / np.sqrt(2 * np.pi), rel=1e-4)
    width = bars.x[1] - bars.x[0]
    assert sum(bars.columns[0]) * width == pytest.approx(0.9876, abs=0.005)  # within 2.5 of its sd


def test_an_autocorrelation_shows_a_wave_and_not_white_noise(nanosat):
    n = 1000
    t = np.arange(n) / 10.0
    wave = np.repeat(np.sin(2 * np.pi * np.arange(n) / 20)[:, None], 3, axis=1)
    both = residuals_of(nanosat, Samples(t, wave), white(n, nanosat.gyro.noise))
    camera, gyro = panels_by_name(of_residuals(both))["residual_autocorrelation"]
    (rows,) = camera.rows
    assert rows.x[:3] == (1.0, 2.0, 3.0)
    assert rows.columns[0][9] == pytest.approx(-1.0, abs=0.03)  # half a period behind
    assert rows.columns[0][19] == pytest.approx(1.0, abs=0.03)
    assert gyro.band == pytest.approx(1.96 / np.sqrt(n), rel=1e-3)
    outside = np.abs(np.array(gyro.rows[0].columns)) > gyro.band
    assert 0.01 < outside.mean() < 0.12  # 5 % of white noise


def test_nothing_is_said_of_few_residuals(nanosat):
    assert list(of_residuals(residuals_of(nanosat, white(10, 1.0), None))) == []
    assert list(of_residuals((None, None))) == []


def test_rates_come_from_the_fit_and_the_corrected_gyro_each_at_its_rows():
    t = np.array([0.0, 1.0, 2.0])
    gyro = Samples(t, np.array([[1.0, 2.0, 3.0], [9.0, 9.0, 9.0], [4.0, 5.0, 6.0]]))
    model = Samples(t[[0, 2]], np.array([[0.5, 2.0, 3.5], [3.0, 5.0, 6.0]]))
    dots, lines = rate_panel(FittedMotion(None, model, gyro, None, None)).rows
    assert (dots.mark, lines.mark) == ("dots", "line")
    assert dots.columns[0] == pytest.approx([1.0 / DEG, 9.0 / DEG, 4.0 / DEG], rel=1e-5)
    assert lines.x == (0.0, 2.0)
    assert lines.columns[0] == pytest.approx([0.5 / DEG, 3.0 / DEG], rel=1e-5)


def test_an_attitude_of_the_other_sign_is_the_same_attitude():
    measured = Samples(np.arange(2.0), np.array([[1.0, 0.0, 0.0, 0.0], [0.6, 0.8, 0.0, 0.0]]))
    fitted = Samples(measured.t, -measured.values)
    _, after = attitude_panels(measured, measured.values, fitted)
    camera, model = after.rows
    assert camera.columns == model.columns


def test_correlations_keep_their_signs():
    covariance = np.diag(np.square(SD))
    covariance[0, 8] = covariance[8, 0] = -0.5 * SD[0] * SD[8]
    (heat,) = correlations_of(estimate_with(VALUES, SD, covariance))
    at = heat.names.index("inertia_P_xx"), heat.names.index("com_z")
    assert heat.values[at[0]][at[1]] == heat.values[at[1]][at[0]] == -0.5
    assert all(heat.values[k][k] == 1.0 for k in range(len(heat.names)))
    assert len(heat.names) <= MOST


def test_what_is_not_known_has_no_correlation():
    sd = (np.inf,) * 6 + SD[6:]
    (heat,) = correlations_of(estimate_with(VALUES, sd, np.diag(np.square(SD))))
    assert heat.names == ("com_x", "com_y", "com_z")
    assert correlations_of(None) == ()


def test_differences_from_the_testbed_are_in_common_sd(nanosat):
    """com_x 10 um with 3 um, testbed 2 um with 4 um: (10 - 2) / 5 sd."""
    body = replace(nanosat.body, com=np.array([2e-6, 0.0, -100e-6]))
    bed = replace(nanosat, body=body, com_sd=np.array([4e-6, 4e-6, 4e-6]))
    shown = text_table("", (number(""), number("value")), (("com_x", "10"), ("plumb_x", "1")))
    found = beside_testbed(shown, estimate_with(VALUES, SD), bed)
    assert [row.cells for row in found.rows] == [
        ("com_x", "10", "2.000", "1.6"), ("plumb_x", "1", "", "")]  # fmt: skip
    assert found.rows[0].tone == "plain"
    assert found.notes


def test_a_difference_beyond_three_sd_is_set_off(nanosat):
    bed = replace(nanosat, com_sd=np.full(3, 1e-9))
    shown = text_table("", (number(""),), (("com_x",),))
    moved = estimate_with((*VALUES[:6], 10e-6, 0.0, 0.0), SD)
    assert beside_testbed(shown, moved, bed).rows[0].tone == "caution"


def test_without_an_sd_only_the_testbeds_value_stands_there(nanosat):
    open_scale = estimate_with(VALUES, (np.inf,) * 9, np.eye(9))
    shown = text_table("", (number(""),), (("com_x",),))
    found = beside_testbed(shown, open_scale, nanosat)
    assert isinstance(found, Table)
    assert [column.heading for column in found.columns] == ["", "testbed file"]
    assert found.notes == ()


def recorded(nanosat):
    t = np.arange(5.0)
    q = np.tile([1.0, 0.0, 0.0, 0.0], (5, 1))
    moved = Samples(np.array([0.0, 4.0]), np.array([[0.0, 0.0, 0.0], [0.0, 4e-3, 0.0]]))
    return Recording(attitude=Samples(t, q), masses=moved, mass_names=nanosat.mass_names)


def test_a_replay_holds_attitude_masses_and_the_ellipsoid_of_the_estimate(nanosat):
    """Equal moments J: a ball of radius sqrt(5 J / 2 m)."""
    values = (0.05, 0.05, 0.05, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    (replay,) = of_motion(recorded(nanosat), nanosat, estimate_with(values, SD), "a")
    assert replay.t == (0.0, 1.0, 2.0, 3.0, 4.0)
    assert replay.displacements[2] == (0.0, 2e-3, 0.0)
    assert [mass.name for mass in replay.masses] == list(nanosat.mass_names)
    radius = np.sqrt(2.5 * 0.05 / nanosat.body.mass)
    assert replay.ellipsoid.semi_axes == pytest.approx([radius] * 3)
    assert replay.com_covariance[0] == pytest.approx(9e-12)
    assert "exaggerated" in replay.caption


def test_a_replay_of_an_open_scale_shows_the_motion_alone(nanosat):
    estimate = estimate_with(VALUES, SD)
    hidden = tuple(replace(p, observable=False) for p in estimate.parameters)
    (replay,) = of_motion(recorded(nanosat), nanosat, replace(estimate, parameters=hidden), "a")
    assert (replay.com, replay.com_covariance, replay.ellipsoid) == (None, (), None)
    assert "centre of mass" not in replay.caption
