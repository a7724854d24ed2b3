"""Where masses were between two answers of their board, by hand and with answers that jitter."""

import numpy as np
import pytest

from equipoise.actuators.stops import stops_of
from equipoise.hardware.links.mass_interpolation import Answer, on_the_way, rows_to
from equipoise.hardware.links.row_buffer import RowBuffer
from equipoise.hardware.transport.driver_protocol import BoardState, Phase
from equipoise.io.testbed.presets import read_preset
from equipoise.model.hardware import Axis

SPEED = np.array([8e-3, 8e-3, 8e-3])
MASSES = read_preset("nanosat").masses
NAMES = tuple(mass.name for mass in MASSES)
GOALS = np.array([4e-3, -2e-3, 0.0])


def bools(*values):
    return np.array(values, dtype=bool)


def test_starts_and_arrivals_by_hand():
    """At 8 mm/s: 0.2 mm in an answer's 0.05 s are 0.025 s of way, before the answer at a start."""
    still = Answer(1.0, np.zeros(3), bools(0, 0, 0))
    rows, now = rows_to(still, 1.05, np.array([0.2e-3, 0, 0]), bools(1, 0, 0), SPEED)
    assert [row.t for row in rows] == pytest.approx([1.025, 1.05])
    np.testing.assert_allclose([row.at[0] for row in rows], [0, 0.2e-3], atol=1e-12)
    assert now.going.tolist() == [True, False, False]
    # It arrives: 0.08 mm are 0.01 s behind the answer before.
    rows, now = rows_to(now, 1.10, np.array([0.28e-3, 0, 0]), bools(0, 0, 0), SPEED)
    assert [row.t for row in rows] == pytest.approx([1.06, 1.10])
    np.testing.assert_allclose([row.at[0] for row in rows], [0.28e-3, 0.28e-3], atol=1e-12)
    assert not now.going.any()


def test_a_commanded_mass_still_at_rest_is_not_interpolated_as_creeping():
    still = Answer(1.0, np.zeros(3), bools(0, 0, 0))
    _, now = rows_to(still, 1.05, np.zeros(3), bools(1, 0, 0), SPEED)
    rows, _ = rows_to(now, 1.10, np.array([0.16e-3, 0, 0]), bools(1, 0, 0), SPEED)
    assert [row.t for row in rows] == pytest.approx([1.08, 1.10])


def test_an_answer_that_comes_twice_on_the_way_is_no_stop():
    going = Answer(1.0, np.zeros(3), bools(1, 0, 0))
    rows, now = rows_to(going, 1.01, np.zeros(3), bools(1, 0, 0), SPEED)
    assert rows == []
    assert now is going


def test_which_masses_have_still_to_go():
    """A step is 1.25 um and the last digit 1 um: 2 um short is there, 3 um short is not."""
    axes = [Axis("x", "X", 800e3, 0.0), Axis("y", "Y", 800e3, 0.0)]
    where, goal = {"x": 1e-3, "y": 1e-3}, {"x": 1.002e-3, "y": 1.003e-3}
    assert on_the_way(BoardState(Phase.MOVING, None, where, goal), axes) == {"x": False, "y": True}
    assert on_the_way(BoardState(Phase.READY, None, where, goal), axes) == {"x": False, "y": False}


def test_a_record_that_begins_has_a_row_of_masses_however_short_it_is():
    """Rows of masses that stand are a second apart, but none of them is of before its beginning."""
    buffer, stand = RowBuffer(MASSES), dict.fromkeys(NAMES, 1e-3)
    buffer.masses(stand, {}, 1.0)
    buffer.begin()
    buffer.masses(stand, {}, 1.0)  # that answer once more
    assert buffer.taken().masses is None
    buffer.masses(stand, {}, 1.05)
    rows = buffer.taken().masses
    assert (rows.t.tolist(), rows.values.tolist()) == ([1.05], [[1e-3, 1e-3, 1e-3]])


def test_a_mass_that_is_sent_on_by_little_and_little_is_followed():
    """20 um each 0.1 s at 8 mm/s, always with some way to go: rows are 0.1 s old at most."""
    received = RowBuffer(MASSES)
    for k, t in enumerate(np.arange(0.0, 5.0, 0.05)):
        at = {name: 20e-6 * (k // 2) for name in NAMES}
        received.masses(at, dict.fromkeys(NAMES, True), t)
    rows = received.taken().masses
    assert np.diff(rows.t).max() < 0.1 + 1e-9
    requested = np.arange(1.0, 5.0, 0.05)
    behind = 20e-6 * (np.arange(20, 100) // 2) - np.interp(requested, rows.t, rows.values[:, 0])
    assert np.abs(behind).max() <= 20e-6 + 1e-12


def truth(t):
    """Return where masses are: commanded at 0.5 s to go to GOALS, and home again at 2 s."""
    out = np.clip((t - 0.52) * 8e-3, 0, np.abs(GOALS)) * np.sign(GOALS)
    back = np.clip((t - 2.02) * 8e-3, 0, np.abs(GOALS)) * np.sign(GOALS)
    return out - back


@pytest.mark.parametrize("seed", range(8))
def test_answers_that_jitter_show_the_moves_there_were(seed):
    """Asked each 50 ms, answered up to 20 ms late, at times two at once; three masses, two moves.

    Each mass that moved has stood three times. Rows are wrong by no more than the lateness and the
    time between answers can make them: 70 ms at a start or an arrival, 20 ms on the way.
    """
    rng = np.random.default_rng(seed)
    received = RowBuffer(MASSES)
    for requested in np.arange(0.0, 4.0, 0.05):
        late = rng.choice([0.0, 0.02, 0.06], p=[0.5, 0.4, 0.1]) * rng.random()
        at = np.round(truth(requested), 6)
        goal = GOALS if 0.5 <= requested < 2.0 else np.zeros(3)
        wants = {n: bool(abs(a - g) > 2e-6) for n, a, g in zip(NAMES, at, goal, strict=True)}
        received.masses(dict(zip(NAMES, at, strict=True)), wants, requested + late)
    rows = received.taken().masses
    assert np.all(np.diff(rows.t) > 0)
    wrong = np.abs(rows.values - np.array([truth(t) for t in rows.t]))
    assert wrong.max() < 8e-3 * 0.07
    stood = [len(stops_of(rows.t, rows.values[:, k], MASSES[k])) for k in range(3)]
    assert stood == [len(stops_of(*exact(k), MASSES[k])) for k in range(3)]


def exact(k):
    """Return the rows of a mass as it went, at the corners."""
    taken = abs(GOALS[k]) / 8e-3
    t = np.array([0.0, 0.52, 0.52 + taken, 2.02, 2.02 + taken, 4.0]) + 1e-9 * np.arange(6)
    return t, np.array([truth(x)[k] for x in t])
