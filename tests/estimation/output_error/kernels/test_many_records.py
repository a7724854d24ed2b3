"""One problem for many records: each descends as by itself, from the nearer of its points."""

from dataclasses import replace

import numpy as np

from equipoise.estimation.output_error.growing_horizon import misfit
from equipoise.estimation.output_error.kernels.many_records import settle_each
from equipoise.estimation.output_error.monte_carlo.many_fits import blind_of, room_for
from equipoise.estimation.output_error.problem import posed as as_posed
from equipoise.estimation.output_error.solution import settle
from equipoise.estimation.output_error.trajectory import Params, fit, problem_of
from tests.support.builders import move_at, noisy, platform, recording

BED = platform(3e-4, gyro=True)
RECORDS = [noisy(recording(20.0, move_at(5.0, 20.0), gyro=20.0), k, np.zeros(3)) for k in range(3)]


def settled(near, most=300):
    """The descents of all records, and those of each alone from both points."""
    problems = [problem_of.__wrapped__(record, BED, Params()) for record in RECORDS]
    point = fit(RECORDS[0], BED, Params()).point
    both = [replace(point, w0=point.w0 + 1e-3), replace(point, w0=point.w0 - 2e-3)]
    orders = [both, both[::-1], both]
    points = np.array([[each.flat for each in order] for order in orders])
    out = room_for(problems[0], len(RECORDS))
    rows = [np.array([getattr(r, name).values for r in RECORDS]) for name in ("attitude", "rate")]
    settle_each(as_posed(problems[0]), blind_of(problems[0]), *rows, points, near, most, out)
    nearer = [min(both, key=lambda one, own=own: misfit(own, one)) for own in problems]
    assert all(one is both[0] for one in nearer)
    return out, [settle(own, one, most=most) for own, one in zip(problems, nearer, strict=True)]


def test_each_descends_as_by_itself():
    out, alone = settled(near=1.0)
    for k, own in enumerate(alone):
        np.testing.assert_allclose(out.points[k], own.point.flat, rtol=1e-12, atol=1e-15)
        np.testing.assert_allclose(out.normal[k], own.at.normal, rtol=1e-9, atol=1e-6)
        np.testing.assert_allclose(out.cost[k], own.at.cost, rtol=1e-12)
        assert (out.converged[k], out.evaluations[k]) == (own.converged, own.evaluations)


def test_too_few_evaluations_are_not_called_converged():
    out, _ = settled(near=1.0, most=2)
    assert not out.converged.any()
    assert out.evaluations.tolist() == [2, 2, 2]


def test_none_is_begun_that_is_lost():
    out, _ = settled(near=1e-6)
    assert np.isinf(out.cost).all()
    assert not out.evaluations.any()
