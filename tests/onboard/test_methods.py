"""What a board estimates is what the library's own methods estimate from the same rows."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.estimation.filters.conclusion import estimate
from equipoise.estimation.methods import ekf_9
from equipoise.estimation.motion.fused_motion import LedMotion
from equipoise.estimation.regression.formulations.momentum import body_axes
from equipoise.estimation.regression.formulations.rows import Posed, Rows
from equipoise.estimation.regression.solvers.factored import (
    learn_factored,
    place,
    restart_first,
    variance_of,
)
from equipoise.estimation.regression.solvers.recursion import Plan, passed, unfiltered
from equipoise.io.testbed.presets import read_preset
from equipoise.model.errors import InputError
from equipoise.model.recording import Recording, Samples
from equipoise.onboard.program import camera_filter, momentum_recursion
from equipoise.onboard.program.board import board_of
from equipoise.onboard.trial import plain_answer
from tests.support.onboard_rows import recording_of, simulated_rows

TARGET = np.array([0.0, 0.0, -1e-4])


def answered(method, bed, rows):
    """Return what the interpreter answers to rows, and the memory afterwards."""
    board, memory = board_of(method, "ivanov_25s", bed, TARGET)
    answer = plain_answer(board, memory)
    return np.array([answer(row) for row in rows]), memory


# --- ekf_9 -----------------------------------------------------------------------------------


@pytest.mark.parametrize(("preset", "seed"), [("sputnix", 3), ("nanosat", 4), ("bologna", 5)])
def test_the_filter_is_ekf_9(preset, seed):
    """To nine digits, with masses that move and stop, and row by row."""
    bed = read_preset(preset)
    if bed.attitude.rate > 10:
        bed = replace(bed, attitude=replace(bed.attitude, rate=10.0))
    rows = simulated_rows(bed, seed, 20.0)
    found = estimate(ekf_9.METHOD.card, ekf_9.KIND, recording_of(rows), bed)
    own, _ = answered("ekf_9", bed, rows)
    sd = found.course.sd
    np.testing.assert_allclose(own[:, 3:6], sd, rtol=1e-9)
    assert np.abs((own[:, :3] - found.course.values) / sd).max() < 1e-9
    assert np.ptp(rows[:, 8:], axis=0).max() > 0  # a mass did move


def test_behind_a_gap_the_filter_restarts_as_ekf_9_does():
    bed = read_preset("sputnix")
    rows = simulated_rows(bed, 3, 24.0)
    rows = np.vstack([rows[:40], rows[60:]])
    found = estimate(ekf_9.METHOD.card, ekf_9.KIND, recording_of(rows), bed)
    own, _ = answered("ekf_9", bed, rows)
    assert np.abs((own[:, :3] - found.course.values) / found.course.sd).max() < 1e-9


def test_rows_that_are_rare_are_reached_by_several_steps():
    """A camera of 2 Hz: two steps of a quarter of a second each."""
    bed = read_preset("sputnix")
    bed = replace(bed, attitude=replace(bed.attitude, rate=2.0))
    rows = simulated_rows(bed, 3, 30.0)
    found = estimate(ekf_9.METHOD.card, ekf_9.KIND, recording_of(rows), bed)
    own, _ = answered("ekf_9", bed, rows)
    assert np.median(np.diff(rows[:, 0])) == pytest.approx(0.5)
    assert np.abs((own[:, :3] - found.course.values) / found.course.sd).max() < 1e-9


def test_a_method_says_which_sensor_it_lacks():
    bed = read_preset("nanosat")
    with pytest.raises(InputError, match="attitude sensor"):
        camera_filter.filter_of(replace(bed, attitude=None))
    with pytest.raises(InputError, match="gyro"):
        momentum_recursion.recursion_on(replace(bed, gyro=None))


# --- momentum_recursive ----------------------------------------------------------------------


def pieces(bed, seed, places):
    """Return rows of pieces of 41 rows, masses at rest at each of the places (m)."""
    found = []
    for k, place_of_masses in enumerate(places):
        rows = simulated_rows(bed, seed + k, 4.1)[:41]
        rows[:, 0] += 20.0 * k - rows[0, 0]
        rows[:, 8:] = place_of_masses
        found.append(rows)
    return found


def by_the_library(bed, found):
    """Return what the method's own recursion makes of the same rows."""
    parts = []
    for rows in found:
        motion = LedMotion(rows[:, 0], rows[:, 1:5], rows[:, 5:8], np.zeros(len(rows), np.int64))
        record = Recording(masses=Samples(rows[:, 0], rows[:, 8:]))
        parts.append(body_axes(Posed(record, bed, motion)))
    piece = np.repeat(np.arange(len(parts)), [len(part.t) for part in parts])
    whole = Rows(
        np.concatenate([part.t for part in parts]), np.concatenate([part.A for part in parts]),
        np.concatenate([part.b for part in parts]), parts[0].names, piece,
    )  # fmt: skip
    return passed(Plan(unfiltered), bed, whole)


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_the_recursion_is_momentum_recursive(seed):
    """Integrals by parabolas, pieces with constants of their own, masses off home.

    The library's P, not in factors, loses digits of its own: 1e-5 of an sd is left to that.
    """
    bed = read_preset("nanosat")
    found = pieces(bed, seed, ([0, 0, 0], [5e-3, 0, 0], [0, -6e-3, 4e-3]))
    library = by_the_library(bed, found)
    own, memory = answered("momentum_recursive", bed, np.vstack(found))
    c = momentum_recursion.UNKNOWNS
    np.testing.assert_allclose(own[-1, 3:6], library.sd[-1, 6:], rtol=1e-5)
    off = (memory.method.x[3:] - library.state.x[:c]) / library.sd[-1]
    assert np.abs(off).max() < 1e-5


def test_no_row_is_taken_while_a_mass_travels():
    bed = read_preset("nanosat")
    rows = pieces(bed, 1, ([0, 0, 0],))[0]
    still, _ = answered("momentum_recursive", bed, rows[:21])
    rows[21:, 8] = np.linspace(2.5e-4, 5e-3, 20)  # 2.5 mm/s; the board calls 0.4 mm/s travelling
    own, memory = answered("momentum_recursive", bed, rows)
    np.testing.assert_array_equal(own[-1, :6], still[-1, :6])
    assert memory.method.row_count[0] == 1


# --- In factors ------------------------------------------------------------------------------


def test_the_factors_solve_least_squares():
    """Against the normal equations, and P against their inverse."""
    rng = np.random.default_rng(5)
    sd, A, b = np.array([1.0, 10.0, 0.1, 2.0]), rng.normal(size=(12, 4)), rng.normal(size=12)
    x, D, U, gain = np.zeros(4), sd**2, np.zeros(6), np.zeros(4)
    for row, value in zip(A, b, strict=True):
        learn_factored(x, D, U, row.copy(), float(value), 0.25, gain)
    P = np.linalg.inv(A.T @ A / 0.25 + np.diag(sd**-2.0))
    np.testing.assert_allclose(x, P @ A.T @ b / 0.25, rtol=1e-9)
    np.testing.assert_allclose([variance_of(D, U, i) for i in range(4)], np.diag(P), rtol=1e-9)


def test_the_first_unknowns_restart_and_the_others_keep_what_is_known_of_them():
    rng = np.random.default_rng(6)
    x, D, U, gain = np.zeros(4), np.ones(4), np.zeros(6), np.zeros(4)
    for _ in range(9):
        learn_factored(x, D, U, rng.normal(size=4), float(rng.normal()), 0.1, gain)
    before, known = x.copy(), [variance_of(D, U, i) for i in (2, 3)]
    restart_first(x, D, U, 2, 7.0)
    np.testing.assert_array_equal(x, [0.0, 0.0, before[2], before[3]])
    assert [variance_of(D, U, i) for i in (2, 3)] == known
    assert [variance_of(D, U, i) for i in (0, 1)] == [7.0, 7.0]


def test_the_triangle_is_stored_without_gaps():
    assert [place(i, j) for j in range(1, 4) for i in range(j)] == list(range(6))
