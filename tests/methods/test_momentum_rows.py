"""The rows of the momentum integral hold for a motion that was made without them."""

from dataclasses import replace

import numpy as np
import pytest
from builders import COM, EVERY_TORQUE, INERTIA, MASS, body, move_at, platform, travel

from equipoise.dynamics.timeline import timeline
from equipoise.estimation.formulations.columns import known_momentum
from equipoise.estimation.formulations.momentum import body_axes, integral, laboratory_axes
from equipoise.estimation.formulations.rows import Posed, centred
from equipoise.estimation.led_motion import LedMotion
from equipoise.maths.attitude import to_matrix
from equipoise.model.recording import Recording, Samples
from equipoise.model.torque_terms import TERMS

STEP, END = 0.02, 60.0
MOVE = move_at(20.0, END)
WHEEL = Samples(np.array([0.0, 30, 40]), np.outer([1, 1, 4], [2e-4, -1e-4, 3e-4]))
PUSH = Samples(np.array([0.0, END]), np.outer([1, -2], [1e-5, 2e-5, -1e-5]))
AXES = {"body": body_axes, "laboratory": laboratory_axes}


@pytest.fixture(scope="module")
def moved():
    """A minute of motion with a move, a wheel, a known torque and every torque of the model."""
    t = np.linspace(0, END, round(END / STEP) + 1)
    line = timeline(t, np.zeros(0), MOVE, 3, 1.0, WHEEL, PUSH)
    record = Recording(masses=MOVE, mass_names=("x", "y", "z"), momentum=WHEEL, torque=PUSH)
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
    assert np.sqrt(np.mean(left**2)) < 2e-8
    assert rows.piece is None


def test_integral_of_a_cubic_is_exact():
    """Simpson's rule on even steps; 4 t^3 from 0."""
    t = np.linspace(0, 2, 9)
    np.testing.assert_allclose(integral(t, 4 * t[:, None] ** 3)[::2, 0], t[::2] ** 4, atol=1e-13)


def test_integral_of_two_rows():
    """Too few for a parabola: the first value over the step."""
    found = integral(np.array([1.0, 3.0]), np.array([[2.0, 5.0], [4.0, 5.0]]))
    assert found.tolist() == [[0.0, 0.0], [4.0, 10.0]]
