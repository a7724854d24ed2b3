"""What happened to a platform, found in its record: touches and slips in units of their sd.

Records are made by the propagator alone, in two pieces.
"""

from dataclasses import replace

import numpy as np
import pytest
from builders import (
    ATTITUDE,
    COM,
    GRAVITY,
    INERTIA,
    MASS,
    line_of,
    move_at,
    noisy,
    platform,
    travel,
)
from builders import RATE as START
from scipy.stats import chi2, kstest

from equipoise.dynamics.propagation import body_of
from equipoise.estimation.disturbances import disturbances
from equipoise.estimation.fitted import settle, smooth_at
from equipoise.estimation.jumps import RATE as RATES
from equipoise.estimation.jumps import Jump
from equipoise.estimation.trajectory import Params, problem_of
from equipoise.estimation.unknowns import RATE, R, Unknowns
from equipoise.maths.linalg import element_sizes, unpack_symmetric
from equipoise.maths.pseudo_inertia import from_inertia
from equipoise.model.estimate import COM as COM_NAMES
from equipoise.model.mass_properties import MassProperties, parallel_axis
from equipoise.model.recording import Recording, Samples

END, EVENT = 40.0, 22.03  # s
TRACK = move_at(8.0, END)
INERTIA_SD, COM_SD = 1e-3, 1e-5  # relative, m: bodies that cannot exist are 7 sd away
# names, coordinates, and a size of some sd
KINDS = {
    "impulse": (RATES, RATE, np.array([6e-5, -9e-5, 5e-5])),  # rad/s
    "com_step": (COM_NAMES, R, np.array([5e-8, -4e-8, 6e-8])),  # m
}
every_kind = pytest.mark.parametrize("kind", KINDS)


def told(rng=None):
    """The platform as it is, or as somebody knows it who is off by the stated sd."""
    six, com = INERTIA, COM
    if rng is not None:
        size = INERTIA_SD * element_sizes(unpack_symmetric(INERTIA))
        six, com = INERTIA + size * rng.normal(size=6), COM + COM_SD * rng.normal(size=3)
    body = MassProperties(MASS, com, unpack_symmetric(six))
    return replace(platform(gyro=True), body=body, inertia_sd=INERTIA_SD, com_sd=np.full(3, COM_SD))


def eventful(touch=0.0, slip=0.0):
    """A record without noise in which the rate and the centre of mass jump at ``EVENT``."""
    t = np.arange(0, END + 1e-9, 0.05)
    before, after = t[t < EVENT], t[t > EVENT]
    first_line = line_of(np.append(before, EVENT), TRACK)
    first = travel(first_line)
    struck = body_of(MASS, GRAVITY, INERTIA, MASS * (COM + slip))
    line = line_of(np.append(EVENT, after), TRACK)
    second = travel(line, struck, q0=first.q[-1], w0=first.rate[-1] + touch)
    k, m = first_line.attitude_node[:-1], line.attitude_node[1:]
    q, w = np.vstack([first.q[k], second.q[m]]), np.vstack([first.rate[k], second.rate[m]])
    return Recording(Samples(t[::4], q[::4]), Samples(t, w), ("x", "y", "z"), TRACK)


SIX = from_inertia(unpack_symmetric(INERTIA) - parallel_axis(MASS, COM))
TRUTH = Unknowns(ATTITUDE, START, SIX, COM, np.zeros(16), np.zeros(24), np.zeros(0), np.zeros(3))


def settled(record, jumps=(), testbed=None):
    """Return the optimum with these jumps."""
    params = Params(jumps=tuple(jumps), use_prior=True)
    return settle(problem_of(record, told() if testbed is None else testbed, params), TRUTH)


def with_event(kind, share=1.0):
    """A record without noise with an event of one kind."""
    size = share * KINDS[kind][2]
    return eventful(touch=size) if kind == "impulse" else eventful(slip=size)


def freed(kind, t=EVENT):
    """A jump of which nothing is known beforehand."""
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
        testbed = told(np.random.default_rng(1000 + seed))
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
        testbed = told(np.random.default_rng(2000 + seed))
        found = settled(noisy(clean, 100 + seed), [freed(kind)], testbed)
        assert found.converged
        off, spread = found.jumps[0] - 10 * KINDS[kind][2], smooth_at(found).jump_covariance[0]
        total += off @ np.linalg.solve(spread, off)
        # and it is plainly there
        assert found.jumps[0] @ np.linalg.solve(spread, found.jumps[0]) > 50
    assert chi2.ppf(1e-3, 30) < total < chi2.isf(1e-3, 30)
