"""The scatter between runs: by hand, and over many draws of linear runs."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.estimation.joint.run_scatter import (
    UNLIKELY,
    OwnShare,
    exceeds,
    scatter_of,
    spreads_of,
    verdict_of,
)
from equipoise.model.estimate import Estimate, Parameter
from equipoise.model.outcome import outcome
from equipoise.model.reasons.estimate_reasons import EstimateReason
from equipoise.model.reasons.verdict_reasons import VerdictReason
from equipoise.model.verdict import VerdictOutcome
from tests.support import thorough


def shares_of(S, values, beside=None):
    """Runs whose own estimates are ``values``, with information ``S``, about their joint one."""
    C = np.linalg.inv(sum(S))
    joint = C @ sum(A @ x for A, x in zip(S, values, strict=True))
    none = np.zeros_like(C)
    return [
        OwnShare(A, A @ (x - joint), none if beside is None else beside, np.zeros(len(C)), C)
        for A, x in zip(S, values, strict=True)
    ]


def scatter(S, values, beside=None):
    names = [f"run {k + 1}" for k in range(len(S))]
    return scatter_of(shares_of(S, values, beside), names, [])


def test_two_runs_of_one_number_by_hand():
    """+0.1 and -0.1 with sd 0.1: 0.2 apart, sd sqrt(2) 0.1: chi-square 2 of 1, for each and all."""
    S = [np.array([[100.0]])] * 2
    found = scatter(S, [np.array([0.1]), np.array([-0.1])])
    assert found.chi_square == pytest.approx(2.0)
    assert found.freedom == pytest.approx(1.0)
    assert found.probability == pytest.approx(0.157299, abs=1e-6)  # erfc(1)
    assert found.factor == pytest.approx(np.sqrt(2.0))
    for each in found.deviations:
        assert (each.chi_square, each.freedom) == (pytest.approx(2.0), 1.0)


def test_what_else_an_interval_counts_is_no_scatter():
    """sd 0.1 of noise and 0.1 of when an event was: the joint mean is the same, its weight too.

    C_i = 0.02, z^2 = 0.01 / 0.02 each; W = 0.005 / 0.02, so 2 - 2 / 4 degrees.
    """
    S = [np.array([[100.0]])] * 2
    found = scatter(S, [np.array([0.1]), np.array([-0.1])], np.array([[0.01]]))
    assert found.chi_square == pytest.approx(1.0)
    assert found.freedom == pytest.approx(1.5)


def test_a_direction_that_one_run_alone_shows_is_not_compared():
    """x is shown by both, y by the second alone: one degree, and a y of 1000 changes nothing."""
    S = [np.diag([100.0, 0.0]), np.diag([100.0, 100.0])]
    found = scatter(S, [np.array([0.1, 0.0]), np.array([-0.1, 1e3])])
    assert found.chi_square == pytest.approx(2.0)
    assert found.freedom == pytest.approx(1.0)
    assert [each.freedom for each in found.deviations] == [1.0, 1.0]


def test_runs_that_show_nothing_in_common_cannot_be_compared():
    S = [np.diag([100.0, 0.0]), np.diag([0.0, 100.0])]
    found = scatter(S, [np.array([1.0, 0.0]), np.array([0.0, 5.0])])
    assert found.freedom == pytest.approx(0.0)
    verdict = verdict_of(found)
    assert (verdict.code, verdict.outcome) == (
        VerdictReason.RUNS_INCOMPARABLE,
        VerdictOutcome.UNDECIDED,
    )


def drawn(rng, runs, size):
    """Information of runs that each miss a direction, and their estimates of zero."""
    S, values = [], []
    for _ in range(runs):
        turned, _ = np.linalg.qr(rng.normal(size=(size, size)))
        A = turned[:, 1:] * rng.uniform(5.0, 30.0, size - 1)
        S.append(A @ A.T)
        noise = A @ rng.normal(size=size - 1)
        values.append(np.linalg.pinv(S[-1]) @ noise)
    return S, values


def test_scatter_that_is_as_stated_is_as_probable_as_it_says():
    """Chi-squares have the mean of their degrees; one verdict in a hundred fails."""
    rng, draws = np.random.default_rng(3), thorough.count(4000, 300)
    found = [scatter(*drawn(rng, 4, 3)) for _ in range(draws)]
    assert all(each.freedom == pytest.approx(4 * 2 - 3) for each in found)
    mean = np.mean([each.chi_square for each in found])
    assert mean == pytest.approx(5.0, abs=4 * np.sqrt(10.0 / draws))
    single = np.mean([d.chi_square - d.freedom for each in found for d in each.deviations])
    assert abs(single) < 4 * np.sqrt(4.0 / draws)
    failed = sum(map(exceeds, found))
    assert failed <= UNLIKELY * draws + 4 * np.sqrt(UNLIKELY * draws)


def test_a_run_that_errs_is_named():
    rng = np.random.default_rng(4)
    S, values = drawn(rng, 5, 3)
    values[2] = values[2] + np.array([3.0, 0.0, 0.0])
    verdict = verdict_of(scatter(S, values))
    assert verdict.outcome is VerdictOutcome.FAILED
    assert [reason.code for reason in verdict.reasons] == [
        VerdictReason.RUNS_SCATTER,
        VerdictReason.RUNS_DEVIATE,
    ]
    assert "run 3" in verdict.reasons[1].parameters


def estimate_with(com_x, sd, observable=True):
    found = Parameter("com_x", "m", com_x, sd, observable)
    return Estimate("trajectory", outcome(EstimateReason.FITTED_JOINTLY), (found,), np.eye(1))


def test_the_spread_of_a_parameter_by_hand():
    """1, 2, 3 um: mean 2, sd 1; stated 1, 2, 2: rms sqrt(3). A run that does not show it is out."""
    runs = [estimate_with(value * 1e-6, sd * 1e-6) for value, sd in ((1, 1), (2, 2), (3, 2))]
    runs.append(estimate_with(9.0, np.inf, observable=False))
    (spread,) = spreads_of(runs)
    assert (spread.name, spread.unit, spread.runs) == ("com_x", "m", 3)
    assert spread.mean == pytest.approx(2e-6)
    assert spread.sd_between == pytest.approx(1e-6)
    assert spread.sd_stated == pytest.approx(np.sqrt(3.0) * 1e-6)
    assert spreads_of(runs[:1]) == ()


def test_masses_that_hang_widen_what_a_run_states():
    """A pull of g by 10 at S = 100 is a shift of one more sd of 0.1: half the scatter counts."""
    S = [np.array([[100.0]])] * 2
    shares = shares_of(S, [np.array([0.1]), np.array([-0.1])])
    hung = [replace(share, sagged=np.array([10.0])) for share in shares]
    assert scatter_of(hung, ["a", "b"], []).chi_square == pytest.approx(1.0)
