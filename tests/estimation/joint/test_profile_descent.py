"""The joint fit: its step, its optimum and its covariance against plain linear algebra."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.estimation.events.record_model import RecordModel
from equipoise.estimation.joint import profile_descent
from equipoise.estimation.joint.profile_descent import (
    Joint,
    attempt,
    descend,
    first_record,
    fit_jointly,
    local_model,
    moved_to,
    of_data,
    reduced,
)
from equipoise.estimation.joint.shared_parameters import BODIES, shared_of
from equipoise.estimation.output_error.trajectory import Params, fit
from equipoise.estimation.parameters.fit_parameters import CORE, physical
from equipoise.estimation.search_budget import Budget, Stage
from equipoise.maths.attitude import exponential, multiply
from equipoise.maths.linalg import inverse_spd
from equipoise.model.estimate import BODY
from equipoise.model.recording import Samples
from tests.support.builders import guessed_wrong, level, move_at, noisy, platform, recording

END = 60.0
BED = guessed_wrong(level(platform(3e-4)))
LEANING = guessed_wrong(platform(3e-4))
WITH_LEAN = Params(sensor=("plumb_x", "plumb_y"))


def model_of(record, bed=BED, params=None):
    requested = Params() if params is None else params
    found = fit(record, bed, requested)
    return RecordModel(record, bed, requested, np.zeros(0), np.zeros(3), (), found, bed)


@pytest.fixture(scope="module")
def clean():
    return recording(END, move_at(20.0, END))


@pytest.fixture(scope="module")
def models(clean):
    return [model_of(noisy(clean, seed)) for seed in (1, 2)]


@pytest.fixture(scope="module")
def joint(models):
    return fit_jointly(models, [1.0, 1.0], BED)


def core_of(model):
    problem = model.fitted.problem
    return physical(model.fitted.point, problem.mass, problem.layout)[CORE]


def test_the_step_is_that_of_all_unknowns_at_once(models):
    """Shared and private unknowns of both records in one matrix, solved by NumPy."""
    shared = shared_of(models, BED)
    first, second = (
        first_record(model, shared.names, w) for model, w in zip(models, (1.0, 0.25), strict=True)
    )
    n, m = shared.size, len(first.place.private)
    size = n + 2 * m
    A, b = np.zeros((size, size)), np.zeros(size)
    for k, record in enumerate((first, second)):
        where = np.empty(record.problem.layout.size, dtype=int)
        where[record.place.own] = record.place.shared
        where[record.place.private] = n + k * m + np.arange(m)
        A[np.ix_(where, where)] += record.weight * record.fitted.at.normal
        b[where] += record.weight * record.fitted.at.descent
    scale = 1 / np.sqrt(np.diag(A))
    whole = scale * np.linalg.solve(A * np.outer(scale, scale), scale * b)
    S, g = of_data(Joint(shared, (first, second), shared.prior.mean))
    size = np.sqrt(np.diag(S))
    np.testing.assert_allclose(np.linalg.solve(S, g) * size, whole[:n] * size, atol=1e-6)


def test_two_records_alike_have_the_optimum_of_one_and_half_its_covariance(models):
    """But for the priors on the body and the lag of the drives, which count once."""
    joint = fit_jointly([models[0], models[0]], [1.0, 1.0], BED)
    own = inverse_spd(models[0].fitted.at.normal)[CORE, CORE]
    found = inverse_spd(local_model(joint)[0])
    sd = np.sqrt(np.diag(own))
    assert joint.converged
    assert np.abs((joint.x[BODIES] - core_of(models[0])) / sd).max() < 0.05
    np.testing.assert_allclose(np.diag(found)[BODIES], np.diag(own) / 2, rtol=5e-3)


def test_a_record_of_weight_zero_changes_nothing(models):
    joint = fit_jointly(models, [1.0, 1e-12], BED)
    sd = np.sqrt(np.diag(inverse_spd(models[0].fitted.at.normal)[CORE, CORE]))
    assert np.abs((joint.x[BODIES] - core_of(models[0])) / sd).max() < 0.05


def test_about_the_optimum_twice_the_cost_rises_by_one_for_each_standard_deviation(joint):
    """With all private unknowns at their own optimum, whatever the direction."""
    C = inverse_spd(local_model(joint)[0])
    rng = np.random.default_rng(5)
    for _ in range(4):
        direction = rng.normal(size=len(C))
        step = 0.3 * C @ direction / np.sqrt(direction @ C @ direction)
        rise = 2 * (moved_to(joint, joint.x + step).cost - joint.cost)
        assert rise == pytest.approx(0.09, abs=0.02)


def test_every_record_has_the_same_body(joint):
    bodies = [record.values(joint.shared.size)[BODIES] for record in joint.records]
    np.testing.assert_allclose(bodies[0], bodies[1], rtol=1e-12, atol=1e-15)


def test_a_start_that_is_off_leads_to_the_same_optimum(joint):
    x = joint.x.copy()
    x[:3] *= 1.03
    x[6:9] += 3e-6
    again = descend(moved_to(joint, x))
    sd = np.sqrt(np.diag(inverse_spd(local_model(joint)[0])))
    assert again.converged
    assert np.abs((again.x - joint.x) / sd).max() < 0.05


def test_a_run_whose_own_optimum_is_another_body_misleads_no_start(models):
    """One of two records is left at J half as large and nearly flat, sure of it."""
    flat = replace(
        models[1].fitted.point, six=models[1].fitted.point.six - [0.3, 0.3, 4.0, 0, 0, 0]
    )
    lost = replace(models[1], fitted=replace(models[1].fitted, point=flat))
    joint = fit_jointly([models[0], lost], [1.0, 1.0], BED)
    right = fit_jointly(models, [1.0, 1.0], BED)
    sd = np.sqrt(np.diag(inverse_spd(local_model(right)[0])))
    assert joint.converged
    assert np.abs((joint.x - right.x) / sd).max() < 0.05


def test_a_start_that_leads_nowhere_is_followed_by_another(models, joint, monkeypatch):
    """A centre of mass of 5 mm above P: no record can be followed from there."""
    lost = joint.x.copy()
    lost[6:9] = [0.0, 0.0, 5e-3]
    stuck = Joint(joint.shared, joint.records, lost)
    assert not attempt(stuck).converged
    monkeypatch.setattr(profile_descent, "starts", lambda *_: [lost, joint.x])
    again = fit_jointly(models, [1.0, 1.0], BED)
    sd = np.sqrt(np.diag(inverse_spd(local_model(joint)[0])))
    assert again.converged
    assert np.abs((again.x - joint.x) / sd).max() < 0.05


def test_where_the_information_is_not_positive_no_descent_has_arrived(joint):
    """A small promise says nothing there: the second record counts against the first."""
    against = replace(joint.records[1], weight=-2.0)
    found = descend(replace(joint, records=(joint.records[0], against), converged=False))
    assert all(record.fitted.converged for record in found.records)
    assert not found.converged


def test_a_descent_whose_budget_is_spent_stays_where_it_is(models, joint):
    budget = Budget(lambda: lambda: True)
    found = fit_jointly(models, [1.0, 1.0], BED, budget)
    assert not found.converged
    assert np.isfinite(found.cost)
    assert found.cost >= joint.cost
    assert budget.unfinished == (Stage.RUNS,)


def test_a_prior_on_what_is_shared_counts_once(clean):
    """However many records there are: that the camera leans, and what is known of the body."""
    requested = replace(WITH_LEAN, use_prior=True)
    one = model_of(noisy(clean, 1), LEANING, requested)
    single, triple = shared_of([one], LEANING), shared_of([one] * 3, LEANING)
    assert single.names == (*BODY, "plumb_x", "plumb_y", "mass_lag_1")[: len(single.names)]
    np.testing.assert_array_equal(single.prior.weight, triple.prior.weight)
    assert single.prior.weight[0] > 1 / (0.1 * one.testbed.body.inertia_P[0, 0]) ** 2 * 0.99
    records = [first_record(one, triple.names, 1.0) for _ in range(3)]
    kept = [record.problem.prior.weight[record.place.own] for record in records]
    assert not np.any(kept)


def test_an_information_matrix_of_what_is_shared_is_that_of_its_inverse_covariance(models):
    """Schur: S is the inverse of the block of the whole inverse."""
    shared = shared_of(models, BED)
    record = first_record(models[0], shared.names, 1.0)
    normal = record.fitted.at.normal
    own = record.place.own
    block = inverse_spd(normal)[np.ix_(own, own)]
    size = 1 / np.sqrt(np.diag(block))
    S = reduced(record)[0] / np.outer(size, size)
    np.testing.assert_allclose(S, np.linalg.inv(block * np.outer(size, size)), rtol=1e-4, atol=1e-4)


def turned(record, rotation):
    """The same record in other laboratory axes."""
    rows = record.attitude
    return replace(record, attitude=Samples(rows.t, multiply(exponential(rotation), rows.values)))


def test_a_lean_that_one_record_cannot_separate_from_com_shows_by_two_headings(clean):
    lean = np.radians([0.3, -0.2, 0.0])
    headings = np.radians([[0.0, 0.0, 0.0], [0.0, 0.0, 120.0]])
    records = [turned(noisy(turned(clean, way), k), lean) for k, way in enumerate(headings)]
    models = [model_of(record, LEANING, WITH_LEAN) for record in records]
    joint = fit_jointly(models, [1.0, 1.0], LEANING)
    at = [joint.shared.names.index(name) for name in WITH_LEAN.sensor]
    sd = np.sqrt(np.diag(inverse_spd(local_model(joint)[0])))[at]
    own = np.sqrt(np.diag(inverse_spd(models[0].fitted.at.normal)))
    assert np.all(sd < 0.5 * own[models[0].fitted.problem.layout.sensors])
    assert np.abs((joint.x[at] - lean[:2]) / sd).max() < 4.0
