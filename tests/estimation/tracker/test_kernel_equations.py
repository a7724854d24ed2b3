"""Each equation of the tracker's step beside plain NumPy, or a number computed by hand."""

import numpy as np
import pytest

from equipoise.dynamics.sensitivities import LANES
from equipoise.estimation.tracker import contact_test as contacts
from equipoise.estimation.tracker import event_signatures as onsets
from equipoise.estimation.tracker import mixture
from equipoise.estimation.tracker import predict_correct as steps
from equipoise.estimation.tracker import stored_covariance as stored
from equipoise.estimation.tracker.event_signatures import MANY, ONSETS, new_watch
from equipoise.estimation.tracker.kernel_records import new_tools
from equipoise.estimation.tracker.measurement_update import take_anew
from equipoise.estimation.tracker.measurements import Rows
from equipoise.estimation.tracker.noise_level import learn_noise
from equipoise.estimation.tracker.stored_covariance import DRIFT, SIZE, WARM_ROW
from equipoise.maths.attitude import exponential

sensors = pytest.mark.parametrize(("first", "second"), [(0, -1), (3, 15)], ids=["camera", "gyro"])

LAPSE = 0.2  # s


def covariance(seed: int, size: int = SIZE) -> np.ndarray:
    root = np.random.default_rng(seed).normal(size=(size, size))
    return root @ root.T


def pick(first: int, second: int) -> np.ndarray:
    H = np.zeros((3, SIZE))
    H[range(3), range(first, first + 3)] = 1.0
    if second >= 0:
        H[range(3), range(second, second + 3)] = 1.0
    return H


def transition(seed: int) -> tuple[np.ndarray, np.ndarray]:
    """The (6, 15) block, and the (24, 24) matrix that it stands for."""
    phi, full = np.random.default_rng(seed).normal(size=(6, 15)) / 4, np.eye(SIZE)
    full[:6, :15] = phi
    return phi, full


def drift_over(dt: float) -> np.ndarray:
    """F of r' = v over a time (s)."""
    F = np.eye(SIZE)
    F[range(6, 9), range(DRIFT, DRIFT + 3)] = dt
    return F


def rows_of_16(phi: np.ndarray) -> np.ndarray:
    """Phi as the kernels keep it."""
    return np.pad(phi, ((0, 0), (0, LANES - 15))).ravel()


def table(flat: np.ndarray, rows: int) -> np.ndarray:
    """What the kernels keep row by row, the filling left out."""
    return flat.reshape(rows, -1)[:, :SIZE]


def holding(P: np.ndarray, biased: bool = True):
    """Tools that hold a covariance; below its diagonal nothing that counts."""
    work = new_tools(biased, SIZE).work
    stored.take(np.triu(P) + np.tril(np.full((SIZE, SIZE), 7.0), -1), work.P)
    return work


def held(work) -> np.ndarray:
    P = np.zeros((SIZE, SIZE))
    stored.give(work.P, P)
    return P


def packed(six: np.ndarray) -> np.ndarray:
    xx, yy, zz, xy, xz, yz = six
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def test_covariance_is_predicted_as_phi_p_phi_transposed_and_noise():
    """Torque noise of 2 N m sqrt(s) on 4 kg m^2 for 0.1 s: (2 / 4)^2 0.1 = 0.025 on a rate."""
    phi, full = transition(1)
    P, noise = covariance(2), np.zeros(SIZE)
    noise[3:6] = 2.0
    expected = full @ P @ full.T + np.diag([0.0] * 3 + [0.025] * 3 + [0.0] * (SIZE - 6))
    work, inertia = holding(P), (4.0, 4.0, 4.0, 0.0, 0.0, 0.0)
    steps.predict_covariance(inertia, rows_of_16(phi), noise, 0.1, work)
    np.testing.assert_allclose(held(work), expected, rtol=0, atol=1e-12)


@sensors
def test_a_row_corrects_as_kalman_says(first, second):
    """K = P H^T S^-1, x = K z, P+ = (E - K H) P, symmetric to the last digit."""
    P, H, z = covariance(3), pick(first, second), (0.3, -0.2, 0.5)
    work = holding(P)
    S = H @ P @ H.T + 0.7 * np.eye(3)
    K = P @ H.T @ np.linalg.inv(S)
    expected = P - K @ H @ P
    steps.expect(first, second, 0.7, work)
    surprise = steps.weigh(z, work)
    steps.shrink(first, second, 0.7, work)
    assert surprise == pytest.approx(np.array(z) @ np.linalg.solve(S, z))
    np.testing.assert_allclose(work.x[:SIZE], K @ z, atol=1e-12)
    np.testing.assert_allclose(held(work), expected, rtol=0, atol=1e-12)


def test_where_the_bias_is_alone_its_block_is_passed_over():
    """A camera's row and a prediction: as with all of it; bias and drift keep their variance."""
    phi, full = transition(1)
    P, H = covariance(3), pick(0, -1)
    P[:15, 15:] = P[15:, :15] = 0.0
    work = holding(P, biased=False)
    still, stiff = np.zeros(SIZE), (1.0, 1.0, 1.0, 0.0, 0.0, 0.0)
    steps.predict_covariance(stiff, rows_of_16(phi), still, 0.1, work)
    P = full @ P @ full.T
    np.testing.assert_allclose(held(work), P, rtol=0, atol=1e-12)
    steps.expect(0, -1, 0.7, work)
    steps.weigh((0.3, -0.2, 0.5), work)
    steps.shrink(0, -1, 0.7, work)
    S = H @ P @ H.T + 0.7 * np.eye(3)
    expected = P - P @ H.T @ np.linalg.solve(S, H @ P)
    np.testing.assert_allclose(held(work), expected, rtol=0, atol=1e-12)


def test_a_covariance_whose_bias_has_to_do_with_the_rest_says_so():
    P = np.diag(np.r_[np.arange(1.0, 19.0), 0.0, 0.0, 0.0, 22.0, 23.0, 24.0])
    assert not stored.coupled(P)
    P[4, 16] = P[16, 4] = 1e-30
    assert stored.coupled(P)


@pytest.mark.parametrize("first", [DRIFT, WARM_ROW], ids=["drift", "warmth"])
def test_the_centre_of_mass_is_carried_on_as_its_rate_says(first):
    """r of (7, 8, 9), at (19, 20, 21) or (22, 23, 24) of it for 0.5; P as F P F^T."""
    P, end, F = covariance(12), np.arange(1.0 + SIZE), np.eye(SIZE)
    F[range(6, 9), range(first, first + 3)] = 0.5
    work, expected = holding(P), end.copy()
    expected[7:10] += 0.5 * np.arange(first + 1.0, first + 4.0)
    steps.carry(first, 0.5, end, work.P)
    np.testing.assert_allclose(held(work), F @ P @ F.T, rtol=0, atol=1e-12)
    np.testing.assert_allclose(end, expected)


def test_a_centre_of_mass_that_cannot_drift_stays():
    P, end = covariance(13), np.arange(1.0 + SIZE)
    work = holding(P)
    assert stored.drifts(work.P)
    P[DRIFT:] = P[:, DRIFT:] = 0.0
    assert not stored.drifts(holding(P).P)
    work = holding(P)
    steps.carry(DRIFT, 0.0, end, work.P)
    np.testing.assert_array_equal(held(work), P)
    np.testing.assert_array_equal(end, np.arange(1.0 + SIZE))


def test_where_there_may_be_a_drift_the_second_block_is_in_use():
    P = np.zeros((SIZE, SIZE))
    assert not stored.coupled(P)
    P[DRIFT + 2, DRIFT + 2] = 1e-30
    assert stored.coupled(P)


def test_a_gain_that_is_a_little_wrong_costs_the_second_order():
    """What Joseph's form is for: with K + D, P+ = (E - K H) P + D S D^T, D being 1e-3 of K."""
    P, H = covariance(4), pick(0, -1)
    work = holding(P)
    S = H @ P @ H.T + 0.7 * np.eye(3)
    best = P - P @ H.T @ np.linalg.solve(S, H @ P)
    steps.expect(0, -1, 0.7, work)
    steps.weigh((0.0, 0.0, 0.0), work)
    off = 1e-3 * table(work.K, 3)
    work.K[:] *= 1.001
    steps.shrink(0, -1, 0.7, work)
    bent = held(work) - best
    np.testing.assert_allclose(bent, off.T @ S @ off, rtol=0, atol=1e-13 * np.abs(best).max())


@sensors
def test_signature_is_what_two_filters_differ_by(first, second):
    """One of the two has a rate that jumped by v, the other an r that stepped: linear, so exact."""
    rng, watch, tools = np.random.default_rng(5), new_watch(), new_tools(True, SIZE)
    P, H, v = covariance(6), pick(first, second), np.array([0.3, -0.2, 0.1])
    onsets.take_up(watch, 7.0)
    off = {0: np.zeros(SIZE), ONSETS: np.zeros(SIZE)}  # truth minus filter, by the hypothesis
    off[0][3:6], off[ONSETS][6:9] = v, v
    C, d = ({h: np.zeros(s) for h in off} for s in ((3, 3), 3))
    stored.take(P, tools.work.P)
    for k in range(4):
        phi, full = transition(10 + k)
        z = rng.normal(size=3)
        steps.expect(first, second, 0.7, tools.work)
        steps.weigh(tuple(z), tools.work)
        onsets.follow(watch, rows_of_16(phi), 0.0, LAPSE, tools.room)
        onsets.response(watch, first, second, tools.room)
        onsets.gather(watch, tuple(z), tools.work, tools.room)
        onsets.respond(watch, tools.work, tools.room)
        S, K = tools.work.S.copy(), table(tools.work.K, 3).T
        for h in off:
            off[h] = drift_over(LAPSE) @ full @ off[h]
            G = tools.room.G.reshape(3, -1)[:, [h, MANY + h, 2 * MANY + h]]
            np.testing.assert_allclose(G @ v, H @ off[h], atol=1e-12)
            off[h] -= K @ H @ off[h]
            C[h] += G.T @ np.linalg.solve(S, G)
            d[h] += G.T @ np.linalg.solve(S, z)
    for h in off:
        np.testing.assert_allclose(columns(watch, h) @ v, off[h], atol=1e-12)
        np.testing.assert_allclose(packed(of(watch.C, h)), C[h], atol=1e-12)
        np.testing.assert_allclose(of(watch.d, h), d[h], atol=1e-12)
    assert watch.since[0] == 7.0


def some_watch():
    """Onsets 30, 12 and 5 rows old, all their sums and signatures at random."""
    rng, watch, room = np.random.default_rng(8), new_watch(), new_tools(True, SIZE).room
    for h in range(MANY):
        C = covariance(20 + h, 3)
        of(watch.C, h)[:] = 1e3 * C[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
    watch.d[:] = 30.0 * rng.normal(size=watch.d.shape)
    watch.X[:] = rng.normal(size=watch.X.shape)
    watch.counts[onsets.COUNT] = 3
    watch.order[:3], watch.age[:3] = [0, 1, 2], [30, 12, 5]
    contacts.explain(watch, room)
    return watch, room


def columns(watch, h: int) -> np.ndarray:
    return watch.X.reshape(SIZE, -1)[:, [h, MANY + h, 2 * MANY + h]]


def of(flat: np.ndarray, h: int) -> np.ndarray:
    """What a hypothesis has in rows of 24."""
    return flat.reshape(-1, MANY)[:, h]


def test_a_hypothesis_explains_what_least_squares_says():
    """V = (C + L)^-1, v = V d, l = d^T V d; L is 1 / 0.1^2 for jumps, 1 / 1e-4^2 for steps."""
    watch, room = some_watch()
    for h, prior in ((1, 1e2), (ONSETS + 2, 1e8)):
        V, d = np.linalg.inv(packed(of(watch.C, h)) + prior * np.eye(3)), of(watch.d, h)
        np.testing.assert_allclose(packed(of(room.V, h)), V, rtol=1e-6)
        np.testing.assert_allclose(of(room.v, h), V @ d, rtol=1e-6)
        assert room.gain[h] == pytest.approx(d @ V @ d)


def test_hypotheses_weigh_by_what_they_explain_and_by_the_rows_they_stand_for():
    """l = 20, 24, 16 and rows 1, 18, 7 for jumps, nothing for steps: e^((l - 24) / 4) x rows."""
    watch, room = some_watch()
    room.gain[:] = -1e3
    room.gain[:3] = [20.0, 24.0, 16.0]
    weights = np.array([np.exp(-1.0), 18.0, 7.0 * np.exp(-2.0)])
    assert contacts.weigh_up(watch, 24.0, room) == pytest.approx(1.0)
    np.testing.assert_allclose(room.p[:3], weights / weights.sum())


def test_a_contact_leaves_the_mixture_of_its_hypotheses():
    """Mean sum p X v; spread of X v about it, X V X^T, half a gap between onsets, a tenth of it."""
    watch, room = some_watch()
    room.p[:] = 0.0
    weights = {0: 0.1, 1: 0.4, 2: 0.2, ONSETS: 0.1, ONSETS + 1: 0.15, ONSETS + 2: 0.05}
    for h, p in weights.items():
        room.p[h] = p
    effects = {h: columns(watch, h) @ of(room.v, h) for h in weights}
    mean = sum(p * effects[h] for h, p in weights.items())
    P, x = covariance(9), np.zeros(SIZE)
    expected = P + 0.01 * np.outer(mean, mean)
    for h, p in weights.items():
        X = columns(watch, h)
        expected += p * (X @ packed(of(room.V, h)) @ X.T)
        expected += p * np.outer(effects[h] - mean, effects[h] - mean)
        if h not in (0, ONSETS):  # the oldest has none older
            separation = columns(watch, h - 1) @ of(room.v, h) - effects[h]
            expected += p / 12 * np.outer(separation, separation)
    mixture.mend(watch, P, x, room)
    np.testing.assert_allclose(x, mean, rtol=1e-9)
    np.testing.assert_allclose(P, expected, rtol=1e-9)


def test_an_event_reports_mean_and_spread_of_its_hypotheses():
    """v = 1 and 3, each p = 1/2, V = 0.04: mean 2, variance 0.04 + 1.01 x 5 - 4 = 1.09."""
    watch, room = some_watch()
    room.p[:], room.v[:], room.V[:] = 0.0, 0.0, 0.04
    room.p[1], room.p[2] = 0.5, 0.5
    of(room.v, 1)[:], of(room.v, 2)[:] = 1.0, 3.0
    out = np.ones(mixture.EVENT)
    mixture.report(watch, contacts.JUMP, 1, room, out)
    np.testing.assert_allclose(out[3:6], 2.0)
    np.testing.assert_allclose(out[6:9], np.sqrt(1.09))
    np.testing.assert_array_equal(out[9:], 0.0)


def test_an_attitude_taken_anew_brings_its_rate():
    """0.02 rad about y in 0.2 s: 0.1 rad/s; sd 2 x 1e-3 / 0.2 + 0.1 x 0.1 = 0.02."""
    q = exponential(np.array([[0.0, 0.0, 0.0], [0.0, 0.02, 0.0]]))
    rows = Rows(
        np.array([0.0, 0.2, 0.4]), np.zeros((3, 7)), np.zeros(0, np.int64), q, np.array([1, 2]),
        np.zeros((0, 3)), np.zeros(0, np.int64), np.zeros(0, np.int64), np.zeros((0, 3, 3)),
    )  # fmt: skip
    P, body, end = covariance(11), np.s_[6:, 6:], np.arange(1.0 + SIZE)
    work = holding(P)
    take_anew(rows, 1, 1e-3, end, work.P)
    np.testing.assert_allclose(end[:4], q[1])
    np.testing.assert_allclose(end[4:7], [0.0, 0.1, 0.0], atol=1e-12)
    np.testing.assert_array_equal(end[7:], np.arange(7.0, 1.0 + SIZE))
    left = np.zeros((SIZE, SIZE))
    left[body] = P[body]
    left[np.diag_indices(6)] = [1e-6] * 3 + [4e-4] * 3
    np.testing.assert_allclose(held(work), left, rtol=1e-9, atol=1e-15)


def test_noise_is_learnt_from_rows_that_are_mostly_noise():
    """First row, gain 2/40: d2 = 6 makes k = 1 + 0.05 (2 - 0.9788) = 1.05106; d2 = 0: 0.95106."""
    for surprise, share, expected in ((6.0, 0.9, 1.05106), (0.0, 0.9, 0.95106), (6.0, 0.4, 1.0)):
        level = np.array([1.0, 0.0])
        learn_noise(level, surprise, share)
        assert level[0] == pytest.approx(expected, abs=1e-5)
        assert level[1] == (1.0 if share > 0.5 else 0.0)
    odd, odder = np.array([1.0, 0.0]), np.array([1.0, 0.0])
    learn_noise(odd, 9.0, 1.0)
    learn_noise(odder, 900.0, 1.0)
    np.testing.assert_array_equal(odd, odder)
