"""The rows of every formulation hold for a motion that was made without them."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.dynamics.propagation import body_of
from equipoise.dynamics.timeline import timeline
from equipoise.estimation.motion.fused_motion import LedMotion
from equipoise.estimation.regression.formulations.averaged import ROWS, as_printed, centred_means
from equipoise.estimation.regression.formulations.columns import known_momentum
from equipoise.estimation.regression.formulations.energy import energy
from equipoise.estimation.regression.formulations.kalman import filtered_rates, kalman_torque
from equipoise.estimation.regression.formulations.momentum import (
    body_axes,
    integral,
    laboratory_axes,
    segments,
)
from equipoise.estimation.regression.formulations.rows import Posed, centred
from equipoise.estimation.regression.formulations.simplified import increments, integrated
from equipoise.estimation.regression.formulations.torque import (
    central,
    even_savitzky_golay,
    savitzky_golay,
    torque,
)
from equipoise.estimation.regression.formulations.tracked import extended, tracking
from equipoise.maths.attitude import to_matrix
from equipoise.maths.linalg import unpack_symmetric
from equipoise.maths.sampled.tracking_differentiator import pace_for, track_twice
from equipoise.maths.straight_lines import integral_at
from equipoise.model.recording import Recording, Samples
from equipoise.model.torque_terms import TERMS
from tests.support.builders import (
    COM,
    EVERY_TORQUE,
    GRAVITY,
    INERTIA,
    MASS,
    WARMING,
    body,
    move_at,
    platform,
    travel,
)
from tests.support.driven_records import driven, driven_platform

STEP, END = 0.02, 60.0
MOVE = move_at(20.0, END)
WHEEL = Samples(np.array([0.0, 30, 40]), np.outer([1, 1, 4], [2e-4, -1e-4, 3e-4]))
PUSH = Samples(np.array([0.0, END]), np.outer([1, -2], [1e-5, 2e-5, -1e-5]))
AXES = {"body": body_axes, "laboratory": laboratory_axes}
TRUTH = np.concatenate([INERTIA, COM, EVERY_TORQUE])
# What is left of the rows for the truth, rms in N m s, N m or J, of sizes near 1e-2.
FORMULATIONS = {
    "momentum in segments": (segments, 2e-7),
    "torque, central": (torque(central), 3e-6),
    "torque, Savitzky-Golay": (torque(savitzky_golay), 5e-7),
    "torque, even Savitzky-Golay": (torque(even_savitzky_golay), 5e-7),
    "torque, tracking": (torque(tracking), 5e-7),
    "extended": (extended, 2e-7),
    "averaged": (centred_means, 2e-7),
    "energy": (energy, 2e-8),
}


@pytest.fixture(scope="module")
def moved():
    """A minute of motion with a move, a wheel, a known torque and every torque of the model."""
    t = np.linspace(0, END, round(END / STEP) + 1)
    line = timeline(t, np.zeros(0), MOVE, 3, 1.0, WHEEL, PUSH, temperature=WARMING)
    record = Recording(
        masses=MOVE, mass_names=("x", "y", "z"), momentum=WHEEL, torque=PUSH, temperature=WARMING
    )
    return record, line.t, travel(line, body(EVERY_TORQUE))


def rows_of(record, t, motion, axes):
    whole = LedMotion(t, motion.q, motion.rate, np.zeros(len(t), np.int64))
    return AXES[axes](Posed(record, platform(), whole, TERMS))


def start(motion, axes):
    first = motion.momentum[0]
    return to_matrix(motion.q[0]) @ first if axes == "laboratory" else first


def misfit(record, t, motion, axes):
    """Return what is left of every row, N m s; rows at corners of the travel are left out.

    There the rate jumps, and a row sees the travelling masses as half under way.
    """
    rows = rows_of(record, t, motion, axes)
    left = rows.A @ np.concatenate([INERTIA, COM, EVERY_TORQUE]) - rows.b - start(motion, axes)
    corner = np.min(np.abs(t[:, None] - [20.0, 21.0, 25.0]), axis=1) < 0.5 * STEP
    return left[~corner]


@pytest.mark.parametrize("axes", ["body", "laboratory"])
def test_rows_vanish_for_the_truth(moved, axes):
    """To 2e-8 N m s of momenta of 1e-2.

    In body axes the integral of w x k misses half a step of the jump in rate when masses set off:
    0.02 rad/s x 3e-5 N m s x 0.02 s = 1e-8.
    """
    record, t, motion = moved
    assert np.ptp(motion.momentum) > 1e-2
    assert np.abs(misfit(record, t, motion, axes)).max() < 2e-8


CHANGES = {
    "mass moves": {"masses": None, "mass_names": ()},
    "wheel": {"momentum": None},
    "known torque": {"torque": None},
}


@pytest.mark.parametrize("axes", ["body", "laboratory"])
@pytest.mark.parametrize("missing", CHANGES)
def test_every_known_input_is_needed(moved, axes, missing):
    """Forgetting any leaves a misfit a thousand times as large: the test above would see it."""
    record, t, motion = moved
    assert np.abs(misfit(replace(record, **CHANGES[missing]), t, motion, axes)).max() > 2e-5


def test_travelling_masses_are_part_of_the_known_momentum(moved):
    """Half-way through the travel of all three: k = dJ w + sum m v rho x u, with v = -10 mm/s."""
    record, t, motion = moved
    k, moment = known_momentum(replace(record, momentum=None), platform(), t, motion.rate)
    i = int(np.searchsorted(t, 20.5))
    # x: (0.2, 0, 0.05) x X = (0, 0.05, 0); y: (0, 0.2, 0.05) x Y = (-0.05, 0, 0); z: 0
    travelling = 0.0156 * -0.01 * np.array([-0.05, 0.05, 0.0])
    # dJ of 5 mm is below 0.0156 x 2 x 0.25 x 0.005 = 4e-5 kg m2, at 0.03 rad/s
    np.testing.assert_allclose(k[i], travelling, atol=2e-6)
    np.testing.assert_allclose(moment[i], np.full(3, -0.005 * 0.0156), rtol=1e-9)


@pytest.mark.parametrize("axes", AXES)
def test_centring_removes_the_momentum_at_the_start(moved, axes):
    """Less the mean of the piece, the same truth holds without a constant."""
    record, t, motion = moved
    rows = centred(rows_of(record, t, motion, axes))
    left = rows.A @ np.concatenate([INERTIA, COM, EVERY_TORQUE]) - rows.b
    assert np.sqrt(np.mean(left**2)) < 2e-7
    assert rows.piece is None


def left_of(record, t, motion, formulation):
    """Return what is left of every row for the truth, without the constants of each piece."""
    whole = LedMotion(t, motion.q, motion.rate, np.zeros(len(t), np.int64))
    rows = centred(formulation(Posed(record, platform(), whole, TERMS)))
    return rows.A @ TRUTH - rows.b


def rms(left) -> float:
    return float(np.sqrt(np.mean(left**2)))


@pytest.mark.parametrize(("formulation", "size"), FORMULATIONS.values(), ids=FORMULATIONS)
def test_rows_of_every_formulation_vanish_for_the_truth(moved, formulation, size):
    assert rms(left_of(*moved, formulation)) < size


@pytest.mark.parametrize("missing", CHANGES)
@pytest.mark.parametrize(("formulation", "size"), FORMULATIONS.values(), ids=FORMULATIONS)
def test_every_formulation_needs_every_known_input(moved, formulation, size, missing):
    """Forgetting any leaves a misfit that the test above would see."""
    record, t, motion = moved
    assert rms(left_of(replace(record, **CHANGES[missing]), t, motion, formulation)) > 3 * size


# --- Filters that are the same for every term -------------------------------------------------


def solved(rows):
    rows = centred(rows)
    A, b = rows.A.reshape(-1, rows.A.shape[2]), rows.b.reshape(-1)
    return np.linalg.lstsq(A, b)[0]


def clean():
    bed, record = driven_platform(), driven()
    t = record.rate.t
    piece = np.zeros(len(t), np.int64)
    return Posed(record, bed, LedMotion(t, record.attitude.values, record.rate.values, piece))


SAME = {
    "central": torque(central),
    "Savitzky-Golay": torque(savitzky_golay),
    "even": torque(even_savitzky_golay),
    "tracking": torque(tracking),
    "extended": extended,
    "averaged": centred_means,
    "body": body_axes,
    "laboratory": laboratory_axes,
    "energy": energy,
}


@pytest.mark.parametrize("formulation", SAME.values(), ids=SAME)
def test_one_filter_for_all_keeps_inertia_unbiased(formulation):
    """Square waves, without noise: to 3e-4 of every moment, jumps of the torque and all."""
    found = solved(formulation(clean()))
    np.testing.assert_allclose(found[:3], INERTIA[:3], rtol=3e-4)
    np.testing.assert_allclose(found[6:], COM, atol=0.1e-6)


def test_the_printed_mean_is_late_and_biases_inertia():
    """Twenty rows before each time are 10.5 rows late: parts of a percent to percents of J."""
    found = solved(as_printed(clean()))
    off = np.abs(found[:3] / INERTIA[:3] - 1)
    assert np.all(off > 1e-3)
    assert np.all(off < 0.05)


def test_the_lag_of_the_printed_average_is_reported():
    """With the true J, most of the error; under square waves corners of the rate hide the rest."""
    posed = clean()
    body = replace(posed.testbed.body, inertia_P=unpack_symmetric(INERTIA))
    rows = as_printed(replace(posed, testbed=replace(posed.testbed, body=body)))
    found, reported = solved(rows), solved(replace(rows, b=rows.omitted))
    before, after = (np.abs(x[:3] / INERTIA[:3] - 1) for x in (found, found - reported))
    assert np.all(after < 0.5 * before)


def test_differentiating_the_rate_alone_biases_inertia():
    """The slope 4 h0 = 0.4 s late against torques that are not: percents of every moment."""
    posed = clean()
    t, w = posed.motion.t, posed.motion.w
    rows = torque(central)(posed)
    slope = track_twice(pace_for(w, 0.1), t, w).slope[1:-1]
    sharp = np.gradient(w, t, axis=0)[1:-1]
    J = unpack_symmetric(INERTIA)
    found = solved(replace(rows, b=rows.b + (sharp - slope) @ J))
    assert np.all(np.abs(found[:3] / INERTIA[:3] - 1) > 0.02)


def test_averages_are_of_rows_in_line():
    """Each term over the same twenty rows, none of which reaches over a gap."""
    posed = clean()
    t = posed.motion.t
    cut = posed.motion._replace(piece=(t >= 2.0).astype(np.int64))
    plain, mean = (f(replace(posed, motion=cut)) for f in (body_axes, centred_means))
    assert len(mean.t) == len(t) - 2 * (ROWS - 1)
    i = int(np.argmin(np.abs(mean.t - t[281:301].mean())))
    np.testing.assert_allclose(mean.A[i], plain.A[281:301].mean(axis=0), rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(mean.b[i], plain.b[281:301].mean(axis=0), rtol=1e-9, atol=1e-12)


# --- The simplified model ---------------------------------------------------------------------

BALL = np.array([0.5, 0.5, 0.5, 0.0, 0.0, 0.0])


def swing(six, rate, formulation, end=60.0):
    """Return the com (m) that the model makes of a free swing without noise, and its rows."""
    t = np.linspace(0, end, round(end * 100) + 1)
    line = timeline(t, np.zeros(0), MOVE, 3, 0.02, WHEEL, PUSH)
    there = line.attitude_node
    motion = travel(line, body_of(MASS, GRAVITY, six, MASS * COM), w0=rate)
    record = Recording(masses=MOVE, mass_names=("x", "y", "z"), momentum=WHEEL, torque=PUSH)
    bed = platform()
    bed = replace(bed, body=replace(bed.body, inertia_P=unpack_symmetric(six)))
    led = LedMotion(t, motion.q[there], motion.rate[there], np.zeros(len(t), np.int64))
    rows = formulation(Posed(record, bed, led))
    return solved(rows), rows


@pytest.mark.parametrize("formulation", [increments, integrated])
def test_the_simplified_model_finds_the_centre_of_mass_of_a_ball(formulation):
    """Where nothing is left out but what masses add to J: within 0.1 um, moves and all."""
    found, _ = swing(BALL, np.radians([0.3, -0.2, 0.1]), formulation)
    np.testing.assert_allclose(found, COM, atol=0.1e-6)


@pytest.mark.parametrize("formulation", [increments, integrated])
def test_what_the_simplified_model_leaves_out_is_known(formulation):
    """With spin of 20 deg/s com is off by 0.1 to 1 times |w|^2 dJ / (m g) = 440 um.

    What the rows say they leave out explains that to 2 %.
    """
    spin = np.radians([0.0, 0.0, 20.0])
    found, rows = swing(INERTIA, spin, formulation, 30.0)
    size = (spin @ spin) * (INERTIA[2] - INERTIA[0]) / (MASS * GRAVITY)
    assert 0.1 * size < np.linalg.norm(found - COM) < size
    reported = solved(replace(rows, b=rows.omitted))
    np.testing.assert_allclose(reported, found - COM, atol=0.02 * np.linalg.norm(found - COM))


# --- Integrals --------------------------------------------------------------------------------


def test_the_integral_of_lines_that_jump_is_exact():
    """Three until 1.25, then five, on a grid that does not know of the jump."""
    at, t = np.arange(4.0), np.array([0.0, 1.25, 1.25 + 1e-12, 9.0])
    found = integral_at(at, t, np.array([[3.0], [3.0], [5.0], [5.0]]))
    np.testing.assert_allclose(found[:, 0], [0.0, 3.0, 3.75 + 3.75, 12.5], rtol=1e-9)


def test_integral_of_a_cubic_is_exact():
    """Simpson's rule on even steps; 4 t^3 from 0."""
    t = np.linspace(0, 2, 9)
    np.testing.assert_allclose(integral(t, 4 * t[:, None] ** 3)[::2, 0], t[::2] ** 4, atol=1e-13)


def test_integral_of_two_rows():
    """Too few for a parabola: the first value over the step."""
    found = integral(np.array([1.0, 3.0]), np.array([[2.0, 5.0], [4.0, 5.0]]))
    assert found.tolist() == [[0.0, 0.0], [4.0, 10.0]]


def test_the_kalman_filtered_balance_finds_inertia_from_a_wrong_guess():
    """J of the guess 5 to 10 % off, no noise: 1 % of every moment is left of that."""
    found = solved(kalman_torque(clean()))
    np.testing.assert_allclose(found[:3], INERTIA[:3], rtol=0.01)


def test_the_filter_foresees_a_motion_that_it_knows():
    """J and com of the guess true, a spin of 20 deg/s: rates come out as they went in."""
    spin = np.radians([3.0, -2.0, 20.0])
    t = np.linspace(0, 10.0, 1001)
    line = timeline(t, np.zeros(0), None, 3, 0.02)
    motion = travel(line, body_of(MASS, GRAVITY, INERTIA, MASS * COM), w0=spin)
    there = line.attitude_node
    led = LedMotion(t, motion.q[there], motion.rate[there], np.zeros(len(t), np.int64))
    off = filtered_rates(Posed(Recording(), platform(), led)) - led.w
    assert np.abs(off).max() < 1e-3 * np.ptp(led.w, axis=0).min()
