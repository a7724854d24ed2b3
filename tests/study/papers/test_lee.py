"""Lee et al.'s slews: angles about a vertical roll axis, a singularity, estimates as rows grow.

A short slew is enough for what is exact; what the methods make of whole ones is in
`tests/statistical/test_lee.py`.
"""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.actuators.cmg_steering import NEAR as GIVES_WAY
from equipoise.estimation.method_contract import Options
from equipoise.estimation.methods.registry import METHODS
from equipoise.estimation.regression.formulations.averaged import as_printed, centred_means
from equipoise.estimation.regression.formulations.rows import centred
from equipoise.estimation.regression.linear_method import posed_of
from equipoise.io.testbed.presets import read_preset
from equipoise.maths.attitude import level, tilt
from equipoise.model.errors import InputError
from equipoise.model.estimate import Estimate, Parameter
from equipoise.model.outcome import outcome
from equipoise.model.reasons.estimate_reasons import EstimateReason
from equipoise.model.recording import window
from equipoise.study.papers.gyro_slew import slewed
from equipoise.study.papers.lee import (
    LARGE,
    SOUGHT,
    angles_of,
    attitude_at,
    coarser,
    gains_of,
    singular_times,
    slew_from,
    started,
    true_values,
    warns,
    with_printed_errors,
)
from equipoise.study.papers.lee_course import BATCH, DRAWN, courses_of, rows_until, turning_from

BED = read_preset("kau")


@pytest.fixture(scope="module")
def slew():
    return slew_from(BED, LARGE, seed=1, duration=20.0)


@pytest.fixture(scope="module")
def courses(slew):
    return courses_of(slew.recording, with_printed_errors(BED))


def whole(formulation, slew):
    """The rows of the whole record."""
    return formulation(posed_of(slew.recording, with_printed_errors(BED), Options()))


def test_roll_is_a_heading_and_pitch_and_yaw_tilt():
    """cos(tilt) = cos(30 deg) cos(30 deg) = 3/4, whatever the roll."""
    assert tilt(attitude_at(BED, (70.0, 0.0, 0.0)), BED.up) == pytest.approx(0.0, abs=1e-7)
    for roll in (0.0, 70.0):
        leaning = tilt(attitude_at(BED, (roll, 30.0, -30.0)), BED.up)
        assert np.cos(leaning) == pytest.approx(0.75)


def test_angles_come_back():
    q = np.array([attitude_at(BED, LARGE), attitude_at(BED, (0.0, 0.0, 0.0))])
    np.testing.assert_allclose(np.degrees(angles_of(BED, q)), [LARGE, (0.0, 0.0, 0.0)], atol=1e-9)


def test_the_truth_is_the_papers():
    """Table 1: diag(20, 16, 14) kg m2 and (-0.1, 0.1, 0.05) kg cm."""
    truth = true_values(BED)
    moment = [truth[name] * BED.body.mass * 100 for name in SOUGHT[:3]]
    np.testing.assert_allclose(moment, [-0.1, 0.1, 0.05])
    assert [truth[name] for name in SOUGHT[3:]] == [20.0, 16.0, 14.0, 0.0, 0.0, 0.0]


def test_it_starts_where_the_paper_does_and_turns_towards_zero(slew):
    angles = np.degrees(angles_of(BED, slew.q))
    np.testing.assert_allclose(angles[0], LARGE, atol=0.1)
    np.testing.assert_allclose(slew.rate[0], 0.0, atol=1e-3)
    assert abs(angles[-1, 0]) < 10.0


def test_the_singularity_is_met_when_the_paper_meets_it(slew):
    """At about 10 to 15 s; the torque asked for is given outside it and not within."""
    near = singular_times(slew)
    assert near is not None
    assert 10.0 <= near[0] < near[1] <= 15.0
    lost = np.linalg.norm(slew.output - slew.required, axis=1)
    assert np.all(lost[slew.measure > GIVES_WAY] < 1e-12)
    assert lost.max() > 0.02


def test_the_reported_torque_is_the_rate_of_stored_gyro_momentum(slew):
    """-h' of the recorded momentum, between two steps of the loop, body axes."""
    reported = slew.recording.momentum
    assert reported is not None
    stored = np.array([np.interp(slew.t, reported.t, h) for h in reported.values.T]).T
    given = -np.diff(stored, axis=0) / np.diff(slew.t)[:, None]
    np.testing.assert_allclose(given[2:], slew.output[2:-1], atol=8e-3)  # the gimbals turn on
    assert np.abs(slew.output).max() > 0.2


def test_the_shorter_way_is_turned_whatever_the_sign_of_the_target(slew):
    bed = started(with_printed_errors(BED), LARGE)
    other = slewed(bed, -level(bed.up), gains_of(bed), 1.0, 1)
    np.testing.assert_array_equal(other.required, slew.required[: len(other.t)])


def test_no_singularity_is_reported_outside_it(slew):
    early = slew.t < 8.0
    part = slew._replace(t=slew.t[early], measure=slew.measure[early])
    assert singular_times(part) is None


def test_estimates_begin_where_the_platform_turns(slew):
    """From rest at 0.3 N m and 20 kg m2 or so: 1 deg/s after 1 s."""
    assert turning_from(slew.recording) == pytest.approx(1.0, abs=0.3)
    with pytest.raises(InputError, match="turns"):
        turning_from(window(slew.recording, 0.0, 0.4))


def recursive_least_squares(rows, first):
    """Lee Eq. 8 as it stands, W = E: a batch of rows up to ``first``, then row by row."""
    n = int(np.searchsorted(rows.t, first, side="right"))
    H, y = rows.A[:n].reshape(-1, 9), rows.b[:n].reshape(-1)
    scale = np.linalg.norm(H, axis=0)
    information = (H / scale).T @ (H / scale)
    x = np.linalg.solve(information, (H / scale).T @ y)
    for A, b in zip(rows.A[n:] / scale, rows.b[n:], strict=True):
        information = information + A.T @ A
        x = x + np.linalg.solve(information, A.T @ (b - A @ x))
    return x / scale


def test_the_course_is_that_of_recursive_least_squares(slew, courses):
    """The paper's recursion, written out, ends where all rows at once do."""
    rows = whole(as_printed, slew)
    plain = recursive_least_squares(rows, turning_from(slew.recording) + BATCH)
    assert rows.names == courses.printed.names
    np.testing.assert_allclose(courses.printed.values[-1], plain, rtol=1e-4)


@pytest.mark.parametrize("side", range(len(DRAWN)))
def test_a_course_ends_at_what_its_method_finds(slew, courses, side):
    """What a figure shows at its end and what the table says are one estimate."""
    bed, course = with_printed_errors(BED), courses[side]
    found = METHODS[DRAWN[side]].run(slew.recording, bed, Options())
    assert course.t[-1] == pytest.approx(slew.recording.span[1], abs=0.11)
    np.testing.assert_allclose(course.values[-1], found.values(course.names), rtol=1e-9)


def test_a_course_begins_when_the_platform_turns(slew, courses):
    for course in courses:
        assert course.t[0] == turning_from(slew.recording) + BATCH
        assert np.all(np.isfinite(course.values))


def test_indices_are_equations_9_and_10(slew, courses):
    """Of the rows up to each time, written out; free constants go first."""
    reported = courses.corrected
    rows = centred(rows_until(whole(centred_means, slew), reported.t[10]))
    H, y = rows.A.reshape(-1, 9), rows.b.reshape(-1)
    left = y - H @ np.linalg.lstsq(H, y, rcond=None)[0]
    assert reported.total[10] == pytest.approx(np.linalg.norm(left) / np.linalg.norm(y), rel=1e-6)
    scale = np.linalg.norm(H, axis=0)
    inverse = np.linalg.inv((H / scale).T @ (H / scale)) / np.outer(scale, scale)
    printed = np.linalg.norm(left) * np.sqrt(np.diag(inverse))
    np.testing.assert_allclose(reported.parameter[10], printed, rtol=1e-5)


def test_a_coarser_record_has_the_rows_of_the_platforms_own_sensor(slew):
    fine, coarse = slew.recording.attitude, coarser(slew.recording, BED).attitude
    assert fine is not None
    assert coarse is not None
    assert coarse.period == pytest.approx(0.1)
    assert len(fine) == pytest.approx(10 * len(coarse), abs=10)


def estimate(why=EstimateReason.LINEAR, sd=1.0, names=SOUGHT):
    parameters = tuple(Parameter(n, "", 1.0, sd, bool(np.isfinite(sd))) for n in names)
    return Estimate("m", outcome(why), parameters, np.eye(len(names)))


def test_a_warning_is_an_outcome_or_an_interval():
    assert not warns(estimate())
    assert not warns(estimate(EstimateReason.RESIDUAL_LARGE))  # widened, and that is enough
    assert warns(estimate(EstimateReason.BIAS_BY_NOISE))
    assert warns(estimate(EstimateReason.RESIDUAL_TOO_LARGE))
    assert warns(estimate(sd=np.inf))
    assert warns(replace(estimate(), parameters=estimate().parameters[:-1]))
