"""How late masses follow a command: what counts as one, and where a lag acts."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.actuators.lags import command_columns, is_command, slowness
from equipoise.actuators.mass_errors import mass_errors
from equipoise.actuators.stops import is_travelling
from equipoise.model.recording import Samples
from tests.support.builders import sliding_masses

LAG, SAG = 0.1, 2e-3  # s, m
X, Y, Z = (replace(mass, lag_sd=LAG, sag_sd=SAG) for mass in sliding_masses())
T = np.array([0.0, 10, 11, 20])
ONCE, HOME = [0, 0, 10, 10], [0, 0, 0, 0]


def track(*columns, t=T) -> Samples:
    """Millimetres at 0, 10, 11, 20 s: 10 mm at 10 mm/s."""
    return Samples(np.array(t), np.array(columns).T * 1e-3)


def smooth(t, start, duration):
    """From 0 to 1 without speed or acceleration at the ends."""
    s = np.clip((t - start) / duration, 0, 1)
    return 10 * s**3 - 15 * s**4 + 6 * s**5


def test_the_sensitivity_to_a_lag_is_minus_the_speed_by_hand():
    """10 mm/s from 10 to 11 s, over 0.2 s: half of it at the corners, all of it 0.1 s inside."""
    found = mass_errors(track(ONCE), (X,))
    assert found.names == ("mass_lag_1",)
    assert found.sd.tolist() == [LAG]
    assert found.owner.tolist() == [[0, 0]]
    assert found.response is not None
    at = [0, 9.9, 10, 10.1, 10.9, 11, 11.1, 20]
    wanted = [0, 0, -0.005, -0.01, -0.01, -0.005, 0, 0]
    assert np.interp(at, found.response.t, found.response.values[:, 0]) == pytest.approx(
        wanted, abs=1e-15
    )


def test_masses_of_one_kind_share_a_lag_and_others_do_not():
    """x and z lag by one unknown, y by its own; what is sought is listed by rising sd."""
    slow = replace(Y, lag_sd=2 * LAG)
    found = mass_errors(track(ONCE, ONCE, ONCE), (X, slow, Z))
    assert found.names == ("mass_lag_1", "mass_lag_2")
    assert found.sd.tolist() == [LAG, 2 * LAG]
    assert found.owner.tolist() == [[0, 0], [2, 0], [1, 1]]


def test_lags_come_after_the_stops():
    """Each unknown has its name, sd and owners at the same place."""
    found = mass_errors(track(ONCE, ONCE), (replace(X, accuracy=1e-3), Y))
    assert found.names == ("error_x_1", "mass_lag_1")
    assert found.sd.tolist() == [1e-3, LAG]
    assert found.owner.tolist() == [[0, 0], [0, 1], [1, 1]]


@pytest.mark.parametrize("shift", [-0.05, 0.02, 0.1])
def test_a_shifted_ramp_is_the_ramp_and_its_lag(shift):
    """d(t - tau) = d(t) + response tau, to second order: d'' is 23 mm/s^2, s and tau 0.1 s at most.

    tau^2 d''/2 = 0.12 mm, and of the box of 0.1 s tau s^2 d'''/6 = 0.03 mm of 1 mm.
    """
    t = np.arange(0, 12, 0.02)
    d = 0.016 * smooth(t, 5, 2)
    late = 0.016 * smooth(t - shift, 5, 2)
    response = slowness(t, Samples(t, d[:, None]), 0, LAG)
    assert np.abs(late - d).max() > 0.6 * 0.015 * abs(shift)
    assert d + response * shift == pytest.approx(late, abs=1.5e-4)


def test_a_lag_moves_the_whole_way():
    """The response over time is minus the way: 10 mm, slow ends of the ramp included."""
    t = np.arange(0, 12, 0.02)
    d = 0.010 * smooth(t, 2, 9)
    response = slowness(t, Samples(t, d[:, None]), 0, LAG)
    assert np.trapezoid(response, t) == pytest.approx(-0.010, rel=1e-6)


def test_a_column_that_creeps_at_rest_is_a_measurement():
    """The same ramp as commanded; as read, with noise at rest; and as a coarse encoder reads it."""
    t = np.arange(0, 20, 0.02)
    d = 0.010 * smooth(t, 5, 2)
    read = d + 1e-6 * np.random.default_rng(0).normal(size=len(t))
    for column, wanted in ((d, True), (read, False), (np.round(d, 4), True)):
        assert is_command(column, is_travelling(t, column, X.speed)) == wanted


def test_measured_and_standing_masses_have_no_lag():
    """x is measured, y never travels, z is a command."""
    t = np.arange(0, 20, 0.02)
    d = 0.010 * smooth(t, 5, 2)
    read = d + 1e-6 * np.random.default_rng(0).normal(size=len(t))
    record = Samples(t, np.column_stack([read, 0 * d, d]))
    assert command_columns(record, (X, Y, Z)) == ([1], [2], [])
    found = mass_errors(record, (X, Y, Z))
    lags = [j for j, name in enumerate(found.names) if name.startswith("mass_lag")]
    assert [pair for pair in found.owner.tolist() if pair[1] in lags] == [[2, 0]]
    assert found.sag.tolist() == [0, SAG, SAG]


NO_ROW = Samples(np.zeros(0), np.zeros((0, 1)))


@pytest.mark.parametrize(("record", "sag"), [(None, 0.0), (track(HOME), SAG), (NO_ROW, 0.0)])
def test_a_record_without_mass_travel_yields_no_lag(record, sag):
    """No record, no travel, no row: no lag; a mass at home hangs on its drive all the same."""
    found = mass_errors(record, (X,))
    assert found.names == ()
    assert found.response is None
    assert found.sag.sum() == sag


def test_a_log_in_steps_hides_a_sag_within_its_accuracy():
    """Measured in steps of 2 mm: 0.6 mm of whatever is hidden; one that is fine hides nothing."""
    rounded = replace(X, resolution=2e-3, accuracy=0.6e-3, lag_sd=0.0, sag_sd=0.0)
    assert mass_errors(track(HOME), (rounded,)).sag.tolist() == [0.6e-3]
    fine = replace(rounded, accuracy=1e-5)
    assert mass_errors(track(HOME), (fine,)).sag.tolist() == [0.0]


def test_what_gives_way_where_nothing_travels_is_late_nobody_knows_by_how_much():
    """Measured, 0.1 mm to and fro, slower than a travel; of one that travels, times are open."""
    t = np.arange(0, 20, 0.02)
    sways = 1e-4 * np.sin(t)
    record = Samples(t, np.column_stack([sways, 0 * t, sways]))
    assert command_columns(record, (X, Y, Z)) == ([1], [], [0, 2])
    found = mass_errors(record, (X, Y, Z))
    assert [name for name in found.names if name.startswith("mass_lag")] == ["mass_lag_1"]
    assert found.sag.tolist() == [0.0, SAG, 0.0]
    travels = Samples(t, np.column_stack([sways, 0 * t, 0.010 * smooth(t, 5, 2)]))
    assert command_columns(travels, (X, Y, Z)) == ([1], [2], [])


def test_at_once_and_stiff():
    """Zero is trusted."""
    found = mass_errors(track(ONCE), (replace(X, lag_sd=0.0, sag_sd=0.0),))
    assert found.names == ()
    assert found.sag.tolist() == [0]


def test_a_kind_keeps_its_name_when_the_other_stands():
    """Only y travels: its lag is still the second."""
    found = mass_errors(track(HOME, ONCE), (X, replace(Y, lag_sd=2 * LAG)))
    assert found.names == ("mass_lag_2",)
    assert found.owner.tolist() == [[1, 0]]
