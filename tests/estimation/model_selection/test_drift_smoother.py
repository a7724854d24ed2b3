"""The smoother follows a centre of mass that wanders, and ends where a filter does."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from equipoise.estimation.events.record_model import evidence
from equipoise.estimation.method_contract import Options
from equipoise.estimation.methods.registry import METHODS
from equipoise.estimation.model_selection import drift_smoother
from equipoise.estimation.output_error.drift_intensity import (
    DECADES,
    improbability_of,
    linear_at,
    mean_size,
)
from equipoise.estimation.output_error.drift_scale import disbelieved, pull, scale_row, untied
from equipoise.estimation.output_error.kernels.gauss_newton import model_at
from equipoise.estimation.output_error.kernels.segments import STATE, chain_for, follow
from equipoise.estimation.output_error.solution import settle, smooth_at
from equipoise.estimation.output_error.trajectory import Params, fit
from equipoise.estimation.parameters.fit_parameters import JP, R, unknowns_of
from equipoise.estimation.tracker import tracker
from equipoise.maths.attitude import exponential, multiply
from equipoise.maths.scaled_solve import scaled_solve
from equipoise.model.estimate import COM as NAMES
from equipoise.model.estimate import END as NAMES_END
from equipoise.model.recording import Recording, Samples
from tests.support import thorough
from tests.support.builders import COM, INERTIA, level, move_at, noisy, platform, recording
from tests.support.drift_records import com_at, ramp, random_walk, wandered
from tests.support.outcomes import codes_of

END = 120.0
SEEDS = thorough.count(8, 4)
CHANCE = np.sqrt(8 / SEEDS)  # by which bands are wider than those of eight seeds
TRACK = move_at(60.0, END)
BED = platform(gyro=True)
run = METHODS["smoother"].run


@cache
def calm(camera=5.0, gyro=20.0, seed=3):
    return noisy(recording(END, TRACK, camera, gyro), seed)


@cache
def uneasy(size, seed):
    """A walk of this size (m/sqrt(s)) and a record of it."""
    way = random_walk(seed, size, END)
    return way, noisy(wandered(way, TRACK), 100 + seed)


def errors(way, course):
    """Errors of r along a course in its stated sd."""
    return (course.values - com_at(way, course.t)) / course.sd


def test_nothing_wanders_in_the_builders_own_record():
    """Piece by piece is the same motion, to 1e-10."""
    whole, pieces = recording(40.0, move_at(20.0, 40.0), 5.0, 20.0), np.zeros((161, 3))
    found = wandered(pieces, move_at(20.0, 40.0))
    np.testing.assert_allclose(found.attitude.values, whole.attitude.values, atol=1e-10)
    np.testing.assert_allclose(found.rate.values, whole.rate.values, atol=1e-10)


# --- Without drift --------------------------------------------------------------------------------


@pytest.mark.parametrize("gyro", [0.0, 20.0], ids=["camera", "camera and gyro"])
def test_without_drift_it_is_the_trajectory_fit(gyro):
    """Inertia and com within 0.4 of its sd, intervals less than twice as wide; no drift found."""
    bed, record = platform(gyro=gyro > 0), calm(5.0, gyro)
    found, plain = run(record, bed, Options()), METHODS["trajectory"].run(record, bed, Options())
    assert codes_of(found)[-1] == "no_drift"
    for p in found.parameters[:9]:
        other = plain.parameters[plain.index(p.name)]
        assert abs(p.value - other.value) < 0.4 * other.sd
        assert 0.95 < p.sd / other.sd < 2


def test_without_drift_its_intervals_cover():
    """Some seeds: every com and inertia within 4 sd, and the mean square near 1."""
    z = []
    for seed in range(SEEDS):
        found = run(calm(seed=seed), BED, Options())
        z.append((found.values(tuple(p.name for p in found.parameters[:9]))
                  - np.append(COM, INERTIA)) / [p.sd for p in found.parameters[:9]])  # fmt: skip
    assert np.abs(z).max() < 4
    assert 0.3 < np.mean(np.square(z)) < 2.0


# --- With drift -----------------------------------------------------------------------------------


@pytest.mark.parametrize("size", thorough.some([1e-7, 1e-8, 3e-8, 1e-6], 1))
def test_the_band_covers_a_walk(size):
    """Some seeds: mean square near 1 in stated sd, over nine tenths within 1.96 sd."""
    z = []
    for seed in range(SEEDS):
        way, record = uneasy(size, seed)
        found = run(record, BED, Options())
        assert found.outcome.usable
        assert codes_of(found)[-1] == "drifts"
        z.append(errors(way, found.course))
    assert 1 - 0.6 * CHANCE < np.mean(np.square(z)) < 1 + 0.8 * CHANCE
    assert np.mean(np.abs(z) < 1.96) > 1 - 0.15 * CHANCE


def test_the_band_covers_a_walk_along_one_axis():
    """The other axes stay as narrow as if nothing drifted, to 1.5 times."""
    size, z = np.array([0.0, 3e-8, 0.0]), []
    still = run(calm(), BED, Options()).course.sd.mean(axis=0)
    for seed in range(thorough.count(6, 2)):
        way = random_walk(seed, size, END)
        found = run(noisy(wandered(way, TRACK), seed), BED, Options()).course
        z.append((found.values - com_at(way, found.t)) / found.sd)
        assert found.sd[:, 1].mean() > 3 * still[1]
        assert found.sd[:, 0].mean() < 3 * still[0]
    assert 0.3 < np.mean(np.square(z)) < 1.8


def test_the_size_of_the_walk_is_found():
    """A fifth and ten times what is expected: to a factor of 1.6 in x and y, over the seeds."""
    for size in thorough.some((1e-8, 5e-7), 1):
        found = [
            drift_smoother.drifting(uneasy(size, seed)[1], BED, Params())
            for seed in range(thorough.count(5, 3))
        ]
        step = np.exp(np.mean([np.log(each.sd[:2]) for each in found]))
        assert step / np.sqrt(0.5) == pytest.approx(size, rel=0.6)


def test_a_ramp_is_followed_from_end_to_end():
    """2 nm/s in x and y for two minutes, with a level camera: how far it went, within 3.5 sd."""
    for seed in range(thorough.count(4, 2)):
        way = ramp(np.array([5e-9, -3e-9, 0.0]), END)
        found = drift_smoother.drifting(noisy(wandered(way, TRACK), seed), level(BED), Params())
        moved, sd = drift_smoother.moved(found, smooth_at(found.fitted))
        assert np.all(np.abs(moved - way[-1]) < 3.5 * sd)
        assert moved[0] > 3 * sd[0]


def test_it_is_narrower_than_the_tracker():
    """Given the same walk: everywhere but at the end, where both have had all rows."""
    _, record = uneasy(1e-7, 2)
    known = replace(level(BED), inertia_sd=1e-3, com_sd=np.full(3, 1e-5))
    fitted, nodes = walked(record, known, 1e-7)
    after = smooth_at(fitted)
    sd = np.sqrt(np.einsum("kii->ki", after.covariance[:, R, R]))
    first = tracker.first_state(0.0, record.attitude.values[0], known)
    reported = tracker.Params(com_walk=1e-7, torque_walk=1e-12, bias_walk=1e-15)
    track = tracker.track(record, known, reported, first)
    beside = np.array([np.interp(nodes, track.t, column) for column in track.com_sd.T]).T
    inner = (nodes > 2) & (nodes < END - 10)
    assert np.all(sd[inner] < 1.02 * beside[inner])
    assert np.mean(sd[inner][:, :2] / beside[inner][:, :2]) < 0.8
    # and the ends agree, and are as sure
    r = unknowns_of(after.points[-1]).com
    assert np.all(np.abs(r - track.com[-1]) < 0.5 * track.com_sd[-1])
    np.testing.assert_allclose(sd[-1], track.com_sd[-1], rtol=0.15)


def walked(record, testbed, size):
    """The fit with a walk of a given size (m/sqrt(s)), and its nodes."""
    nodes = drift_smoother.node_times(record)
    sd = np.full(3, size * np.sqrt(nodes[1] - nodes[0]))
    params = Params(jumps=drift_smoother.walking(nodes, NAMES, sd), use_prior=True)
    return fit(record, testbed, params), nodes


# --- Its last point is the filter -----------------------------------------------------------------


def inverse(P):
    """Scaled to unit diagonal first."""
    scale = 1 / np.sqrt(np.diag(P))
    return np.linalg.inv(P * np.outer(scale, scale)) * np.outer(scale, scale)


def filtered(problem, at, prior, x):
    """Mean and covariance of the last stretch's unknowns by a forward filter, plain NumPy.

    Rows of a stretch are taken in as information; between stretches all goes on by F, and com gets
    the variance of the jump, whose mean is what takes the jump back that is in the point.
    """
    P, p = np.diag(prior.weight), prior.weight * (prior.mean - x)
    for k, normal in enumerate(at.pieces.normal):
        P, p = P + normal, p + at.pieces.descent[k]
        C = inverse(P)
        mean = C @ p
        if k == len(problem.cuts.free):
            break
        F = np.eye(len(x))
        F[:STATE] = at.pieces.onward[k]
        free = problem.cuts.free[k]
        mean, C = F @ mean, F @ C @ F.T
        mean[free] -= at.pieces.jumps[k]
        C[free, free] += 1 / problem.cuts.weight[k]
        P = inverse(C)
        p = P @ mean
    return mean, C


def smoothed_last(problem, at):
    """The last stretch's step of the elimination that a fit goes by."""
    n = len(problem.slots)
    chain, x = chain_for(problem.cuts, n), np.zeros(n)
    model_at(problem, at, 0.0, x, chain)
    step = scaled_solve(chain.normal, chain.descent, 0.0)
    follow(problem.cuts, at.pieces, step, chain, np.zeros_like(at.pieces.jumps))
    return chain.ahead.copy(), x


def test_the_last_smoothed_point_equals_the_filter_posterior():
    """On the same linear pieces, away from the optimum: means to 1e-6 sd, and covariances."""
    _, record = uneasy(1e-7, 1)
    fitted, _ = walked(record, replace(BED, inertia_sd=1e-3), 1e-7)
    problem, at = linear_at(settle(fitted.problem, fitted.point, most=1))
    last, x = smoothed_last(problem, at)
    mean, C = filtered(problem, at, fitted.problem.prior, x)
    sd = np.sqrt(np.diag(C))
    assert np.abs(mean[R] / sd[R]).max() > 2  # all of the walk is still to be found
    np.testing.assert_allclose(last / sd, mean / sd, rtol=0, atol=1e-6)
    problem, at = linear_at(fitted)
    mean, C = filtered(problem, at, fitted.problem.prior, x)
    unit = 1 / np.sqrt(np.diag(C))
    found = smooth_at(fitted).covariance[-1]
    np.testing.assert_allclose(found * np.outer(unit, unit), C * np.outer(unit, unit), atol=1e-6)


# --- The size of the walk -------------------------------------------------------------------------


SHORT = noisy(wandered(random_walk(0, 1e-6, 10.0), move_at(2.0, 10.0)), 1)


def few():
    """A fit of a short record with twenty jumps."""
    return walked(SHORT, replace(BED, inertia_sd=1e-3), 1e-6)[0]


def dense(fitted, sd):
    """A, b of [first stretch | every jump] for steps of these sd (m), and the jumps as they are."""
    problem, at = linear_at(fitted)
    prior, k, n = fitted.problem.prior, len(fitted.jumps), len(problem.slots)
    _, x = smoothed_last(problem, at)
    here, size = np.eye(n, n + 3 * k), n + 3 * k
    A, b = np.zeros((size, size)), np.zeros(size)
    A[:n, :n], b[:n] = np.diag(prior.weight), prior.weight * (prior.mean - x)
    for i in range(k + 1):
        A += here.T @ at.pieces.normal[i] @ here
        b += here.T @ at.pieces.descent[i]
        if i < k:
            F = np.eye(n)
            F[:STATE] = at.pieces.onward[i]
            here = F @ here
            here[R, n + 3 * i : n + 3 * i + 3] += np.eye(3)
    u, weight = at.pieces.jumps.ravel(), np.tile(sd**-2.0, k)
    A[range(n, size), range(n, size)] += weight
    b[n:] -= weight * u
    return A, b, u, weight


def test_improbability_is_that_of_normal_rows():
    """Against one dense matrix of the first stretch and all jumps: between any two sizes, to 1e-6.

    -2 ln p, z = [first | jumps]: least of (z A z - 2 b z) + ln det A + ln det of the jumps' sd^2.
    """
    fitted = few()
    problem, at = linear_at(fitted)

    def densely(sd):
        A, b, u, weight = dense(fitted, sd)
        scale = 1 / np.sqrt(np.diag(A))
        unit = A * np.outer(scale, scale)
        fell = (scale * b) @ np.linalg.solve(unit, scale * b)
        log_det = np.linalg.slogdet(unit)[1] - 2 * np.sum(np.log(scale))
        return weight @ u**2 - fell + log_det - np.sum(np.log(weight))

    sizes = [np.array(sd) for sd in ([1e-6] * 3, [1e-8, 1e-6, 3e-6], [2e-6, 5e-7, 1e-5])]
    ours = np.array([improbability_of(problem, at, sd) for sd in sizes])
    theirs = np.array([densely(sd) for sd in sizes])
    np.testing.assert_allclose(np.diff(ours), np.diff(theirs), rtol=1e-6)


def test_the_total_drift_is_the_sum_of_all_jumps():
    """And so is its sd, by the inverse of the same dense matrix, to 1e-5."""
    fitted, nodes = walked(SHORT, replace(BED, inertia_sd=1e-3), 1e-6)
    sd = np.array(fitted.problem.jumps[0].sd)
    C = inverse(dense(fitted, sd)[0])[-3 * len(fitted.jumps) :, -3 * len(fitted.jumps) :]
    total = np.tile(np.eye(3), len(fitted.jumps))
    found = drift_smoother.Drifting(fitted, nodes, NAMES, sd, fitted.problem.prior, 0.0)
    way, spread = drift_smoother.moved(found, smooth_at(fitted))
    np.testing.assert_allclose(way, fitted.jumps.sum(axis=0), rtol=1e-6)
    np.testing.assert_allclose(spread, np.sqrt(np.diag(total @ C @ total.T)), rtol=1e-5)


def test_improbability_agrees_with_the_survey():
    """Fitted anew with another size, what ``evidence`` says changes by the same, to 1 %."""
    fitted = few()
    problem, at = linear_at(fitted)
    sd = np.array(fitted.problem.jumps[0].sd)
    other = tuple(jump._replace(sd=tuple(3 * sd)) for jump in fitted.problem.jumps)
    again = settle(replace(fitted.problem, jumps=other), fitted.point, fitted.jumps)
    theirs = evidence(again, smooth_at(again), 0.0) - evidence(fitted, smooth_at(fitted), 0.0)
    ours = improbability_of(problem, at, 3 * sd) - improbability_of(problem, at, sd)
    assert abs(theirs) > 1
    assert ours == pytest.approx(theirs, rel=0.01)


def test_the_mean_size_by_hand():
    """Where no row counts, half of all is none; where one size is certain, that."""
    sizes = 10.0**DECADES
    share = np.exp(-0.5 * DECADES**2)
    expected = 0.5 * share @ sizes**2 / share.sum() + 0.5 * sizes[0] ** 2
    assert mean_size(np.zeros(len(sizes)), sizes) == pytest.approx(np.sqrt(expected))
    assert mean_size(np.full(len(sizes), np.inf), sizes) == pytest.approx(np.sqrt(expected))
    certain = np.where(np.arange(len(sizes)) == 30, 0.0, 1e4)
    assert mean_size(certain, sizes) == pytest.approx(sizes[30])


# --- The scale ------------------------------------------------------------------------------------


def test_the_scale_goes_with_the_moments_about_level_axes():
    """ln c by differences: J times 1 + e. A turn of the up axis counts, too."""
    fitted = few()
    for up in (np.array([0.0, 0.0, 1.0]), np.array([0.6, 0.0, 0.8])):
        row = scale_row(fitted.problem, fitted.point, up)
        six = fitted.point.body(fitted.problem.mass).inertia_P[np.triu_indices(3)]
        packed = six[[0, 3, 5, 1, 2, 4]]
        assert row[JP] @ packed == pytest.approx(1.0)
    row = scale_row(fitted.problem, fitted.point, np.array([0.0, 0.0, 1.0]))
    np.testing.assert_allclose(row[JP] * (packed[0] + packed[1]), [1, 1, 0, 0, 0, 0], atol=1e-12)


def test_jumps_do_not_pull_at_the_scale():
    """Six seeds of a great walk: J is not too small, but within 2 sd on average, nor a plain fit's.

    With the jumps' pull all moments come out many sd too small.
    """
    pulled, free = [], []
    for seed in range(thorough.count(6, 2)):
        _, record = uneasy(1e-6, seed)
        found = run(record, BED, Options())
        sd = np.array([p.sd for p in found.parameters[3:5]])
        free.append((np.array([p.value for p in found.parameters[3:5]]) - INERTIA[:2]) / sd)
        fitted, _ = walked(record, replace(BED, inertia_sd=1.0), 1e-6)
        sd = np.sqrt(np.diag(np.linalg.inv(fitted.at.normal)))[JP][:2]
        J = fitted.point.body(fitted.problem.mass).inertia_P
        pulled.append((np.diag(J)[:2] - INERTIA[:2]) / sd)
    assert np.mean(pulled) < -3
    assert abs(np.mean(free)) < 1.5


def test_scale_information_from_drift_jumps_is_removed():
    """Information along the scale falls by S, and not elsewhere."""
    fitted, up = few(), np.array([0.0, 0.0, 1.0])
    row, S = scale_row(fitted.problem, fitted.point, up), pull(fitted.problem, fitted.jumps)
    jumps = np.array([jump.sd for jump in fitted.problem.jumps])
    assert pytest.approx(np.sum((fitted.jumps / jumps) ** 2)) == S
    before = row @ np.linalg.inv(fitted.at.normal) @ row
    after = row @ np.linalg.inv(disbelieved(fitted, up).at.normal) @ row
    assert 1 / before - 1 / after == pytest.approx(min(S, 0.999 / before), rel=1e-3)


def test_a_held_scale_is_not_pushed():
    """A moment that the user holds, or one that is held for an open scale, stays where it is."""
    fitted, up = few(), np.array([0.0, 0.0, 1.0])
    held = fitted.problem.prior.held.copy()
    held[JP.start] = True
    prior = replace(fitted.problem.prior, held=held)
    for problem in (replace(fitted.problem, prior=prior), replace(fitted.problem, scale_open=True)):
        assert pull(problem, fitted.jumps) == 0.0
    pushed = untied(fitted.problem, fitted.problem.prior, fitted, up).prior
    assert np.all((pushed.mean - fitted.problem.prior.mean)[JP][:2] > 0)


# --- Options and odd records ----------------------------------------------------------------------


def test_it_is_deterministic_and_leaves_its_input_alone():
    record = calm()
    before = [c.values.copy() for c in (record.attitude, record.rate, record.masses)]
    first, second = (run(record, BED, Options()) for _ in range(2))
    np.testing.assert_array_equal(first.covariance, second.covariance)
    np.testing.assert_array_equal(first.course.values, second.course.values)
    assert first.parameters == second.parameters
    for c, values in zip((record.attitude, record.rate, record.masses), before, strict=True):
        np.testing.assert_array_equal(c.values, values)


def kept(channel, rows):
    return Samples(channel.t[rows], channel.values[rows])


def test_a_gap_and_outliers_are_borne():
    """30 s without rows, and 5 % of the camera's rows off by 1 deg: all within 4 sd, robustly."""
    way, record = uneasy(3e-8, 4)
    camera, rng = record.attitude, np.random.default_rng(9)
    odd = (rng.random(len(camera)) < 0.05)[:, None]
    turn = exponential(np.where(odd, np.radians(1.0) * rng.normal(size=(len(camera), 3)), 0.0))
    camera = Samples(camera.t, multiply(camera.values, turn))
    channels = [kept(c, (c.t < 75) | (c.t > 105)) for c in (camera, record.rate)]
    found = run(Recording(*channels, record.mass_names, TRACK), BED, Options(robust=True))
    z = errors(way, found.course)
    assert found.outcome.usable
    assert np.abs(z).max() < 4
    sd, t = found.course.sd, found.course.t
    assert np.all(sd[t == 90.0] > sd[t == 50.0])


def test_the_course_begins_with_com_and_ends_with_com_end():
    """Values and sd; at the end the masses are away from home by what is commanded."""
    found = run(uneasy(1e-7, 2)[1], BED, Options())
    course, shift = found.course, np.array([-10e-3, -10e-3, -50e-3]) * 0.0156 / 14.24
    first, last = ([p for p in found.parameters if p.name in names] for names in (NAMES, NAMES_END))
    np.testing.assert_allclose([p.value for p in first], course.values[0], rtol=1e-9)
    np.testing.assert_allclose([p.sd for p in first], course.sd[0], rtol=1e-9)
    np.testing.assert_allclose([p.value for p in last], course.values[-1] + shift, rtol=1e-9)
    np.testing.assert_allclose([p.sd for p in last], course.sd[-1], rtol=0.01)
    assert course.names == NAMES
    assert (course.t[0], course.t[-1]) == (0.0, END)


def test_what_is_held_does_not_wander():
    """com_x stays where the testbed has it; y and z have a course."""
    found = run(uneasy(1e-7, 2)[1], BED, Options(hold=("com_x",)))
    np.testing.assert_allclose(found.course.values[:, 0], COM[0], rtol=1e-6)
    assert np.ptp(found.course.values[:, 1]) > 1e-7
    assert found.has("com_end_y")


def test_a_requested_constant_drift_is_part_of_the_course():
    """5 nm/s along x as the term ``drift``: within 4 sd along the record, and it is nearly all."""
    way = ramp(np.array([5e-9, 0.0, 0.0]), END)
    terms = ("drift_x", "drift_y", "drift_z")
    found = run(noisy(wandered(way, TRACK), 5), BED, Options(terms=terms))
    assert np.abs(errors(way, found.course)).max() < 4
    rate = found.parameters[found.index("drift_x")]
    assert abs(rate.value - 5e-9) < 4 * rate.sd
    last = [found.parameters[found.index(name)].sd for name in NAMES_END]
    np.testing.assert_allclose(found.course.sd[-1], last, rtol=0.01)


def test_a_gyro_alone_serves_if_it_serves_the_trajectory_fit():
    """No attitude: an estimate with an outcome, or none, but no error."""
    record = replace(calm(), attitude=None)
    found, plain = run(record, BED, Options()), METHODS["trajectory"].run(record, BED, Options())
    assert found.outcome.usable == plain.outcome.usable


def test_an_open_scale_leaves_the_course_without_a_band():
    """Nothing moves: ratios alone are known."""
    found = run(noisy(recording(60.0, None, 5.0, 20.0), 2), BED, Options())
    assert found.ratios
    assert np.all(np.isinf(found.course.sd))


def test_three_rows_are_refused():
    attitude = kept(calm().attitude, slice(0, 3))
    found = run(Recording(attitude, None, (), None), BED, Options())
    assert not found.outcome.usable
    assert found.parameters == ()


def test_nodes_are_even_and_the_walk_changes_half_way_between():
    """120 s in halves of a second; no more than 300 of them."""
    nodes = drift_smoother.node_times(calm())
    np.testing.assert_allclose(nodes, 0.5 * np.arange(241))
    jumps = drift_smoother.walking(nodes, NAMES, np.ones(3))
    assert [jump.t for jump in jumps[:2]] == [0.25, 0.75]
    long = replace(calm(), rate=Samples(np.array([0.0, 600.0]), np.zeros((2, 3))))
    assert len(drift_smoother.node_times(long)) == 301
