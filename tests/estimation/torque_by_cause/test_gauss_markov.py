"""The smoother against the same problem solved at once, with all unknowns in one matrix."""

import numpy as np
import pytest

from equipoise.estimation.torque_by_cause.gauss_markov import Chain, Process, backward, smoothed

N, K = 10, 5  # six of the state, three of the torque, one parameter
CARRIER = np.array([6, 7, 8])


def random_chain(events=()):
    """A chain with rows enough in every stretch, a gap at each cut, and points with a torque."""
    rng = np.random.default_rng(4)
    roots = rng.normal(size=(K, 14, N))
    normal = np.einsum("kij,kil->kjl", roots, roots)
    onward = rng.normal(size=(K - 1, 6, N))
    gaps = np.zeros((K - 1, N))
    gaps[:, :6] = 0.1 * rng.normal(size=(K - 1, 6))
    prior = np.diag([0.0] * 6 + [0.0] * 3 + [2.0])
    score = np.append(np.zeros(N - 1), 0.3)
    changed = tuple(np.array(events if k == 1 else [], dtype=np.int64) for k in range(K - 1))
    return Chain(
        normal, rng.normal(size=(K, N)), onward, np.array([1.0, 1.0, 0.5, 1.5]), CARRIER,
        0.2 * rng.normal(size=(K, 3)), gaps, changed, (1.0,) * (K - 1), prior, score,
    )  # fmt: skip


def at_once(chain, process):
    """Information and score of the first deviation and every u, and what turns these to all d."""
    wide = [3 + len(e) for e in chain.events]
    size = N + sum(wide)
    maps, offset = [np.eye(N, size)], [np.zeros(N)]
    weight, at = np.zeros(size), N
    for k, count in enumerate(wide):
        F, stay = np.eye(N), np.exp(-chain.seconds[k] / process.correlation)
        F[:6], F[CARRIER, CARRIER] = chain.onward[k], stay
        o = chain.gaps[k].copy()
        o[CARRIER] = stay * chain.torque[k] - chain.torque[k + 1]
        new = F @ maps[-1]
        for j, coordinate in enumerate([*CARRIER, *chain.events[k]]):
            new[coordinate, at + j] += 1.0
        weight[at : at + 3] = 1 / (process.sd**2 * (1 - stay**2))
        weight[at + 3 : at + count] = chain.event_sd[k] ** -2
        maps.append(new)
        offset.append(F @ offset[-1] + o)
        at += count
    A, b = np.diag(weight), np.zeros(size)
    A[:N, :N] += chain.prior
    b[:N] += chain.prior_score
    A[CARRIER, CARRIER] += process.sd**-2
    b[CARRIER] -= chain.torque[0] / process.sd**2
    constant = np.sum(chain.torque[0] ** 2) / process.sd**2
    for k in range(K):
        A += maps[k].T @ chain.normal[k] @ maps[k]
        b += maps[k].T @ (chain.descent[k] - chain.normal[k] @ offset[k])
        constant += offset[k] @ chain.normal[k] @ offset[k] - 2 * chain.descent[k] @ offset[k]
    log_prior = np.sum(np.log(weight[N:])) - 6 * np.log(process.sd)
    improbable = constant - b @ np.linalg.solve(A, b) + np.linalg.slogdet(A)[1] - log_prior
    return A, b, maps, offset, improbable


@pytest.mark.parametrize("events", [(), (3, 4, 5)])
def test_smoother_is_the_solution_of_all_unknowns_at_once(events):
    chain, process = random_chain(events), Process(0.7, 3.0)
    A, b, maps, offset, _ = at_once(chain, process)
    inverse, found = np.linalg.inv(A), smoothed(chain, process)
    for k in range(K):
        assert found.mean[k] == pytest.approx(maps[k] @ inverse @ b + offset[k], rel=1e-8, abs=1e-9)
        assert found.covariance[k] == pytest.approx(maps[k] @ inverse @ maps[k].T, rel=1e-7,
                                                    abs=1e-10)  # fmt: skip


def test_neighbouring_stretches_are_correlated_as_onward_and_fresh_say():
    chain, process = random_chain(), Process(0.7, 3.0)
    A, _, maps, _, _ = at_once(chain, process)
    found, inverse = smoothed(chain, process), np.linalg.inv(A)
    across = maps[3] @ inverse @ maps[2].T
    assert found.onward[2] @ found.covariance[2] == pytest.approx(across, rel=1e-7, abs=1e-10)
    whole = found.onward[2] @ found.covariance[2] @ found.onward[2].T + found.fresh[2]
    assert whole == pytest.approx(found.covariance[3], rel=1e-8, abs=1e-12)


def test_improbability_differs_between_processes_as_that_of_all_unknowns_at_once():
    chain = random_chain()
    processes = [Process(0.2, 3.0), Process(0.7, 3.0), Process(0.7, 30.0)]
    found = [backward(chain, each)[2] for each in processes]
    wanted = [at_once(chain, each)[4] for each in processes]
    assert np.diff(found) == pytest.approx(np.diff(wanted), rel=1e-8)
