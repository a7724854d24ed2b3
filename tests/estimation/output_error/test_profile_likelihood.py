"""The misfit beside an optimum: a parabola where a record is good, and less where it is not."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from equipoise.estimation.output_error.fit_estimate import conclude
from equipoise.estimation.output_error.profile_likelihood import (
    LEAST,
    WIDE,
    profiled,
    rise,
    sizes_of,
)
from equipoise.estimation.output_error.solution import Fitted
from equipoise.estimation.output_error.trajectory import Params, fit
from equipoise.estimation.search_budget import Budget, Stage
from equipoise.maths.attitude import exponential, multiply
from equipoise.model.estimate import BODY, Estimate
from equipoise.model.outcome import OutcomeCode
from equipoise.model.reasons.data_reasons import Unobservable
from equipoise.model.recording import Samples
from tests.support.builders import CAMERA_SD, level, move_at, platform, recording


@cache
def concluded(noise: float) -> tuple[Fitted, Estimate]:
    """The fit of a record with so many times the shared camera's noise, and its estimate."""
    bed, clean = level(platform()), recording(track=move_at(60.0, 120.0))
    camera, sd = clean.attitude, noise * CAMERA_SD
    error = exponential(sd * np.random.default_rng(1).normal(size=(len(camera), 3)))
    rows = Samples(camera.t, multiply(camera.values, error))
    testbed = replace(bed, attitude=replace(bed.attitude, noise=sd))
    record = replace(clean, attitude=rows)
    found = fit(record, testbed, Params())
    return found, conclude(found, "fit", record)


@pytest.mark.parametrize("name", BODY)
@pytest.mark.parametrize("sds", [-2.0, 1.0])
def test_the_misfit_rises_by_the_square_of_how_many_sd(name, sds) -> None:
    found, estimate = concluded(0.1)
    parameter = estimate.parameters[estimate.index(name)]
    assert rise(found, parameter, sds * parameter.sd) == pytest.approx(sds**2, rel=0.01)


def test_an_estimate_whose_intervals_hold_is_as_it_was() -> None:
    found, estimate = concluded(20.0)
    wide = [p.name for p in estimate.parameters
            if p.name in BODY and p.sd > WIDE * sizes_of(found)[p.name]]  # fmt: skip
    assert "inertia_P_zz" in wide
    assert profiled(estimate, found) is estimate


def test_an_interval_that_is_too_narrow_is_open_and_the_outcome_says_so() -> None:
    """Half as wide as it should be: the misfit rises by a quarter of 4 there, or less."""
    found, estimate = concluded(20.0)
    k = estimate.index("inertia_P_zz")
    parameters = list(estimate.parameters)
    parameters[k] = replace(parameters[k], sd=parameters[k].sd / 2)
    narrow = profiled(replace(estimate, parameters=tuple(parameters)), found)
    assert not narrow.parameters[k].observable
    assert narrow.parameters[k].sd == np.inf
    assert narrow.outcome.code is OutcomeCode.PART_UNOBSERVABLE
    (reason,) = [r for r in narrow.unobservable if r.code is Unobservable.MISFIT_FLAT]
    assert reason.parameters == ("inertia_P_zz",)
    assert 0.0 < reason.numbers["rise"] < LEAST
    others = (narrow.parameters[i] == p for i, p in enumerate(parameters) if i != k)
    assert all(others)


def test_intervals_that_the_budget_leaves_untried_are_unfinished() -> None:
    found, estimate = concluded(20.0)
    spent = Budget(lambda: lambda: True)
    assert profiled(estimate, found, spent) is estimate
    assert spent.unfinished == (Stage.INTERVALS,)


def test_narrow_intervals_take_no_time() -> None:
    found, estimate = concluded(0.1)
    spent = Budget(lambda: lambda: True)
    assert profiled(estimate, found, spent) is estimate
    assert spent.unfinished == ()
