"""The account of momentum: columns, moves, covariance, and the truth in units of its sd."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.control.elements import momentum_balance as ml
from equipoise.control.elements.attitude_pid import at_rest, gains_for, torque, unwound
from equipoise.control.law import Sample
from equipoise.maths.attitude import exponential, to_matrix
from equipoise.model.command import Command
from equipoise.model.testbed import AIR_TIME
from tests.support.plain_loop import GRAVITY, INERTIA, MASS, Truth, begun, go, platform, sample

NONE = np.zeros(3)
SAG = ("sag_xx", "sag_yy", "sag_xy", "sag_xz", "sag_yz")


def observed_at(q, t=0.0, w=NONE, h=NONE, shift=NONE):
    down = to_matrix(q).T @ np.array([0.0, 0.0, -GRAVITY])
    return Sample(t, q, w, down, shift, h, NONE, NONE, None)


def test_rows_are_the_torques_in_laboratory_axes():
    """By the cross products themselves: m r x g, m s x g and m g (C n) x n."""
    bed = platform(disturbances=SAG)
    q, shift = exponential(np.array([0.2, -0.3, 0.7])), np.array([1e-6, 2e-6, -3e-6])
    rows = ml.rows_at(observed_at(q, shift=shift), ml.book_of(bed), 0.0)
    R, g = to_matrix(q), to_matrix(q).T @ np.array([0, 0, -GRAVITY])
    r, n = np.array([3e-6, -1e-6, 5e-6]), g / GRAVITY
    assert rows[:, :3] @ r == pytest.approx(R @ np.cross(MASS * r, g))
    C = np.array([[2e-6, 1e-6, 3e-6], [1e-6, -4e-6, 5e-6], [3e-6, 5e-6, 2e-6]])
    assert rows[:, 3:8] @ [2e-6, -4e-6, 1e-6, 3e-6, 5e-6] == pytest.approx(
        R @ np.cross(MASS * GRAVITY * C @ n, n)
    )
    assert rows[:, 8] == pytest.approx(R @ np.cross(MASS * shift, g))


def followed(truth, turns, seconds, bed):
    """Hold one attitude after another; return the account and the course."""
    course, rng, pid = begun(bed, truth), np.random.default_rng(truth.seed), unwound()
    book, gains, ledger = ml.book_of(bed), gains_for(INERTIA, 5e-3), None
    for turn in turns:
        for _ in range(round(seconds / 0.1)):
            observed = sample(course, 0.1, rng)
            ledger = (
                ml.opened(bed, book, observed)
                if ledger is None
                else ml.entered(ledger, observed, book)
            )
            pid, u = torque(pid, observed, at_rest(exponential(turn)), gains, NONE)
            go(course, Command(torque=u), 0.1, rng)
    return ledger, course


TURNS = np.radians([[8.0, 0, 0], [-8.0, 0, 0], [0, 8.0, 0], [0, -8.0, 0]])


def com_of(ledger, book):
    """The centre of mass (m) and its covariance (m^2)."""
    G = ml.com_map(ledger, book)
    return G @ ledger.x, G @ ledger.P @ G.T


@pytest.mark.parametrize("seed", range(4))
def test_the_truth_lies_within_the_stated_sd(seed):
    """r of a micrometre, the play of the air, gyro and tachometer noise; J wrong by 3 %."""
    rng = np.random.default_rng(seed)
    truth = Truth(rng.normal(size=3) * 1e-6, play=2e-6, seed=seed, tilt=TURNS[0])
    bed = platform(com_sd=5e-6)
    ledger, course = followed(truth, TURNS, 20.0, bed)
    com, covariance = com_of(ledger, ml.book_of(bed))
    off = com - course.com
    assert off @ np.linalg.solve(covariance, off) < 11.3  # 99 % of chi-square with 3
    assert np.sqrt(np.diag(covariance)).max() < 0.25e-6


def test_covariances_are_honest_over_many_runs():
    """The mean of the normalised square over 12 runs is near 3: within (1.5, 5)."""
    bed, squares = platform(com_sd=5e-6), []
    for seed in range(12):
        truth = Truth(np.array([1e-6, -1e-6, 1e-6]), play=2e-6, seed=seed, tilt=TURNS[0])
        ledger, course = followed(truth, TURNS[:2], 15.0, bed)
        com, covariance = com_of(ledger, ml.book_of(bed))
        off = com - course.com
        squares.append(off @ np.linalg.solve(covariance, off))
    assert 1.2 < np.mean(squares) < 5.0


def test_a_move_adds_the_accuracy_of_the_masses_that_may_have_moved():
    """10 um by coarse steps of 1.43 um: 0.2 kg x 0.1 mm / 14 kg and 0.02 kg x 10 um / 14 kg."""
    bed = platform()
    bed = replace(bed, masses=tuple(replace(m, accuracy=m.resolution) for m in bed.masses))
    book = ml.book_of(bed)
    coarse, fine = 0.2 * 1e-4 / MASS, 0.02 * 1e-5 / MASS
    assert ml.stop_variance(np.array([1e-5, 0, 0]), book) == pytest.approx(coarse**2 + fine**2)
    assert ml.stop_variance(np.array([3e-7, 0, 0]), book) == pytest.approx(fine**2)
    q, still = np.array([1.0, 0, 0, 0]), np.array([1e-5, 0, 0])
    ledger = ml.opened(bed, book, observed_at(q))
    for k, shift in enumerate([0.5 * still, still]):
        ledger = ml.predicted(ledger, observed_at(q, 0.1 * (k + 1), shift=shift), book)
    stands = ml.arrived(ledger, book)  # once for the whole way, not once a sample
    assert np.diag(stands.P - ledger.P)[9:12] == pytest.approx(coarse**2 + fine**2)
    assert ml.arrived(stands, book) is stands


def test_samples_during_mass_travel_are_rejected():
    bed = platform()
    book, q = ml.book_of(bed), np.array([1.0, 0, 0, 0])
    ledger = ml.opened(bed, book, observed_at(q))
    wrong = observed_at(q, 0.1, h=np.array([1.0, 0, 0]), shift=np.array([1e-6, 0, 0]))
    assert ml.entered(ledger, wrong, book).x[0] == pytest.approx(0.0, abs=1e-4)
    still = observed_at(q, 0.1, h=np.array([1.0, 0, 0]))
    assert ml.entered(ledger, still, book).x[0] > 0.1


def test_drift_is_integrated_from_the_first_sample_to_the_requested_time():
    bed = platform(disturbances=("drift_x",))
    book, q = ml.book_of(bed), np.array([1.0, 0, 0, 0])
    ledger = ml.opened(bed, book, observed_at(q, 5.0))._replace(t=65.0)
    x = ledger.x.copy()
    x[9:13] = 1e-6, 0, 0, 2e-9
    assert ml.com_map(ledger, book) @ x == pytest.approx([1e-6 + 60 * 2e-9, 0, 0])
    assert ml.com_map(ledger, book, 10.0) @ x == pytest.approx([1e-6 + 70 * 2e-9, 0, 0])


def test_play_of_the_air_is_a_torque_on_the_platform_of_a_stated_sd():
    """It puts +x momentum in where it is positive; without samples it forgets in AIR_TIME."""
    bed = platform()
    book, q = ml.book_of(bed), np.array([1.0, 0, 0, 0])
    ledger = ml.opened(bed, book, observed_at(q))
    x, P = ledger.x.copy(), ledger.P.copy()
    x[ml.PLAY], P[ml.PLAY, ml.PLAY] = 1e-6, 0.0
    ahead = ledger._replace(x=x, P=P)
    for k in range(300):
        ahead = ml.predicted(ahead, observed_at(q, 0.1 * (k + 1)), book)
    time, spent = AIR_TIME, 1 - np.exp(-30.0 / AIR_TIME)
    assert ahead.x[0] == pytest.approx(1e-6 * time * spent, rel=1e-4)
    assert ahead.x[ml.PLAY] == pytest.approx(1e-6 * (1 - spent))
    assert ahead.P[ml.PLAY, ml.PLAY] == pytest.approx(bed.air_torque**2 * (1 - (1 - spent) ** 2))
