"""Toward the stated body chi-square rises as intervals say, or they are none."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.estimation.output_error.fixed_parameters import settle_pinned
from equipoise.estimation.output_error.profile_likelihood import values_of
from equipoise.estimation.output_error.solution import cost_of, evaluate
from equipoise.estimation.output_error.toward_stated import (
    FARTHER,
    compared_with_stated,
    sds_between,
    with_stated,
)
from equipoise.estimation.output_error.trajectory import Params, fit
from equipoise.estimation.search_budget import Budget, Stage
from equipoise.model.estimate import BODY, Parameter
from equipoise.model.mass_properties import MassProperties
from equipoise.model.outcome import OutcomeCode
from equipoise.model.reasons.data_reasons import Unobservable
from tests.estimation.output_error.test_profile_likelihood import concluded


def off_by(fitted, sds: float):
    """Return the testbed with a body that is stated so many of its own sd off what was found."""
    bed, found = fitted.problem.testbed, fitted.point.body(fitted.problem.mass)
    inertia = found.inertia_P * (1.0 + sds * bed.inertia_sd)
    body = MassProperties(found.mass, found.com + sds * bed.com_sd, inertia)
    return replace(bed, body=body)


def nearer(fitted, stated):
    """Return how many sd each number is away at the optimum with the prior, and the rise there."""
    at = settle_pinned(with_stated(fitted.problem, stated), fitted.point, fitted.jumps)
    rise = 2.0 * (evaluate(fitted.problem, at.point, at.jumps).cost - cost_of(fitted))
    return [values_of(fitted.problem, one.point) for one in (fitted, at)], rise


@pytest.mark.parametrize("noise", [0.1, 5.0, 20.0])
@pytest.mark.parametrize("sds", [-1.0, 2.0])
def test_no_number_goes_farther_than_the_root_of_the_rise(noise, sds) -> None:
    """The inequality of Cauchy and Schwarz, of a record whose valley is a parabola."""
    fitted, estimate = concluded(noise)
    (here, there), rise = nearer(fitted, off_by(fitted, sds))
    away = [sds_between(p, here, there) for p in estimate.parameters if p.name in BODY]
    assert 0.0 < max(away) < 1.2 * rise**0.5
    assert compared_with_stated(estimate, fitted, off_by(fitted, sds)) is estimate


def test_an_interval_that_is_too_narrow_is_open_and_the_outcome_says_so() -> None:
    """J_zz to a tenth of its sd: it goes ten times as far as chi-square says that it may."""
    fitted, estimate = concluded(20.0)
    stated, k = off_by(fitted, 2.0), estimate.index("inertia_P_zz")
    parameters = list(estimate.parameters)
    parameters[k] = replace(parameters[k], sd=parameters[k].sd / 10)
    tried = compared_with_stated(replace(estimate, parameters=tuple(parameters)), fitted, stated)
    assert not tried.parameters[k].observable
    assert tried.outcome.code is OutcomeCode.PART_UNOBSERVABLE
    (reason,) = [r for r in tried.unobservable if r.code is Unobservable.MISFIT_FLAT]
    assert reason.parameters == ("inertia_P_zz",)
    sds, rise = reason.numbers["sds"], reason.numbers["rise"]
    assert sds > FARTHER * max(1.0, rise) ** 0.5
    assert reason.numbers["due"] == sds**2
    others = (tried.parameters[i] == p for i, p in enumerate(parameters) if i != k)
    assert all(others)


def test_ratios_are_counted_in_their_own_sd() -> None:
    here = {"inertia_P_xx": 1.0, "inertia_P_zz": 2.0}
    there = {"inertia_P_xx": 1.2, "inertia_P_zz": 2.0}
    ratio = Parameter("inertia_P_xx/inertia_P_zz", "1", 0.5, 0.05)
    assert sds_between(ratio, here, there) == pytest.approx(2.0)
    assert sds_between(replace(ratio, sd=np.inf), here, there) == 0.0
    assert sds_between(replace(ratio, name="gyro_bias_x"), here, there) == 0.0


def test_where_the_prior_is_in_use_nothing_is_tried() -> None:
    fitted, estimate = concluded(20.0)
    problem = fitted.problem
    known = fit(problem.recording, problem.testbed, Params(use_prior=True))
    spent = Budget(lambda: pytest.fail("asked for"))
    assert compared_with_stated(estimate, known, problem.testbed, spent) is estimate


def test_what_the_budget_leaves_untried_is_unfinished() -> None:
    fitted, estimate = concluded(20.0)
    spent = Budget(lambda: lambda: True)
    assert compared_with_stated(estimate, fitted, fitted.problem.testbed, spent) is estimate
    assert spent.unfinished == (Stage.INTERVALS,)
