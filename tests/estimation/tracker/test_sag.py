"""A tracker whose state has the elastic sag: its Jacobian, and what it finds and leaves alone."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy.stats import chi2

from equipoise.actuators.sliding_masses import mass_maps
from equipoise.dynamics.forcing import groups_of
from equipoise.dynamics.propagation import propagate, rigid_body, stacked
from equipoise.dynamics.sag_trim import SAG_TERMS, sag_matrix
from equipoise.dynamics.sensitivities import Inputs
from equipoise.dynamics.timeline import timeline
from equipoise.estimation.tracker import event_signatures as onsets
from equipoise.estimation.tracker import stored_covariance as stored
from equipoise.estimation.tracker.filter_kernel import predict
from equipoise.estimation.tracker.kernel_records import new_tools
from equipoise.estimation.tracker.known_sag import SAG, with_sag
from equipoise.estimation.tracker.linearisation_point import linear_in
from equipoise.estimation.tracker.predict_correct import (
    COM,
    carry,
    carry_beside,
    expect,
    predict_covariance,
    shrink,
    weigh,
)
from equipoise.estimation.tracker.sag import bend, bend_signatures, bending
from equipoise.estimation.tracker.stored_covariance import (
    DRIFT,
    SAG_ROW,
    SIZE,
    WARM_ROW,
    WITH_SAG,
)
from equipoise.estimation.tracker.tracker import (
    Params,
    filter_columns,
    first_state,
    model_of,
    track,
)
from equipoise.io.testbed.presets import read_preset
from equipoise.maths.attitude import from_euler321, to_matrix
from equipoise.maths.linalg import pack_symmetric
from equipoise.model.recording import Recording
from equipoise.model.torque_terms import TERMS
from equipoise.model.units import UM
from equipoise.simulation.bench import SimulatedBench
from tests.support import thorough

C = np.array([12.0, -7.0, 3.0, -4.0, 5.0]) * UM
DOWN = np.array([0.3, -0.2, -0.9])
STILL = Params("fed", com_walk=1e-10, torque_walk=1e-10)
ROWS = np.r_[COM, SAG]
SEEDS = thorough.count(8, 4)
STEP, COUNT = 0.1, 60  # s and steps of the Jacobian's motion


def torque_of(sag):
    """The torques' coefficients, sag alone."""
    found = np.zeros(len(TERMS))
    found[[TERMS.index(name) for name in SAG_TERMS]] = sag
    return found


def test_the_five_displacements_add_up_to_c_n():
    found = sum(c * np.array(bending(DOWN, k)) for k, c in enumerate(C))
    np.testing.assert_allclose(found, sag_matrix(dict(zip(SAG_TERMS, C, strict=True))) @ DOWN)


def displaced(sign):
    """F = E + sign B(n) at (r, c)."""
    F = np.eye(WITH_SAG)
    for k in range(5):
        F[COM, SAG_ROW + k] = sign * np.array(bending(DOWN, k))
    return F


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_r_is_displaced_and_its_covariance_with_it(sign):
    """r + sign B (c - c0), P as F P F^T; c0 is integrated with the motion."""
    root = np.random.default_rng(1).normal(size=(WITH_SAG, WITH_SAG))
    P, end, work = root @ root.T, np.arange(1.0 + WITH_SAG), new_tools(True, WITH_SAG).work
    stored.take(P, work.P)
    expected = end.copy()
    bend(DOWN, sign, tuple(torque_of(C)), end, work)
    found, F = np.zeros_like(P), displaced(sign)
    stored.give(work.P, found)
    np.testing.assert_allclose(found, F @ P @ F.T, rtol=0, atol=1e-12)
    expected[7:10] += sign * displaced(1.0)[COM, SAG_ROW:] @ (expected[1 + SAG_ROW :] - C)
    np.testing.assert_allclose(end, expected)


@pytest.mark.parametrize("first", [DRIFT, WARM_ROW], ids=["drift", "warmth"])
def test_what_carries_r_on_carries_its_covariance_with_the_sag(first):
    """P as F P F^T, F = E + 0.5 at (r, v) or (r, k)."""
    root, F = np.random.default_rng(3).normal(size=(WITH_SAG, WITH_SAG)), np.eye(WITH_SAG)
    P, work, found = root @ root.T, new_tools(True, WITH_SAG).work, np.zeros_like(root)
    F[range(6, 9), range(first, first + 3)] = 0.5
    stored.take(P, work.P)
    carry(first, 0.5, np.zeros(1 + WITH_SAG), work.P)
    carry_beside(first, 0.5, work)
    stored.give(work.P, found)
    np.testing.assert_allclose(found, F @ P @ F.T, rtol=0, atol=1e-12)


@pytest.mark.parametrize(("first", "second"), [(0, -1), (3, 15)], ids=["camera", "gyro"])
def test_a_prediction_and_a_row_do_to_the_sag_what_kalman_says(first, second):
    """P as Phi P Phi^T, then (E - K H) P with all 29 of the error state."""
    rng = np.random.default_rng(4)
    root, phi, full = rng.normal(size=(WITH_SAG, WITH_SAG)), rng.normal(size=(6, 15)), np.eye(29)
    P, work, found = root @ root.T, new_tools(True, WITH_SAG).work, np.zeros_like(root)
    stored.take(P, work.P)
    full[:6, :15] = phi
    still, flat = np.zeros(SIZE), np.pad(phi, ((0, 0), (0, 1))).ravel()
    predict_covariance((1.0, 1.0, 1.0, 0.0, 0.0, 0.0), flat, still, 0.1, work)
    P, H = full @ P @ full.T, np.zeros((3, WITH_SAG))
    H[range(3), range(first, first + 3)] = 1.0
    if second >= 0:
        H[range(3), range(second, second + 3)] = 1.0
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + 0.7 * np.eye(3))
    expect(first, second, 0.7, work)
    weigh((0.3, -0.2, 0.5), work)
    shrink(first, second, 0.7, work)
    stored.give(work.P, found)
    np.testing.assert_allclose(found, P - K @ H @ P, rtol=0, atol=1e-11 * np.abs(P).max())
    np.testing.assert_allclose(work.x[:WITH_SAG], K @ [0.3, -0.2, 0.5], atol=1e-11)


def test_signatures_of_events_are_displaced_alike():
    watch = onsets.new_watch(WITH_SAG)
    watch.X[:] = np.random.default_rng(2).normal(size=watch.X.shape)
    X = watch.X.reshape(WITH_SAG, -1).copy()
    bend_signatures(DOWN, -1.0, watch.X)
    np.testing.assert_allclose(watch.X.reshape(WITH_SAG, -1), displaced(-1.0) @ X, atol=1e-13)


def tilted():
    """A platform 15 deg off level, at 6 deg/s, and what is known over 6 s: nothing moves."""
    bed = read_preset("sputnix")
    q = from_euler321(np.array(0.4), np.array(0.2), np.array(-0.15))
    state = replace(first_state(0.0, q, bed), rate=np.array([0.05, -0.08, 0.06]))
    t = STEP * np.arange(COUNT + 1)
    return bed, state, timeline(t, t, None, len(bed.masses), 1.0)


def motion_with(sag):
    """Attitude and rate at the end, of a platform that sags by these coefficients."""
    bed, state, line = tilted()
    body = rigid_body(bed.body, bed.gravity, torque_of(sag))
    found = propagate(body, mass_maps(bed.masses), line, state.q, state.rate)
    return found.q[-1], found.rate[-1]


def difference(k, by=1 * UM):
    """dth and dw by metre of a coefficient: central differences of the propagator."""
    (q1, w1), (q0, w0) = (motion_with(C + s * by * np.eye(5)[k]) for s in (1, -1))
    a, v = q0[0], -q0[1:]  # q0^-1 (x) q1, a small rotation: twice its vector part
    turn = 2 * (a * q1[1:] + q1[0] * v + np.cross(v, q1[1:]))
    return np.concatenate([turn, w1 - w0]) / (2 * by)


def test_the_jacobian_is_that_of_the_motion():
    """Covariance of (dth, dw) with c of one after 6 s, where nothing else is uncertain."""
    bed, state, line = tilted()
    covariance = np.zeros((WITH_SAG, WITH_SAG))
    covariance[SAG, SAG] = np.eye(5)
    body, tools = rigid_body(bed.body, bed.gravity, torque_of(C)), new_tools(True, WITH_SAG)
    record = Recording()
    model = model_of(record, bed, replace(STILL, torque_walk=0.0), state)
    columns = filter_columns()
    maps = stacked(mass_maps(bed.masses))
    inputs = Inputs(maps, line.t, line.known, line.owners, columns, groups_of(columns))
    J = pack_symmetric(state.inertia_P)
    end = np.concatenate([state.q, state.rate, state.com, J, np.zeros(9), C])
    point = linear_in(end)
    stored.take(covariance, tools.work.P)
    for i in range(COUNT):
        predict(model, inputs, body, i, point, end, tools)
    stored.give(tools.work.P, covariance)
    found = covariance[:6, SAG]
    expected = np.column_stack([difference(k) for k in range(5)])
    np.testing.assert_allclose(found, expected, rtol=0, atol=2e-3 * np.abs(expected).max())
    np.testing.assert_allclose(end[25:], C)
    np.testing.assert_allclose(end[7:10], state.com, atol=1e-18)


def sagging(seed):
    """The preset, its inertia known, swinging some 10 deg, with a sag of some um."""
    bed = read_preset("sputnix")
    sag = 5 * UM * np.random.default_rng([seed, 7]).normal(size=5)
    truth = replace(
        bed.truth, inertia_error=0.0, torque=dict(zip(SAG_TERMS, sag, strict=True)),
        com_low=np.array([-5, -5, -105]) * UM, com_high=np.array([5, 5, -95]) * UM,
    )  # fmt: skip
    return replace(bed, inertia_sd=0.0, com_sd=np.full(3, 20 * UM), truth=truth), sag


@cache
def followed(seed):
    """A track of three minutes begun without knowledge of the sag, com and sag as they are."""
    bed, sag = sagging(seed)
    bench = SimulatedBench(bed, seed)
    record = bench.read(180.0)
    first = first_state(0.0, record.attitude.values[0], bed)
    first = with_sag(first, np.zeros(5), (30 * UM) ** 2 * np.eye(5))
    return record, bed, first, track(record, bed, STILL, first), np.append(bench.com, sag)


def test_com_and_sag_are_within_what_the_covariance_says():
    """NEES of 8 unknowns over the seeds, by chance beyond the band once in 1000."""
    values = []
    for seed in range(SEEDS):
        *_, found, true = followed(seed)
        error = np.append(found.end.com, found.end.sag) - true
        values.append(error @ np.linalg.solve(found.end.covariance[np.ix_(ROWS, ROWS)], error))
    low, high = chi2.ppf([5e-4, 1 - 5e-4], 8 * SEEDS) / SEEDS
    assert low < np.mean(values) < high


def test_the_sag_becomes_known_and_what_acts_at_the_end_much_better():
    """From 30 um to a quarter; r + C n across gravity to 0.3 um, though r and C are not known."""
    sds, levers = [], []
    for seed in range(SEEDS):
        end = followed(seed)[3].end
        sds.append(np.sqrt(np.diag(end.covariance)[SAG]))
        down = -to_matrix(end.q)[2]
        whole = np.column_stack([np.eye(3), *(np.array(bending(down, k)) for k in range(5))])
        across = (np.eye(3) - np.outer(down, down)) @ whole
        levers.append(np.sqrt(np.diag(across @ end.covariance[np.ix_(ROWS, ROWS)] @ across.T)))
    assert np.median(sds) < 7.5 * UM
    assert np.max(levers) < 0.3 * UM


def test_a_sag_in_the_state_is_no_contact():
    assert [c for seed in range(SEEDS) for c in followed(seed)[3].contacts] == []


def test_where_the_sag_is_certain_it_is_as_if_it_were_not_in_the_state():
    """To rounding: a variance of zero, and no sag at all."""
    record, bed, first, *_ = followed(1)
    plain = replace(first, sag=None, covariance=first.covariance[:SIZE, :SIZE])
    certain = with_sag(plain, np.zeros(5), np.zeros((5, 5)))
    a, b = (track(record, bed, STILL, state) for state in (plain, certain))
    np.testing.assert_allclose(b.end.com, a.end.com, rtol=0, atol=1e-12)
    np.testing.assert_allclose(b.sd[:, :SIZE], a.sd, rtol=1e-6)
    assert a.sag.shape == (len(a.t), 0)
    assert b.sag.shape == (len(b.t), 5)
