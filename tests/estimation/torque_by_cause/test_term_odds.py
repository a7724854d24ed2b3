"""A term that nobody declared has the share that the rows give it, on a chain of a rate alone."""

import numpy as np

from equipoise.estimation.torque_by_cause.gauss_markov import Chain, Process, improbability
from equipoise.estimation.torque_by_cause.process_sizes import weighed
from equipoise.estimation.torque_by_cause.term_odds import Doubted, alternatives, without

K, NOISE, USUAL = 40, 2e-6, 1e-5  # stretches of a second; rad/s of a row; N m
COURSE = np.cos(2 * np.pi * np.arange(K) / 9)[:, None]  # of the torque that the term gives
RATE, CARRIER, TERMS = np.arange(3, 6), np.arange(6, 9), np.arange(9, 12)
NONE = np.zeros(0, dtype=np.int64)
TERM = Doubted(TERMS, np.zeros(3))


def chain_of(rate, at=0.0):
    """Return the chain of a platform of 1 kg m^2, about a size ``at`` of a term that may act."""
    onward = np.tile(np.eye(6, 12), (K - 1, 1, 1))
    onward[:, RATE, CARRIER] = 1.0  # s / (kg m^2)
    onward[:, RATE, TERMS] = COURSE[:-1]
    normal = np.zeros((K, 12, 12))
    normal[:, RATE, RATE] = NOISE**-2
    descent = np.zeros((K, 12))
    descent[:, RATE] = (rate - turned(np.full(3, at) * COURSE)) / NOISE**2
    prior = np.diag([1.0] * 6 + [0.0] * 3 + [USUAL**-2] * 3)
    score = np.append(np.zeros(9), np.full(3, -at / USUAL**2))
    return Chain(
        normal, descent, onward, np.ones(K - 1), CARRIER, np.zeros((K, 3)), np.zeros((K - 1, 12)),
        (NONE,) * (K - 1), (1.0,) * (K - 1), prior, score,
    )  # fmt: skip


def turned(torque):
    """Return rates (K, 3) under a torque (K, 3)."""
    return np.vstack([np.zeros((1, 3)), np.cumsum(torque[:-1], axis=0)])


def measured(rng, torque):
    """Return the same with noise."""
    return turned(torque) + NOISE * rng.normal(size=(K, 3))


def share_with(rate):
    """Return the share of models in which the term acts."""
    chain = chain_of(rate)
    found = weighed(alternatives(chain, [TERM]))
    spread = np.array([each.course.covariance[0, TERMS[0], TERMS[0]] for each in found])
    weight = np.array([each.weight for each in found])
    return float(weight[spread > (1e-2 * USUAL) ** 2].sum())


def test_a_torque_along_the_course_of_a_term_is_the_terms():
    torque = COURSE * np.array([2e-5, -1e-5, 1.5e-5])
    assert share_with(measured(np.random.default_rng(1), torque)) > 0.99


def test_without_any_torque_the_term_has_no_more_than_its_odds():
    """One to six, before rows say anything."""
    assert share_with(measured(np.random.default_rng(2), np.zeros((K, 3)))) < 1 / 7


def test_a_term_that_does_not_act_is_zero():
    chain = without(chain_of(np.zeros((K, 3)), at=3e-6), TERM._replace(at=np.full(3, 3e-6)))
    (found, *_) = weighed([chain])
    assert np.abs(found.course.mean[0, TERMS] + 3e-6).max() < 1e-8


def test_the_odds_do_not_depend_on_the_point():
    """Rows are as probable without the term, whatever torque the chain is linear about."""
    rate = measured(np.random.default_rng(3), COURSE * np.full(3, 4e-6))
    process = Process(3e-6, 20.0)

    def gained(at):
        chain = chain_of(rate, at)
        left = without(chain, TERM._replace(at=np.full(3, at)))
        return improbability(left, process) - improbability(chain, process)

    assert abs(gained(0.0) - gained(5e-6)) < 1e-2


def test_a_chain_without_doubt_is_the_only_model():
    chain = chain_of(np.zeros((K, 3)))
    assert alternatives(chain, ()) == (chain,)
