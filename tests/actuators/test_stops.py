"""When masses stood, and the effect of the error of each stop."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.actuators.mass_errors import mass_errors
from equipoise.actuators.stops import is_logged_in_steps, response, stops_of, travels
from equipoise.maths.straight_lines import read_at
from equipoise.model.recording import Samples
from tests.support.builders import sliding_masses

SPEED, SD = 0.01, 3e-4
X, Y, Z = sliding_masses(accuracy=SD)


T = np.array([0.0, 10, 11, 20, 22, 30])


def track(*columns) -> Samples:
    """Millimetres at 0, 10, 11, 20, 22, 30 s."""
    return Samples(T, np.array(columns).T * 1e-3)


def shares(found) -> list[list[float]]:
    """Return the shares of each unknown at these times."""
    return read_at(T, found.response.t, found.response.values).T.tolist()


HOME = [0, 0, 0, 0, 0, 0]
ONCE = [0, 0, 10, 10, 10, 10]
TWICE = [0, 0, 10, 10, 30, 30]


def test_travels_by_hand():
    """Rows 1 to 2 and 3 to 4 are travels, the rest is standing."""
    t, d = track(TWICE).t, track(TWICE).values[:, 0]
    assert travels(t, d, SPEED) == [(1, 2), (3, 4)]


def test_a_travel_of_many_rows_is_one():
    """Ten rows on the way from 10 to 11 s are one travel; readout noise is not."""
    t = np.concatenate([np.arange(0.0, 10), np.linspace(10, 11, 11), np.arange(12.0, 20)])
    d = np.interp(t, [10, 11], [0, 0.01]) + 1e-5 * (-1.0) ** np.arange(len(t))
    assert travels(t, d, SPEED) == [(10, 20)]


def test_a_travel_that_is_logged_in_very_many_steps_has_one_stop():
    """40 mm in steps of 1 mm each 0.2 s, from 5 s on: no stop between two; one of 4 s is one."""
    t = np.arange(0.0, 30.0, 0.05)
    steps = 1e-3 * np.clip(np.floor((t - 5.0) / 0.2), 0, 40)
    coarse = replace(X, resolution=1e-3, speed=0.05)  # a step lasts 0.4 s at the least speed
    assert len(travels(t, steps, coarse.speed)) == 40
    assert len(stops_of(t, steps, coarse)) == 1
    assert len(stops_of(t, steps + 1e-3 * (t > 20.0) + 1e-3 * (t > 24.0), coarse)) == 3


def test_few_steps_have_an_error_each():
    """Between two of five steps 0.2 s apart the mass is somewhere near: its log is that coarse."""
    t = np.arange(0.0, 30.0, 0.05)
    steps = 2e-3 * np.clip(np.floor((t - 5.0) / 0.2), 0, 5)
    assert len(stops_of(t, steps, replace(X, resolution=2e-3, speed=0.05))) == 5


@pytest.mark.parametrize(
    ("passed", "accuracy", "in_steps"),
    [
        ([0, 1, 2, 3, 4, 5], 6e-4, True),
        ([0, 1, 2, 5, 5, 5], 6e-4, False),  # commanded by way of two corners
        ([0, 0.7, 2.2, 3, 4.4, 5], 6e-4, False),  # on its way at any place
        ([0, 1, 2, 3, 4, 5], 4e-4, False),  # its steps are where it stops
        ([0, 1, 1, 1, 1, 1], 6e-4, False),  # one step
    ],
)
def test_a_log_in_steps_passes_some_of_them(passed, accuracy, in_steps):
    (mass, *_) = sliding_masses(accuracy, 2e-3)
    t = 0.2 * np.arange(len(passed))
    assert is_logged_in_steps(t, 2e-3 * np.array(passed), mass) is in_steps


def test_standing_still_has_no_travel():
    """A mass that never moves, and one that is moving from the first row to the last."""
    t = np.arange(5.0)
    assert travels(t, np.zeros(5), SPEED) == []
    assert travels(t, 0.01 * t, SPEED) == [(0, 4)]


def test_the_stop_error_ramps_up_holds_and_ramps_down_by_hand():
    """Arriving from 10 to 11 s, leaving from 20 to 22 s: 0, then 1, then half-way gone at 21 s."""
    t = np.array([0.0, 10, 10.5, 11, 20, 21, 22, 30])
    assert response(t, (1, 3), (4, 6)).tolist() == [0, 0, 0.5, 1, 1, 0.5, 0, 0]


def test_a_stop_error_at_a_record_edge_acts_from_the_first_row_or_to_the_last():
    """A stop that the record begins with acts at once; one that it ends with, to the end."""
    t = np.arange(5.0)
    assert response(t, (0, 0), (2, 3)).tolist() == [1, 1, 1, 0, 0]
    assert response(t, (1, 2), (4, 4)).tolist() == [0, 0, 1, 1, 1]


def test_home_has_no_error():
    """Starting at home, one move: one unknown that acts after the travel, none for x at home."""
    found = mass_errors(track(ONCE, HOME, HOME), (X, Y, Z))
    assert found.names == ("error_x_1",)
    assert found.owner.tolist() == [[0, 0]]
    assert found.sd.tolist() == [SD]
    assert shares(found) == [[0, 0, 1, 1, 1, 1]]


def test_off_home_start_has_an_error_of_its_own():
    """A mass already 20 mm out stands there with an error, until it leaves."""
    found = mass_errors(track([20, 20, 30, 30, 30, 30]), (X,))
    assert found.names == ("error_x_1", "error_x_2")
    assert shares(found) == [[1, 1, 0, 0, 0, 0], [0, 0, 1, 1, 1, 1]]


def test_two_moves_hand_the_error_over():
    """Each stop has its own error; during travel the first goes as the second comes."""
    found = mass_errors(track(TWICE, HOME, ONCE), (X, Y, Z))
    assert found.names == ("error_x_1", "error_x_2", "error_z_1")
    assert found.owner.tolist() == [[0, 0], [0, 1], [2, 2]]
    assert shares(found)[:2] == [[0, 0, 1, 1, 0, 0], [0, 0, 0, 0, 1, 1]]


def test_off_home_and_never_moved():
    """Standing 20 mm out for the whole record: one error that always acts."""
    found = mass_errors(track([20] * 6), (X,))
    assert shares(found) == [[1] * 6]


@pytest.mark.parametrize("masses", [(replace(X, accuracy=0.0),), ()])
def test_exact_masses_have_no_errors(masses):
    """Accuracy 0, or no masses: nothing unknown."""
    found = mass_errors(track(TWICE) if masses else None, masses)
    assert found.response is None
    assert found.names == ()
    assert found.owner.shape == (0, 2)
    assert found.sd.shape == (0,)


def test_each_mass_keeps_its_own_accuracy():
    """x exact, y to 0.3 mm, z to 1 mm."""
    masses = (replace(X, accuracy=0.0), Y, replace(Z, accuracy=1e-3))
    found = mass_errors(track(ONCE, ONCE, ONCE), masses)
    assert found.owner.tolist() == [[1, 0], [2, 1]]
    assert found.sd.tolist() == [SD, 1e-3]
