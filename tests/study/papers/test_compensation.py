"""Moves by what a printed method found: from below, by the whole offset aside, to it at the end."""

from dataclasses import replace

import numpy as np

from equipoise.control.laws.registry import LAWS
from equipoise.io.testbed.presets import read_preset
from equipoise.model.estimate import COM, Estimate, Parameter
from equipoise.study.papers.compensation import ROUNDS, ROWS, State, after_swing, compensation
from tests.support.outcomes import of_use

BED = read_preset("unb")
LAW = compensation("simplified_increments", ("inertia_P_xy",))
STATE, PARAMS = LAW.begin(BED, np.zeros(3))


def found(com, usable=True):
    """An estimate of the centre of mass, masses at home."""
    parameters = tuple(Parameter(name, "m", x, 1e-6) for name, x in zip(COM, com, strict=True))
    return Estimate("simplified_increments", of_use(usable), parameters, 1e-12 * np.eye(3))


def test_it_begins_by_hanging_and_swings_for_500_rows():
    """6 sds of 57 um aside, 2 of 40 um of the height, from 90 um below: 240 * sqrt(2) - 10 um."""
    down = 6 * 40e-6 * np.sqrt(2) + 2 * 40e-6 - 90e-6
    np.testing.assert_allclose(STATE.shift, [0.0, 0.0, -down], atol=1e-12)
    measurement = PARAMS.measurement
    assert (measurement.method, measurement.hold) == ("simplified_increments", ("inertia_P_xy",))
    assert measurement.duration * BED.attitude.rate == ROWS == 500


def test_a_move_takes_the_whole_offset_aside_and_keeps_a_fifth_of_the_depth():
    """r + s = (20, -30, -390) um; J is 10 % sure, so two sds of 390 um are 78 um."""
    state = State(np.array([0.0, 0.0, -300e-6]))
    moved = after_swing(state, found([20e-6, -30e-6, -90e-6]), PARAMS)
    np.testing.assert_allclose(moved.shift, [-20e-6, 30e-6, 12e-6], atol=1e-15)
    assert (moved.swings, moved.finished) == (1, ())


def test_a_platform_above_is_lowered_to_the_target():
    moved = after_swing(State(np.zeros(3)), found([0.0, 0.0, 40e-6]), PARAMS)
    np.testing.assert_allclose(moved.shift, [0.0, 0.0, -40e-6], atol=1e-15)


def test_the_last_move_goes_all_the_way_and_ends():
    state = State(np.array([0.0, 0.0, -300e-6]), swings=ROUNDS - 1)
    moved = after_swing(state, found([20e-6, -30e-6, -90e-6]), PARAMS)
    np.testing.assert_allclose(moved.shift, [-20e-6, 30e-6, 90e-6], atol=1e-15)
    assert [reason.code for reason in moved.finished] == ["at_place"]


def test_what_cannot_be_used_moves_nothing_and_ends_after_the_last_swing():
    state = State(np.array([0.0, 0.0, -300e-6]))
    still = after_swing(state, found([1.0, 1.0, 1.0], usable=False), PARAMS)
    np.testing.assert_array_equal(still.shift, state.shift)
    assert still.finished == ()
    over = after_swing(replace(state, swings=ROUNDS - 1), found([1.0] * 3, usable=False), PARAMS)
    assert over.finished[0].code == "com_not_shown"


def test_it_is_no_law_of_the_list():
    """It runs as one; the list has what people should take."""
    assert LAW.card.name not in LAWS
    assert LAW.card.needs == ("masses", "gyro", "attitude")
