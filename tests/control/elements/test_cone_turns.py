"""What is left of an offset, from the masses' way in a turn."""

import numpy as np
import pytest

from equipoise.control.elements.cone_turns import counted, first_turn, swept

STEP, TURN, ANGLE, RATE = 0.1, 30.0, 0.2, 0.012


def run(turns, offset, given=lambda _: True):
    """Turns of a cone, with masses that follow an offset (m) of the time."""
    course, fading = first_turn(5e-5), RATE / np.sin(ANGLE) ** 2
    for k in range(round(turns * TURN / STEP) + 1):
        t = k * STEP
        turn = 2 * np.pi * t / TURN
        down = np.array([np.sin(ANGLE) * np.cos(turn), np.sin(ANGLE) * np.sin(turn),
                         -np.cos(ANGLE)])  # fmt: skip
        if given(t):
            course = swept(course, down, STEP)
        wobble = 2e-5 * np.array([np.cos(turn), np.sin(turn), 0.0])
        course = counted(course, int((t + 1e-9) / TURN), wobble - offset(t), fading)
    return course


def test_what_is_left_is_the_offset_at_the_end_of_the_turn():
    """An exponential; what goes round with the cone, 20 um of it, does not show."""
    start = np.array([0.0, 0.0, 8e-5])
    course = run(4, lambda t: start * np.exp(-RATE * t))
    assert course.whole == 4
    assert course.rests == pytest.approx(
        [8e-5 * np.exp(-RATE * 3 * TURN), 8e-5 * np.exp(-RATE * 4 * TURN)], rel=0.02
    )
    assert course.rest == course.rests[0]
    np.testing.assert_allclose(course.mean[:2], 0, atol=1e-7)


def test_nothing_is_said_before_two_turns():
    assert run(1, lambda _: np.zeros(3)).rests == (5e-5, 5e-5)


def test_masses_that_stand_without_torque_show_nothing():
    """Rows without the requested torque do not count, so nothing may have faded."""
    course = run(4, lambda _: np.full(3, 3e-6), given=lambda _: False)
    assert course.rest == np.inf
    some = run(4, lambda t: np.array([0, 0, 1e-6 * t / TURN]), given=lambda t: t % TURN < 3)
    whole = run(4, lambda t: np.array([0, 0, 1e-6 * t / TURN]))
    assert some.rest > 10 * whole.rest
