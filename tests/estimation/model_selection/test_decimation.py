"""Dense records as means of their rows."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.actuators.lags import logged_late
from equipoise.estimation.model_selection import initial_model, reference_fit
from equipoise.estimation.model_selection.decimation import (
    DENSE,
    averaged,
    condensed,
    first_rows,
    mean_attitudes,
    mean_rows,
    most_rows,
    swept,
    turned,
    with_few_bends,
)
from equipoise.estimation.model_selection.dense_record import (
    first_gap,
    moved,
    with_all_rows,
    with_noise_of,
)
from equipoise.estimation.model_selection.survey import survey
from equipoise.estimation.output_error.problem import quickest_swing
from equipoise.estimation.output_error.solution import settle
from equipoise.estimation.output_error.trajectory import Params, fit, problem_of
from equipoise.maths.attitude import difference, exponential
from equipoise.model.estimate import BODY
from equipoise.model.recording import Recording, Samples
from equipoise.sensors.timing import measured_at, spread_of
from tests.support.builders import COM, INERTIA, move_at, noisy, platform, recording
from tests.support.outcomes import codes_of

LATE = replace(platform().attitude, rate=100.0, delay=0.3, averaging=0.2)
FAST = replace(platform(3e-4), attitude=replace(platform().attitude, rate=100.0))
DURATION = 220.0  # s, 22001 rows


def dense():
    return recording(DURATION, move_at(60.0, DURATION), camera=100.0)


def spinning(speed, rows=400):
    """A turn about one axis at ``speed`` (rad/s), a row every 10 ms."""
    t = 0.01 * np.arange(rows)
    axis = np.array([0.6, 0.0, 0.8])
    return Samples(t, exponential(speed * t[:, None] * axis)), axis


def rows_at(t):
    """A gyro at rest."""
    return Samples(t, np.zeros((len(t), 3)))


def test_means_of_rows_by_hand():
    channel = Samples(np.arange(9.0), np.arange(1.0, 10.0)[:, None] * [1.0, -2.0, 0.0])
    means = mean_rows(channel, 4)  # of 1 2 3 4 and 5 6 7 8; 9 is left over
    np.testing.assert_array_equal(means.t, [1.5, 5.5])
    np.testing.assert_array_equal(means.values, [[2.5, -5.0, 0.0], [6.5, -13.0, 0.0]])


def test_the_mean_of_an_even_turn_is_the_attitude_at_its_mean_time():
    """Rows 0 to 3 at 0.1 rad/s: 0.0015 rad at 0.015 s; the next four 0.0055 rad at 0.055 s."""
    attitude, axis = spinning(0.1)
    means = mean_attitudes(attitude, 4)
    np.testing.assert_allclose(means.t[:2], [0.015, 0.055])
    expected = exponential(np.array([[0.0015], [0.0055]]) * axis)
    np.testing.assert_allclose(means.values[:2], expected, atol=1e-15)


def test_signs_of_quaternions_do_not_matter():
    attitude, _ = spinning(0.1)
    signs = np.where(np.arange(400) % 3 == 1, -1.0, 1.0)
    flipped = Samples(attitude.t, attitude.values * signs[:, None])
    off = difference(mean_attitudes(flipped, 4).values, mean_attitudes(attitude, 4).values)
    np.testing.assert_allclose(off, 0.0, atol=1e-15)


def test_means_do_not_reach_over_gaps():
    """Nothing between 4 and 10 s: the row at 4 s has no partner."""
    observed = rows_at(np.array([0.0, 1, 2, 3, 4, 10, 11, 12, 13, 14, 15]))
    np.testing.assert_array_equal(first_rows(observed, 2), [0, 2, 5, 7, 9])


def test_a_missing_row_is_no_gap_in_a_long_mean():
    """Sixteen rows over 16 s instead of 15; of four rows over 4 s instead of 3 it would be one."""
    t = np.delete(np.arange(40.0), 8)
    np.testing.assert_array_equal(first_rows(rows_at(t), 16), [0, 16])
    np.testing.assert_array_equal(first_rows(rows_at(t), 4)[:3], [0, 4, 8])
    np.testing.assert_array_equal(first_rows(rows_at(np.delete(t, 9)), 4)[:3], [0, 4, 9])


def test_a_mean_stands_for_the_moments_of_its_rows():
    """Middle and variance of four rows that are themselves late means, each of 0.2 s."""
    t = 0.01 * np.arange(4.0)
    mean = averaged(LATE, 4, 0.01)
    middles = measured_at(t, LATE)
    assert measured_at(np.array([t.mean()]), mean)[0] == pytest.approx(middles.mean(), abs=1e-12)
    assert spread_of(mean) == pytest.approx(0.2**2 / 12 + middles.var(), rel=1e-12)
    assert mean.noise == pytest.approx(LATE.noise / 2)
    assert mean.rate == 25.0


def left_of(record, testbed):
    """The rms (rad) that a fit of a record without noise leaves."""
    params = Params(hold=("inertia_P_zz",))
    at = fit(record, testbed, params).at
    return float(np.sqrt(np.mean(at.left_q**2))) * testbed.attitude.noise


def test_long_means_are_predicted_as_means():
    """Of 2.56 s in swings of 40 s: what is left falls from W^2 T^2 / 24 to W^4 T^4 / 1920."""
    k, record = 256, recording(120.0, camera=100.0)
    few = replace(record, attitude=mean_attitudes(record.attitude, k))
    reported = replace(platform(), attitude=averaged(FAST.attitude, k, 0.01))
    middle = reported.attitude.delay + 0.5 * reported.attitude.averaging
    moments = replace(reported, attitude=replace(reported.attitude, averaging=0.0, delay=middle))
    assert left_of(few, reported) < 1e-6
    assert left_of(few, moments) > 20 * left_of(few, reported)


@pytest.mark.parametrize(("speed", "k"), [(5.0, 4), (1.0, 16), (0.5, 32), (20.0, 1)])
def test_the_platform_turns_little_within_a_mean(speed, k):
    """At most 0.3 rad, by powers of two: 5 rad/s turn it by 0.2 rad in four rows, 0.4 in eight."""
    attitude, axis = spinning(speed)
    rate = Samples(attitude.t, np.tile(speed * axis, (400, 1)))
    assert most_rows(attitude, 10.0, turned) == k
    assert most_rows(rate, 10.0, swept) == k


def test_records_that_are_not_dense_stay_as_they_are():
    record = dense()
    few = Recording(Samples(record.attitude.t[: DENSE - 1], record.attitude.values[: DENSE - 1]))
    assert condensed(few, FAST) is None
    attitude = record.attitude
    every = Samples(50 * attitude.t, attitude.values)  # 2 Hz
    assert condensed(replace(record, attitude=every, masses=None), FAST) is None


def test_a_dense_record_has_means_of_four():
    """Cuts 0.11 s apart, two rows between them: 0.055 s hold four rows of 10 ms, not eight."""
    few = condensed(dense(), FAST)
    assert (few.attitude_rows, few.rate_rows) == (4, 1)
    assert len(few.recording.attitude) == 5500
    assert few.testbed.attitude.noise == pytest.approx(FAST.attitude.noise / 2)


def test_displacements_in_few_lines_are_off_by_little():
    """A sag of 0.1 mm with the swing: what is left of it leans the platform by less than 1 % of a
    mean's noise, here d < 0.01 x 1.7e-3 rad x 0.35 kg m2 x (0.5 rad/s)^2 / 0.153 N = 1e-5 m."""
    t = np.arange(0.0, DURATION, 0.02)
    sag = 1e-4 * np.sin(0.2 * t)[:, None] * [1.0, 0.5, -1.0]
    record = replace(dense(), masses=Samples(t, sag))
    few = with_few_bends(record, FAST).masses
    off = np.column_stack([np.interp(t, few.t, x) for x in few.values.T]) - sag
    lean = 0.0156 * 9.81 * np.abs(off).max() / (0.35 * quickest_swing(platform()) ** 2)
    assert 0.1 < lean / (0.01 * FAST.attitude.noise / 2) < 1.2
    assert len(few) < 0.1 * len(t)


def test_noise_found_in_means_is_brought_back_to_rows():
    few = condensed(noisy(dense(), 0), FAST)
    loud = replace(few.testbed, attitude=replace(few.testbed.attitude, noise=2e-3))
    problem = fit(few.recording, few.testbed, Params(), guess=None)
    model = replace(survey(few.recording, few.testbed, Params(), problem), testbed=loud)
    assert with_noise_of(few, model, FAST).attitude.noise == pytest.approx(4e-3)


def test_a_log_that_is_late_is_so_for_all_rows():
    few = condensed(noisy(dense(), 0), FAST)
    late = replace(few.testbed, masses=logged_late(few.testbed.masses))
    fitted = fit(few.recording, few.testbed, Params(), guess=None)
    model = replace(survey(few.recording, few.testbed, Params(), fitted), testbed=late)
    whole = with_all_rows(few, model, dense(), FAST)
    assert all(mass.logged_late for mass in whole.testbed.masses)


def test_the_start_is_given_the_rows_before_the_first_gap():
    """Half a second is no gap for a swing, 6 s are; a fiftieth of the record is too little."""
    t = np.concatenate([np.arange(0, 3, 0.1), np.arange(9, 80, 0.1), np.arange(80.5, 90, 0.1),
                        np.arange(96, 200, 0.1)])  # fmt: skip
    record = Recording(Samples(t, np.tile([1.0, 0, 0, 0], (len(t), 1))))
    assert first_gap(record, platform()) == pytest.approx(89.9)
    whole = Recording(Samples(np.arange(0, 90, 0.1), np.tile([1.0, 0, 0, 0], (900, 1))))
    assert first_gap(whole, platform()) == pytest.approx(89.9)


def test_a_motion_found_in_means_is_taken_back_to_the_first_row():
    """The first mean is of rows from 0 to 0.03 s, its middle at 0.015 s: 0.015 rad at 1 rad/s."""
    record, params = dense(), Params()
    few = condensed(record, FAST)
    whole, part = (problem_of(*x, params) for x in ((record, FAST), (few.recording, few.testbed)))
    point = fit(few.recording, few.testbed, params).point
    found = settle(part, replace(point, w0=np.array([0.0, 0.0, 1.0])), None, 1)
    late = difference(found.point.q0, moved(found, whole).point.q0)
    np.testing.assert_allclose(late, [0.0, 0.0, 0.015], atol=1e-12)


def astray(record, testbed):
    """A fit that began with a rate of 12 rad/s where there is a hundredth of that."""
    problem, good = problem_of(record, testbed, Params()), fit(record, testbed, Params())
    point = replace(good.point, w0=good.point.w0 + [0.0, 0.0, 12.0])
    return settle(problem, point, None, 3)


def test_a_search_gone_astray_is_found_again_from_the_measured_states(monkeypatch):
    """Its cost is infinite; the survey begins at what the camera saw, and ends at the truth."""
    record, testbed = noisy(recording(60.0, move_at(20.0, 60.0)), 0), platform(3e-4)
    lost = astray(record, testbed)
    assert not np.isfinite(lost.at.cost)
    monkeypatch.setattr(initial_model, "fit", lambda *_: lost)
    estimate = reference_fit.estimate(record, testbed, Params())
    assert estimate.outcome.usable
    assert not estimate.events
    off = estimate.values(BODY) - np.concatenate([INERTIA, COM])
    assert np.abs(off / np.sqrt(np.diag(estimate.covariance_of(BODY)))).max() < 4.0


def test_a_search_gone_astray_without_a_camera_is_an_outcome(monkeypatch):
    """No measured state leads back: nothing settled, and nothing is reported about the record."""
    clean = recording(60.0, move_at(20.0, 60.0), camera=0.0, gyro=10.0)
    record, testbed = noisy(clean, 0), platform(3e-4, gyro=True)
    lost = astray(record, testbed)
    monkeypatch.setattr(initial_model, "fit", lambda *_: lost)
    estimate = reference_fit.estimate(record, testbed, Params())
    assert not estimate.outcome.usable
    assert codes_of(estimate) == ["not_converged"]
