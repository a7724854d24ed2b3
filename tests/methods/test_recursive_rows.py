"""The rows of the recursive regressions hold for a motion that was made without them."""

from dataclasses import replace

import numpy as np
import pytest
from builders import COM, EVERY_TORQUE, GRAVITY, INERTIA, MASS, body, move_at, platform, travel
from driven import driven, driven_platform

from equipoise.dynamics.propagation import body_of
from equipoise.dynamics.timeline import timeline
from equipoise.estimation.formulations.differentiated import (
    balance,
    momentum_matrix,
    smoothed_slope,
)
from equipoise.estimation.formulations.increments import increments
from equipoise.estimation.formulations.momentum import body_axes
from equipoise.estimation.formulations.rows import Posed
from equipoise.estimation.formulations.running_mean import SAMPLES, averaged
from equipoise.estimation.formulations.tracked import filtered, integrals, twice
from equipoise.estimation.led_motion import LedMotion
from equipoise.maths.linalg import unpack_symmetric
from equipoise.maths.tracking_differentiator import pace_for, track_twice
from equipoise.model.recording import Recording, Samples
from equipoise.model.torque_terms import TERMS

STEP, END = 0.02, 60.0
MOVE = move_at(20.0, END)
WHEEL = Samples(np.array([0.0, 30, 40]), np.outer([1, 1, 4], [2e-4, -1e-4, 3e-4]))
PUSH = Samples(np.array([0.0, END]), np.outer([1, -2], [1e-5, 2e-5, -1e-5]))
TRUTH = np.concatenate([INERTIA, COM, EVERY_TORQUE])
# What is left of the rows for the truth (N m or N m s), of sizes near 1e-2, and the formulation.
ROWS = {
    "torque": (smoothed_slope, 2e-7),
    "td_td": (twice, 2e-7),
    "etd": (integrals, 2e-7),
    "averaged": (averaged, 2e-7),
}


@pytest.fixture(scope="module")
def moved():
    """A minute of motion with a move, a wheel, a known torque and every torque of the model."""
    t = np.linspace(0, END, round(END / STEP) + 1)
    line = timeline(t, np.zeros(0), MOVE, 3, 1.0, WHEEL, PUSH)
    record = Recording(masses=MOVE, mass_names=("x", "y", "z"), momentum=WHEEL, torque=PUSH)
    return record, line.t, travel(line, body(EVERY_TORQUE))


def whole(t, motion):
    return LedMotion(t, motion.q, motion.rate, np.zeros(len(t), np.int64))


def misfit(record, t, motion, formulation):
    """Return what is left of every row; a constant is taken off where it is free."""
    rows = formulation(Posed(record, platform(), whole(t, motion), TERMS))
    left = rows.A @ TRUTH - rows.b
    return left if rows.piece is None else left - left.mean(axis=0)


@pytest.mark.parametrize(("formulation", "size"), ROWS.values(), ids=ROWS)
def test_rows_vanish_for_the_truth(moved, formulation, size):
    assert np.sqrt(np.mean(misfit(*moved, formulation) ** 2)) < size


CHANGES = {
    "mass moves": {"masses": None, "mass_names": ()},
    "wheel": {"momentum": None},
    "known torque": {"torque": None},
}


@pytest.mark.parametrize("missing", CHANGES)
@pytest.mark.parametrize(("formulation", "size"), ROWS.values(), ids=ROWS)
def test_every_known_input_is_needed(moved, formulation, size, missing):
    """Forgetting any leaves a misfit that the test above would see."""
    record, t, motion = moved
    left = misfit(replace(record, **CHANGES[missing]), t, motion, formulation)
    assert np.sqrt(np.mean(left**2)) > 5 * size


def test_momentum_matrix_times_the_six_is_the_momentum():
    w, six = np.array([[0.3, -0.2, 0.5]]), np.arange(1.0, 7.0)
    np.testing.assert_allclose(momentum_matrix(w)[0] @ six, unpack_symmetric(six) @ w[0])


def test_average_is_of_rows_in_line():
    """Each term over the same twenty rows, and at the time of the last."""
    bed, record = driven_platform(), driven(end=5.0)
    t = record.rate.t
    posed = Posed(record, bed, LedMotion(t, record.attitude.values, record.rate.values, t >= 2.0))
    plain, mean = body_axes(posed), averaged(posed)
    assert len(mean.t) == len(t) - 2 * (SAMPLES - 1)
    i = int(np.flatnonzero(mean.t == t[300]).item())
    np.testing.assert_allclose(mean.A[i], plain.A[281:301].mean(axis=0), rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(mean.b[i], plain.b[281:301].mean(axis=0), rtol=1e-9, atol=1e-12)


# --- Filters that are the same for every term -------------------------------------------------


def solved(rows):
    A, b = rows.A.reshape(-1, rows.A.shape[2]), rows.b.reshape(-1)
    return np.linalg.lstsq(A, b)[0]


def clean():
    bed, record = driven_platform(), driven()
    t = record.rate.t
    piece = np.zeros(len(t), np.int64)
    return Posed(record, bed, LedMotion(t, record.attitude.values, record.rate.values, piece))


@pytest.mark.parametrize("formulation", [smoothed_slope, twice])
def test_one_filter_for_all_keeps_inertia_unbiased(formulation):
    """Square waves, without noise: to 1e-4 of every moment, jumps of the torque and all."""
    found = solved(formulation(clean()))
    np.testing.assert_allclose(found[:3], INERTIA[:3], rtol=1e-4)
    np.testing.assert_allclose(found[6:], COM, atol=0.05e-6)


def test_differentiating_the_rate_alone_biases_inertia():
    """The slope 4 h0 = 0.4 s late against torques that are not: percents of every moment."""
    posed = clean()
    t, w = posed.motion.t, posed.motion.w
    out = track_twice(pace_for(w, 0.1), t, w)
    rows = filtered(posed, twice=True)
    acting = balance(posed).acting
    A, b = acting[:, :, :-1].copy(), acting[:, :, -1]
    A[:, :, :6] += momentum_matrix(out.slope)
    settled = np.isin(t, rows.t)
    found = solved(replace(rows, A=A[settled], b=b[settled]))
    assert np.all(np.abs(found[:3] / INERTIA[:3] - 1) > 0.05)


# --- The simplified model ---------------------------------------------------------------------

BALL = np.array([0.5, 0.5, 0.5, 0.0, 0.0, 0.0])


def swing(six, rate, end=60.0):
    """Return the com (m) that increments make of a free swing without noise."""
    t = np.linspace(0, end, round(end * 100) + 1)
    line = timeline(t, np.zeros(0), MOVE, 3, 0.02, WHEEL, PUSH)
    there = line.attitude_node
    motion = travel(line, body_of(MASS, GRAVITY, six, MASS * COM), w0=rate)
    record = Recording(masses=MOVE, mass_names=("x", "y", "z"), momentum=WHEEL, torque=PUSH)
    bed = platform()
    bed = replace(bed, body=replace(bed.body, inertia_P=unpack_symmetric(six)))
    led = LedMotion(t, motion.q[there], motion.rate[there], np.zeros(len(t), np.int64))
    return solved(increments(Posed(record, bed, led)))


def test_increments_find_the_centre_of_mass_of_a_ball():
    """Where nothing is left out but what masses add to J: within 0.1 um, moves and all."""
    found = swing(BALL, np.radians([0.3, -0.2, 0.1]))
    np.testing.assert_allclose(found, COM, atol=0.1e-6)


def test_increments_err_by_what_they_leave_out():
    """About |w|^2 dJ / (m g) with spin: 20 deg/s and dJ = 0.5 make 0.1 to 1 times 440 um."""
    spin = np.radians([0.0, 0.0, 20.0])
    error = np.linalg.norm(swing(INERTIA, spin, 30.0) - COM)
    size = (spin @ spin) * (INERTIA[2] - INERTIA[0]) / (MASS * GRAVITY)
    assert 0.1 * size < error < size
