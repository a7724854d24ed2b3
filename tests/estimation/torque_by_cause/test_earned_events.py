"""An event stays where it stands out from a torque that wanders, on a chain of a rate alone."""

import numpy as np

from equipoise.estimation.torque_by_cause.earned_events import earned
from equipoise.estimation.torque_by_cause.gauss_markov import Chain

K, AT = 40, (9, 24)  # stretches of a second; cuts at which a rate may jump
RATE, CARRIER = np.arange(3, 6), np.arange(6, 9)
NOISE = 2e-6  # rad/s, of the rate that each stretch shows
NONE = np.zeros(0, dtype=np.int64)


def chain_of(rate):
    """Return the chain of a platform of 1 kg m^2 whose rate (K, 3) was measured."""
    onward = np.tile(np.eye(6, 9), (K - 1, 1, 1))
    onward[:, RATE, CARRIER] = 1.0  # s / (kg m^2)
    normal = np.zeros((K, 9, 9))
    normal[:, RATE, RATE] = NOISE**-2
    descent = np.zeros((K, 9))
    descent[:, RATE] = rate / NOISE**2
    prior = np.diag([1.0] * 6 + [0.0] * 3)
    events = tuple(RATE if k in AT else NONE for k in range(K - 1))
    return Chain(normal, descent, onward, np.ones(K - 1), CARRIER, np.zeros((K, 3)),
                 np.zeros((K - 1, 9)), events, (1e-2,) * (K - 1), prior, np.zeros(9))  # fmt: skip


def kept(rate):
    """Return the cuts at which an event stays."""
    return tuple(k for k, changed in enumerate(earned(chain_of(rate)).events) if len(changed))


def noise(rng):
    return NOISE * rng.normal(size=(K, 3))


def gusts(rng, sd=1e-5):
    """Return rates (K, 3) under a torque that wanders."""
    torque, stay = np.zeros((K, 3)), np.exp(-1 / 20)
    for k in range(K):
        torque[k] = stay * torque[k - 1] + np.sqrt(1 - stay**2) * sd * rng.normal(size=3)
    return np.vstack([np.zeros((1, 3)), np.cumsum(torque[:-1], axis=0)])


def test_no_event_is_left_of_a_torque_that_wanders():
    for seed in range(5):
        rng = np.random.default_rng(seed)
        assert kept(gusts(rng) + noise(rng)) == ()


def test_a_touch_stays_in_still_air_and_an_event_of_nothing_goes():
    """A jump of 2e-4 rad/s behind the second cut, a hundred times the noise."""
    rng = np.random.default_rng(7)
    touch = np.outer(np.arange(K) > AT[1], [2e-4, 0.0, 0.0])
    assert kept(touch + noise(rng)) == AT[1:]


def test_a_touch_stays_in_moving_air():
    rng = np.random.default_rng(8)
    touch = np.outer(np.arange(K) > AT[0], [0.0, 1e-3, 0.0])
    assert kept(touch + gusts(rng, sd=1e-6) + noise(rng)) == AT[:1]


def test_a_chain_without_events_is_left_as_it_is():
    chain = chain_of(np.zeros((K, 3)))._replace(events=(NONE,) * (K - 1))
    assert earned(chain) is chain
