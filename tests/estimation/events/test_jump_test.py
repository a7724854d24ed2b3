"""What happened to a platform, found in its record: touches and slips in units of their sd.

Records are made by the propagator alone, in two pieces.
"""

import numpy as np
import pytest
from scipy.stats import chi2, kstest

from equipoise.estimation.events.jump_test import disturbances
from equipoise.estimation.output_error.segment_jumps import Jump
from equipoise.estimation.output_error.solution import settle, smooth_at
from equipoise.estimation.output_error.trajectory import Params, problem_of
from tests.support.builders import noisy
from tests.support.event_records import EVENT, KINDS, TRUTH, eventful, reported, with_event

every_kind = pytest.mark.parametrize("kind", KINDS)


def settled(record, jumps=(), testbed=None):
    """Return the optimum with these jumps."""
    params = Params(jumps=tuple(jumps), use_prior=True)
    return settle(problem_of(record, reported() if testbed is None else testbed, params), TRUTH)


def freed(kind, t=EVENT):
    """A jump without a prior."""
    names = KINDS[kind][0]
    return Jump(t, names, ({"impulse": 1.0, "com_step": 1e-3}[kind],) * 3, is_event=True)


TIMES = (5.0, 8.0, 11.0, 15.0, EVENT, 27.0, 31.0, 35.0)
CUTS = [Jump(t, (), ()) for t in TIMES]  # nothing may jump


@every_kind
@pytest.mark.parametrize("t", [11.0, EVENT, 31.0])
def test_surprise_is_what_the_cost_falls_by(kind, t):
    """Where the event was and where nothing was: the cost when the jump is freed, all else too.

    To first order: the surprise is of the local model, which is off by 1 % of it.
    """
    record = noisy(with_event(kind), 1)
    plain, free = settled(record, CUTS), settled(record, [freed(kind, t)])
    test, k = disturbances(smooth_at(plain), KINDS[kind][1]), TIMES.index(t)
    fell = 2 * (plain.at.cost - free.at.cost)
    assert fell > 5 or t != EVENT
    assert test.surprise[k] == pytest.approx(fell, rel=0.01, abs=0.01)
    off, spread = test.jump[k] - free.jumps[0], np.linalg.inv(test.information[k])
    assert off @ np.linalg.solve(spread, off) < 0.05**2
    found = smooth_at(free).jump_covariance[0]
    unit = 1 / np.sqrt(np.diag(spread))
    np.testing.assert_allclose(
        found * np.outer(unit, unit), spread * np.outer(unit, unit), atol=0.01
    )


@every_kind
def test_the_event_surprises_most_where_it_was(kind):
    """Of eight cuts, by three times the size."""
    test = disturbances(smooth_at(settled(noisy(with_event(kind, 3.0), 2), CUTS)), KINDS[kind][1])
    assert TIMES[int(np.argmax(test.surprise))] == EVENT


# --- Several seeds --------------------------------------------------------------------------------

SEEDS = 200


@pytest.fixture(scope="module")
def calm():
    """Surprises (seed, cut) of records in which nothing happens, for each kind."""
    clean, found = eventful(), {kind: [] for kind in KINDS}
    for seed in range(SEEDS):
        testbed = reported(np.random.default_rng(1000 + seed))
        after = smooth_at(settled(noisy(clean, seed), CUTS, testbed))
        for kind, (_, coordinates, _) in KINDS.items():
            found[kind].append(disturbances(after, coordinates).surprise)
    return {kind: np.array(rows) for kind, rows in found.items()}


@every_kind
def test_surprise_by_chance_is_chi_square_of_three(calm, kind):
    """Each cut over the seeds: Kolmogorov and Smirnov at 0.1 %; the mean over all cuts is 3."""
    surprise = calm[kind]
    for k in range(len(TIMES)):
        assert kstest(surprise[:, k], chi2(3).cdf).pvalue > 1e-3
    by_seed = surprise.mean(axis=1)  # cuts of one record are alike, records are not
    assert abs(by_seed.mean() - 3) < 3 * by_seed.std(ddof=1) / np.sqrt(SEEDS)
    assert by_seed.std(ddof=1) / np.sqrt(SEEDS) < 0.2


@every_kind
def test_an_event_is_recovered_within_its_sd(kind):
    """Ten seeds, ten times the size: the errors in units of their covariance are chi-square."""
    clean, total = with_event(kind, 10.0), 0.0
    for seed in range(10):
        testbed = reported(np.random.default_rng(2000 + seed))
        found = settled(noisy(clean, 100 + seed), [freed(kind)], testbed)
        assert found.converged
        off, spread = found.jumps[0] - 10 * KINDS[kind][2], smooth_at(found).jump_covariance[0]
        total += off @ np.linalg.solve(spread, off)
        # and it is plainly there
        assert found.jumps[0] @ np.linalg.solve(spread, found.jumps[0]) > 50
    assert chi2.ppf(1e-3, 30) < total < chi2.isf(1e-3, 30)
