"""The estimate from several recordings: truth in its intervals, scatter, runs that are left out."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from equipoise.estimation.joint.joint_estimate import Run, estimate_jointly
from equipoise.estimation.joint.run_scatter import exceeds
from equipoise.estimation.output_error.trajectory import Params
from equipoise.model.estimate import BODY, COM, INERTIA
from equipoise.model.outcome import OutcomeCode, Trust
from equipoise.model.reasons.estimate_reasons import EstimateReason as Why
from equipoise.model.reasons.verdict_reasons import VerdictReason
from equipoise.model.recording import window
from equipoise.procedure.identification.identify import IdentifyOptions
from equipoise.procedure.identification.identify_runs import identify_runs
from tests.support import thorough
from tests.support.outcomes import codes_of
from tests.support.platform_runs import platform_runs

SEEDS = [2, *range(10, 10 + thorough.count(19, 1))]


@cache
def surveyed(seed, moves):
    """The runs of a platform, and each surveyed by itself."""
    runs = platform_runs(seed, moves)
    return runs, runs.alone()


def last_alone(runs):
    """The last run, surveyed: those before it are the same as without its shift."""
    return replace(runs, recordings=runs.recordings[-1:]).alone()


@pytest.fixture(scope="module")
def alone():
    return surveyed(2, (True, True, True))


@pytest.fixture(scope="module")
def joint(alone):
    return estimate_jointly(alone[1], alone[0].testbed)


def test_truth_lies_within_the_intervals_and_runs_agree():
    """The error over its own covariance, nine numbers a seed; and no false alarm too many."""
    squares, failed = [], 0
    for seed in SEEDS:
        runs, alone = surveyed(seed, (True, True, True))
        found = estimate_jointly(alone, runs.testbed)
        error = found.estimate.values(BODY) - runs.truth
        covariance = found.estimate.covariance_of(BODY)
        squares.append(float(error @ np.linalg.solve(covariance, error)) / 9)
        failed += exceeds(found.scatter)
    assert np.mean(squares) < 1.0 + 4 * np.sqrt(2 / (9 * len(SEEDS)))
    assert failed <= 1 + len(SEEDS) // 10


def test_intervals_are_narrower_than_those_of_every_run(alone, joint):
    sd = np.sqrt(np.diag(joint.estimate.covariance_of(BODY)))
    for run in alone[1]:
        assert np.all(sd < np.sqrt(np.diag(run.estimate.covariance_of(BODY))))


def test_each_run_is_in_the_sd_of_its_difference_from_the_joint_one(alone, joint):
    """Chi-squares by the runs' own estimates (Hausman) are those from the joint optimum."""
    assert not exceeds(joint.scatter)
    C = joint.estimate.covariance_of(BODY)
    for run, each in zip(alone[1], joint.scatter.deviations, strict=True):
        d = run.estimate.values(BODY) - joint.estimate.values(BODY)
        spread = run.estimate.covariance_of(BODY) - C
        square = float(d @ np.linalg.solve(spread, d))
        assert each.chi_square == pytest.approx(square, rel=0.3, abs=2.0)
        assert each.freedom >= 9


def test_free_swings_gain_the_scale_from_a_run_that_shows_it():
    runs = platform_runs(3, (True, False, False))
    alone = runs.alone()
    assert [run.estimate.outcome.code for run in alone[1:]] == [OutcomeCode.SCALE_OPEN] * 2
    found = estimate_jointly(alone, runs.testbed).estimate
    assert found.sees(BODY)
    first = alone[0].estimate
    for name in (*COM, *INERTIA):
        assert found.parameters[found.index(name)].sd < first.parameters[first.index(name)].sd
    error = found.values(BODY) - runs.truth
    assert error @ np.linalg.solve(found.covariance_of(BODY), error) / 9 < 4.0


def test_free_swings_alone_show_ratios_only():
    runs, alone = surveyed(3, (False, False))
    found = estimate_jointly(alone, runs.testbed)
    assert found.estimate.outcome.code is OutcomeCode.SCALE_OPEN
    assert not any(p.observable for p in found.estimate.parameters if p.name in BODY)
    known = {p.name: p for p in found.estimate.ratios}
    J, com = runs.truth[:6], runs.truth[6:]
    top = int(np.argmax(J[:3]))
    ratio = known[f"com_z/{INERTIA[top]}"]
    assert abs(ratio.value - com[2] / J[top]) < 4 * ratio.sd
    assert found.verdict.code is VerdictReason.RUNS_AGREE


def test_a_little_scatter_widens_and_says_by_how_much(alone, joint):
    """The centre of mass 0.4 um off in the last of three runs, which is 2 sd."""
    runs = platform_runs(2, (True, True, True), (0.4e-6, 0.0, 0.0))
    found = estimate_jointly([*alone[1][:2], *last_alone(runs)], runs.testbed)
    assert found.verdict.code is VerdictReason.RUNS_SCATTER
    assert found.estimate.outcome.trust is Trust.WIDENED
    (widened,) = [r for r in found.estimate.outcome.reasons if r.code is Why.RUNS_SCATTERED]
    assert widened.numbers["widening"] == pytest.approx(found.scatter.factor)
    assert not exceeds(joint.scatter)
    wider = found.estimate.parameters[0].sd / joint.estimate.parameters[0].sd
    assert wider == pytest.approx(found.scatter.factor, rel=0.1)


def test_runs_of_different_platforms_have_no_joint_estimate(alone):
    runs = platform_runs(2, (True, True, True, True), (5e-6, 0.0, 0.0))
    found = estimate_jointly([*alone[1], *last_alone(runs)], runs.testbed)
    assert found.estimate.parameters == ()
    assert codes_of(found.estimate) == [Why.RUNS_DISAGREE]
    assert not found.estimate.outcome.usable
    assert found.verdict.reasons[1].parameters == ("run 4",)
    assert found.scatter.spreads


def test_a_run_that_is_not_usable_is_left_out_and_named(alone, joint):
    runs, each = alone
    lost = replace(each[0], source="lost", model=None)
    found = estimate_jointly([lost, *each], runs.testbed)
    assert found.used == (False, True, True, True)
    (left_out,) = [r for r in found.estimate.outcome.reasons if r.code is Why.RUNS_LEFT_OUT]
    assert left_out.parameters == ("lost",)
    np.testing.assert_allclose(found.estimate.values(BODY), joint.estimate.values(BODY), rtol=1e-9)


def test_one_usable_run_is_no_joint_fit(alone):
    runs, each = alone
    lost = Run("lost", "", None, each[0].estimate)
    found = estimate_jointly([lost, each[1]], runs.testbed)
    assert codes_of(found.estimate) == [Why.TOO_FEW_RUNS]
    assert found.verdict.code is VerdictReason.RUNS_NOT_FITTED


def test_halves_of_one_recording_agree_as_the_whole_does():
    """Consecutive halves as two runs: the same scale, the same body as by the whole record."""
    whole = platform_runs(5, (True,), duration=80.0)
    record = whole.recordings[0]
    halves = [window(record, 0.0, 40.0), window(record, 40.0, 80.0)]
    parts = replace(whole, recordings=tuple(halves))
    found = estimate_jointly(parts.alone(), whole.testbed)
    (single,) = whole.alone()
    sd = np.sqrt(np.diag(found.estimate.covariance_of(BODY)))
    away = found.estimate.values(BODY) - single.estimate.values(BODY)
    assert found.verdict.passed
    assert np.abs(away / sd).max() < 4.0


def test_the_procedure_gives_each_run_and_ends_with_the_verdict():
    runs, alone = surveyed(3, (False, False))
    joint = estimate_jointly(alone, runs.testbed)
    steps = list(identify_runs(runs.recordings, runs.testbed, IdentifyOptions()))
    assert [step.kind for step in steps] == ["estimate"] * 2 + [
        "verify" if joint.verdict.passed else "stop"
    ]
    assert [step.reasons[0].parameters for step in steps[:2]] == [("run 1",), ("run 2",)]
    assert steps[-1].verdict.code is joint.verdict.code


def test_what_is_held_neither_scatters_nor_is_estimated():
    """Free swings with one moment held at a wrong value: all else is stretched alike.

    That pulls at both runs alike, which is no scatter between them.
    """
    runs = platform_runs(3, (False, False))
    top = int(np.argmax(runs.truth[:3]))
    wrong = runs.testbed.body.inertia_P[top, top] / runs.truth[top]
    found = estimate_jointly(runs.alone(Params(hold=(INERTIA[top],))), runs.testbed)
    estimate = found.estimate
    assert found.verdict.passed
    assert INERTIA[top] not in {spread.name for spread in found.scatter.spreads}
    held = estimate.parameters[estimate.index(INERTIA[top])]
    assert held.value == pytest.approx(runs.testbed.body.inertia_P[top, top], rel=1e-6)
    others = [k for k in range(9) if k != top]
    names = tuple(BODY[k] for k in others)
    error = estimate.values(names) - wrong * runs.truth[others]
    assert error @ np.linalg.solve(estimate.covariance_of(names), error) / 8 < 4.0


def test_no_number_of_runs_improves_an_input_that_is_alike_in_all():
    """A platform weighed to 5 %: com of two runs is no better known than that."""
    runs = platform_runs(2, (True, True))
    runs = replace(runs, testbed=replace(runs.testbed, mass_sd=0.05))
    found = estimate_jointly(runs.alone(), runs.testbed).estimate
    k = found.index("com_z")
    least = 0.05 * abs(found.parameters[k].value)
    assert least * 0.95 < found.parameters[k].sd < least * 1.3
