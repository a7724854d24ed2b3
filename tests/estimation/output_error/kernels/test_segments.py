"""The elimination of stretches, back and forth, against dense NumPy on random local models.

Every stretch has a random A, b and every cut a random Phi; nothing here knows of a platform. The
dense problem has all unknowns at once: z = [ first stretch | every jump ].
"""

from typing import NamedTuple

import numpy as np
import pytest

from equipoise.estimation.events.jump_test import disturbances
from equipoise.estimation.output_error.kernels.interval_smoother import smooth
from equipoise.estimation.output_error.kernels.segments import (
    STATE,
    Cuts,
    Pieces,
    chain_for,
    condense,
    count_free,
    follow,
    jump_cost,
)
from equipoise.maths.levenberg_marquardt import promise

N = 9  # attitude, rate and three that are handed on
FREE = np.array([[3, 4, 5], [-1, -1, -1], [6, 7, -1], [0, 5, 8]])  # rates; none; others; a mixture
STRETCHES = len(FREE) + 1


def random_chain(seed):
    """Return cuts and local models; each stretch alone determines fewer than all unknowns."""
    rng = np.random.default_rng(seed)
    K, a = FREE.shape
    J = rng.normal(size=(STRETCHES, N - 2, N))
    e = rng.normal(size=(STRETCHES, N - 2))
    weight = np.where(FREE >= 0, rng.uniform(0.5, 2.0, FREE.shape), 0.0)
    jumps = np.where(FREE >= 0, rng.normal(size=(K, a)), 0.0)
    onward = np.hstack([np.eye(STATE), np.zeros((STATE, N - STATE))])
    onward = onward + 0.4 * rng.normal(size=(K, STATE, N))
    cuts = Cuts(np.arange(STRETCHES + 1), FREE, weight)
    normal, descent = np.einsum("kri,krj->kij", J, J), np.einsum("kri,kr->ki", J, e)
    return cuts, Pieces(normal, descent, onward, jumps, np.zeros((STRETCHES, 1)))


class Dense(NamedTuple):
    """The same with all unknowns at once."""

    A: np.ndarray  # of z
    b: np.ndarray
    maps: list[np.ndarray]  # x_k = maps[k] z
    jump: list[np.ndarray]  # where in z the jumps of each cut are


def dense(cuts, pieces):
    """Chain the stretches: x_(k+1) = F x_k + E u."""
    counts = [np.sum(free >= 0) for free in cuts.free]
    size = N + int(np.sum(counts))
    ends = N + np.cumsum(counts)
    jump = [np.arange(end - count, end) for end, count in zip(ends, counts, strict=True)]
    maps = [np.eye(N, size)]
    for k, places in enumerate(jump):
        F = np.eye(N)
        F[:STATE] = pieces.onward[k]
        after = F @ maps[-1]
        after[cuts.free[k, : len(places)], places] += 1.0
        maps.append(after)
    A = sum(M.T @ P @ M for M, P in zip(maps, pieces.normal, strict=True))
    b = sum(M.T @ p for M, p in zip(maps, pieces.descent, strict=True))
    for k, places in enumerate(jump):
        w = cuts.weight[k, : len(places)]
        A[places, places] += w
        b[places] -= w * pieces.jumps[k, : len(places)]
    return Dense(A, b, maps, jump)


@pytest.fixture(params=range(3))
def chained(request):
    cuts, pieces = random_chain(request.param)
    return cuts, pieces, dense(cuts, pieces)


# --- From many stretches to the first -------------------------------------------------------------


def test_free_coordinates_come_first():
    assert [count_free(free) for free in FREE] == [3, 0, 2, 3]


def test_condensed_is_the_schur_complement(chained):
    """All jumps taken out of the dense A and b."""
    cuts, pieces, full = chained
    chain = chain_for(cuts, N)
    condense(cuts, pieces, 0.0, chain)
    x, u = slice(0, N), slice(N, None)
    out = full.A[x, u] @ np.linalg.inv(full.A[u, u])
    np.testing.assert_allclose(chain.normal, full.A[x, x] - out @ full.A[u, x], rtol=1e-9)
    np.testing.assert_allclose(chain.descent, full.b[x] - out @ full.b[u], rtol=1e-9)


def test_jumps_follow_the_dense_solution(chained):
    """The first stretch's step and every jump's are the parts of one z = A^-1 b."""
    cuts, pieces, full = chained
    chain, z = chain_for(cuts, N), np.linalg.solve(full.A, full.b)
    condense(cuts, pieces, 0.0, chain)
    np.testing.assert_allclose(np.linalg.solve(chain.normal, chain.descent), z[:N], rtol=1e-8)
    jumps = np.zeros_like(pieces.jumps)
    follow(cuts, pieces, z[:N], chain, jumps)
    for k, places in enumerate(full.jump):
        moved = jumps[k] - pieces.jumps[k]
        np.testing.assert_allclose(moved[: len(places)], z[places], rtol=1e-7, atol=1e-10)


def test_promises_add_up(chained):
    """What jumps promise and what the first stretch promises: b A^-1 b of the dense problem."""
    cuts, pieces, full = chained
    chain = chain_for(cuts, N)
    of_jumps = condense(cuts, pieces, 0.0, chain)
    step = np.linalg.solve(chain.normal, chain.descent)
    total = of_jumps + promise(chain.normal, chain.descent, step)
    assert of_jumps > 0.01 * total
    assert total == pytest.approx(full.b @ np.linalg.solve(full.A, full.b), rel=1e-9)


def test_jump_cost_by_hand():
    """1/2 (4 * 9 + 1 * 25) of the first cut, nothing of the second, whatever lies behind -1."""
    free = np.array([[3, 4], [-1, -1]])
    cuts = Cuts(np.arange(4), free, np.array([[4.0, 1.0], [7.0, 7.0]]))
    assert jump_cost(cuts, np.array([[3.0, 5.0], [9.0, 9.0]])) == 30.5


# --- The smoother ---------------------------------------------------------------------------------


@pytest.fixture
def measured(chained):
    cuts, pieces, full = chained
    spread = np.linalg.inv(full.A)
    return cuts, pieces, full, spread, smooth(cuts, pieces, spread[:N, :N])


def test_covariance_of_every_stretch_is_of_the_dense_inverse(measured):
    _, _, full, spread, found = measured
    for M, C in zip(full.maps, found.covariance, strict=True):
        np.testing.assert_allclose(C, M @ spread @ M.T, rtol=1e-7, atol=1e-9)


def test_covariance_of_every_jump_is_of_the_dense_inverse(measured):
    """And ``firm`` is what is left of it when the first stretch and all earlier jumps are known."""
    _, _, full, spread, found = measured
    for k, places in enumerate(full.jump):
        a = len(places)
        expected = spread[np.ix_(places, places)]
        np.testing.assert_allclose(found.jump_covariance[k, :a, :a], expected, rtol=1e-7, atol=1e-9)
        if a:
            unknown = np.linalg.inv(full.A[places[0] :, places[0] :])[:a, :a]
            np.testing.assert_allclose(found.firm[k, :a, :a], unknown, rtol=1e-7, atol=1e-9)


def test_information_and_score_are_of_the_rows_from_there_on(measured):
    """Each stretch with what follows, its own unknowns kept and later jumps taken out."""
    cuts, pieces, _, _, found = measured
    for k in range(STRETCHES):
        rest = Cuts(cuts.nodes[k:], cuts.free[k:], cuts.weight[k:])
        tail = dense(rest, Pieces(*(part[k:] for part in pieces)))
        x, u = slice(0, N), slice(N, None)
        out = tail.A[x, u] @ np.linalg.pinv(tail.A[u, u])
        expected = tail.A[x, x] - out @ tail.A[u, x]
        np.testing.assert_allclose(found.information[k], expected, rtol=1e-8, atol=1e-9)
        np.testing.assert_allclose(
            found.score[k], tail.b[x] - out @ tail.b[u], rtol=1e-8, atol=1e-9
        )


def test_onward_leads_from_the_first_to_the_last(measured):
    """Jumps go along as all rows have it: the covariance of last and first is onward times C_0."""
    _, _, full, spread, found = measured
    across = full.maps[-1] @ spread @ full.maps[0].T
    np.testing.assert_allclose(found.onward @ spread[:N, :N], across, rtol=1e-7, atol=1e-9)


# --- The test for a jump --------------------------------------------------------------------------


def optimum(cuts, pieces, full):
    """Return the local models at the dense solution: their descents there, and the jumps."""
    z = np.linalg.solve(full.A, full.b)
    left = [
        p - P @ (M @ z) for p, P, M in zip(pieces.descent, pieces.normal, full.maps, strict=True)
    ]
    jumps = pieces.jumps.copy()
    for k, places in enumerate(full.jump):
        jumps[k, : len(places)] += z[places]
    return pieces._replace(descent=np.array(left), jumps=jumps)


@pytest.mark.parametrize("k", range(len(FREE)))
@pytest.mark.parametrize("coordinates", [slice(3, 6), slice(6, 9)], ids=["impulse", "com_step"])
def test_surprise_is_what_a_free_jump_gains(chained, k, coordinates):
    """Linear, so exact: twice the cost falls by the surprise when the jump u is freed at a cut.

    Also where some of these coordinates may jump already, by their sd: then the jump comes on top.
    """
    cuts, pieces, full = chained
    at = optimum(cuts, pieces, full)
    here = dense(cuts, at)
    assert np.abs(here.b).max() < 1e-9
    found = disturbances(smooth(cuts, at, np.linalg.inv(here.A)[:N, :N]), coordinates)
    B, after = np.eye(N)[:, coordinates], np.eye(N)
    extra = np.zeros((3, len(here.b)))
    crossed, toward = np.zeros((3, 3)), np.zeros(3)
    for j in range(k + 1, STRETCHES):
        P, M = at.normal[j], here.maps[j]
        extra += (after @ B).T @ P @ M
        crossed += (after @ B).T @ P @ (after @ B)
        toward += (after @ B).T @ at.descent[j]
        if j < len(FREE):
            after = np.vstack([at.onward[j], np.eye(N)[STATE:]]) @ after
    D = crossed - extra @ np.linalg.solve(here.A, extra.T)
    u = np.linalg.solve(D, toward)
    assert found.surprise[k] == pytest.approx(toward @ u, rel=1e-6)
    np.testing.assert_allclose(found.jump[k], u, rtol=1e-6, atol=1e-9)
    np.testing.assert_allclose(found.information[k], D, rtol=1e-6, atol=1e-9)
