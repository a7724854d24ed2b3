import numpy as np
import pytest
from scipy.stats import chi2

from equipoise.maths.straight_lines import read_at
from equipoise.model.bench_requests import in_steps
from equipoise.model.errors import InputError, MoveRefused
from equipoise.model.testbed import Fault
from equipoise.model.units import MM
from equipoise.simulation.actuator import (
    CARRIAGE,
    REAL,
    REPORTED,
    checked,
    displacement,
    halted,
    left_at,
    reported_rows,
    retracked,
    sent,
    tracked,
)


class Motors:
    """Masses and their track, driven one command after the other."""

    def __init__(self, *masses, faults=(), seed=0):
        self.masses, self.faults, self.rng = masses, faults, np.random.default_rng(seed)
        self.travel = left_at(masses, {}, self.rng)
        self.track = tracked(self.travel)

    def move(self, now, **targets_mm):
        targets = {name: mm * MM for name, mm in targets_mm.items()}
        goals = checked(self.travel, now, targets, self.masses)
        self.travel = sent(self.travel, now, goals, self.masses, self.faults, self.rng)
        self.track = retracked(self.track, self.travel, now)

    def stop(self, now):
        self.travel = halted(self.travel, now)
        self.track = retracked(self.track, self.travel, now)

    def at(self, now, row=REAL):
        return displacement(self.travel, now)[row] / MM


def test_travel_takes_as_long_as_it_should(rail):
    """30 mm at 10 mm/s from t = 2 s: half way at 3.5 s, there at 5 s."""
    motors = Motors(rail())
    motors.move(2.0, x=30)
    for now, mm in ((2.0, 0.0), (3.5, 15.0), (5.0, 30.0), (60.0, 30.0)):
        np.testing.assert_allclose(motors.at(now), mm, atol=1e-12)
    np.testing.assert_allclose(motors.track.t, [0.0, 2.0, 5.0])
    np.testing.assert_allclose(motors.track.real[:, 0], [0.0, 0.0, 0.03])


def test_masses_travel_side_by_side_and_do_not_disturb_each_other(rail):
    """x needs 3 s from 0 s; y needs 1 s from 1 s; corners at 0, 1, 2 and 3 s."""
    motors = Motors(rail("x"), rail("y"))
    motors.move(0.0, x=30)
    motors.move(1.0, y=-10)
    np.testing.assert_allclose(motors.track.t, [0.0, 1.0, 2.0, 3.0])
    by_hand = [[0.0, 0.0], [0.01, 0.0], [0.02, -0.01], [0.03, -0.01]]
    np.testing.assert_allclose(motors.track.real, by_hand, atol=1e-15)
    np.testing.assert_allclose(motors.track.reported, by_hand, atol=1e-15)


def test_new_command_on_the_way_starts_from_where_the_mass_is(rail):
    """Sent to 30 mm, called back to 5 mm when at 20 mm: 1.5 s back."""
    motors = Motors(rail())
    motors.move(0.0, x=30)
    motors.move(2.0, x=5)
    np.testing.assert_allclose(motors.track.t, [0.0, 2.0, 3.5])
    np.testing.assert_allclose(motors.track.real[:, 0], [0.0, 0.02, 0.005])


def test_stop_halts_all_where_they_are(rail):
    motors = Motors(rail("x"), rail("y", accuracy=MM, backlash=MM))
    motors.move(0.0, x=30, y=-50)
    there = motors.at(1.7)
    motors.stop(1.7)
    np.testing.assert_array_equal(motors.at(1.7), there)
    np.testing.assert_array_equal(motors.at(99.0), there)
    np.testing.assert_allclose(motors.at(99.0, REPORTED), [17.0, -17.0])
    np.testing.assert_allclose(motors.track.t, [0.0, 0.05, 1.7])  # y crosses half its play first


def test_a_mass_stands_until_its_play_is_taken_up(rail):
    """2 mm of play at 10 mm/s: from its middle 0.1 s, to the other side 0.2 s, onwards at once."""
    motors = Motors(rail(backlash=2 * MM))
    motors.move(0.0, x=10)
    for now, reported, real in ((0.1, 1.0, 0.0), (0.55, 5.5, 4.5), (1.0, 10.0, 9.0)):
        np.testing.assert_allclose(motors.at(now, REPORTED), reported)
        np.testing.assert_allclose(motors.at(now), real, atol=1e-12)
    motors.move(2.0, x=5)
    for now, real in ((2.2, 9.0), (2.35, 7.5), (2.5, 6.0)):
        np.testing.assert_allclose(motors.at(now), real)
    motors.move(3.0, x=0)
    np.testing.assert_allclose(motors.at(3.25), 3.5)
    motors.move(3.5, x=1.5)
    np.testing.assert_allclose(motors.at(9.0), 1.0)  # 1.5 mm do not take it along
    np.testing.assert_allclose(motors.track.t, [0, 0.1, 1, 2, 2.2, 2.5, 3, 3.5, 3.65])


@pytest.mark.parametrize(
    ("requested", "whole"), [(3.4, 3.5), (-3.4, -3.5), (3.2, 3.0), (50.0, 50.0)]
)
def test_targets_are_rounded_to_whole_steps(rail, requested, whole):
    mass = rail(resolution=0.5 * MM)
    assert in_steps(mass, requested * MM) == pytest.approx(whole * MM)
    assert in_steps(rail(), requested * MM) == requested * MM
    motors = Motors(mass)
    motors.move(0.0, x=requested)
    np.testing.assert_allclose(motors.at(9.0, REPORTED), whole)
    np.testing.assert_allclose(motors.at(9.0, REAL), whole)


def test_a_move_to_where_it_is_moves_nothing(rail):
    motors = Motors(rail(resolution=MM, accuracy=MM))
    motors.move(0.0, x=10)
    there = motors.at(5.0)
    motors.move(5.0, x=10.3)
    np.testing.assert_array_equal(motors.at(9.0), there)


@pytest.mark.parametrize("requested", [50.01, -50.01, 1e9])
def test_beyond_the_rail_is_refused_and_says_why(rail, requested):
    motors = Motors(rail("x"), rail("y"))
    motors.move(0.0, x=20)
    with pytest.raises(MoveRefused, match=r"mass x: at 10 mm, .*-50 to 50 mm; nothing was moved"):
        motors.move(1.0, y=1, x=requested)


def test_rounding_does_not_take_a_mass_off_its_rail(rail):
    """The rail ends at 50.4 mm: 50.3 mm is on it and rounds to 50, but 48.9 of 49 does not fit."""
    motors = Motors(rail(resolution=MM, travel=(-0.05, 0.0504)))
    motors.move(0.0, x=50.3)
    np.testing.assert_allclose(motors.at(9.0), 50.0)
    short = Motors(rail(resolution=MM, travel=(-0.05, 0.0489)))
    with pytest.raises(MoveRefused):
        short.move(0.0, x=48.8)


def test_end_of_the_rail_can_be_reached_whatever_the_rounding(rail):
    motors = Motors(rail(resolution=MM))
    motors.move(0.0, x=50 * (1 + 1e-15))
    motors.move(9.0, x=-50 * (1 + 1e-15))
    np.testing.assert_allclose(motors.at(99.0), -50)


def test_wrong_mass_names_and_invalid_values_are_refused(rail):
    motors = Motors(rail("left"), rail("right"))
    with pytest.raises(InputError, match=r"'lefft'.*did you mean 'left'"):
        motors.move(0.0, lefft=1)
    with pytest.raises(InputError, match="mass left: found nan"):
        motors.move(0.0, left=np.nan)
    with pytest.raises(InputError, match="inf"):
        motors.move(0.0, left=np.inf)
    with pytest.raises(InputError, match="has none"):
        Motors().move(0.0, x=1)


def test_stops_miss_by_the_stated_accuracy(rail):
    """400 stops; the report knows nothing; errors do not add up from stop to stop."""
    motors, missed = Motors(rail(accuracy=0.3 * MM)), []
    for i in range(400):
        motors.move(20.0 * i, x=(-1) ** i * 20)
        missed.append(motors.at(20.0 * i + 19)[0] - motors.at(20.0 * i + 19, REPORTED)[0])
    low, high = chi2.ppf([0.001, 0.999], 400) / 400
    assert low < np.mean(np.square(missed)) / 0.3**2 < high
    assert abs(np.corrcoef(missed[:-1], missed[1:])[0, 1]) < 4 / np.sqrt(400)


def test_stuck_mass_is_reported_to_move(rail):
    motors = Motors(rail("x", accuracy=MM), rail("y"), faults=(Fault("x", 0.0),))
    motors.move(0.0, x=10, y=10)
    np.testing.assert_allclose(motors.at(5.0), [0.0, 10.0], atol=1e-12)
    np.testing.assert_allclose(motors.at(5.0, REPORTED), [10.0, 10.0])


def test_slipping_mass_goes_its_share_of_the_distance_from_home(rail):
    """Gain 0.5: commanded 40, then -20, then 0; it goes to 20, -10, 0."""
    motors = Motors(rail(), faults=(Fault("x", 0.5),))
    for i, (reported, goes) in enumerate(((40, 20), (-20, -10), (0, 0))):
        motors.move(20.0 * i, x=reported)
        np.testing.assert_allclose(motors.at(20.0 * i + 10), goes, atol=1e-12)


def test_fault_shows_from_its_move_on(rail):
    """Sound to 10 mm; stuck there from the second move, also when other masses made the first."""
    motors = Motors(rail("x"), rail("y"), faults=(Fault("x", 0.0, from_move=2),))
    motors.move(0.0, x=10)
    motors.move(10.0, x=-30)
    np.testing.assert_allclose(motors.at(30.0), [10.0, 0.0])
    other = Motors(rail("x"), rail("y"), faults=(Fault("x", 0.0, from_move=2),))
    other.move(0.0, y=10)
    other.move(10.0, x=-30)
    np.testing.assert_allclose(other.at(30.0), [0.0, 10.0], atol=1e-12)


def test_the_latest_fault_of_a_mass_holds(rail):
    faults = (Fault("x", 0.0, from_move=2), Fault("x", 0.5, from_move=1))
    motors = Motors(rail(), faults=faults)
    motors.move(0.0, x=20)
    motors.move(10.0, x=40)
    np.testing.assert_allclose(motors.at(30.0), 10.0)


def test_play_is_lost_when_the_direction_changes(rail):
    """2 mm of play, centred at home: 10 -> 9; on to 20 -> 19; back to 15 -> 16; 14.5 -> 15.5."""
    motors = Motors(rail(backlash=2 * MM))
    for i, (reported, goes) in enumerate(((10, 9), (20, 19), (15, 16), (14.5, 15.5))):
        motors.move(20.0 * i, x=reported)
        np.testing.assert_allclose(motors.at(20.0 * i + 10), goes, atol=1e-12)
        np.testing.assert_allclose(motors.at(20.0 * i + 10, CARRIAGE), reported)


def test_within_its_play_a_mass_stays_error_and_all(rail):
    motors = Motors(rail(backlash=2 * MM, accuracy=MM))
    motors.move(0.0, x=10)
    there = motors.at(9.0)
    motors.move(10.0, x=8.5)
    np.testing.assert_array_equal(motors.at(19.0), there)


def test_reported_rows_hold_the_ends_and_every_corner(rail):
    motors = Motors(rail("x"), rail("y"))
    motors.move(2.0, x=30, y=-10)
    rows = reported_rows(motors.track, 1.0, 4.0)
    np.testing.assert_allclose(rows.t, [1.0, 2.0, 3.0, 4.0])
    np.testing.assert_allclose(rows.values, [[0, 0], [0, 0], [0.01, -0.01], [0.02, -0.01]])
    between = np.linspace(1.0, 4.0, 301)
    straight = read_at(between, rows.t, rows.values)
    np.testing.assert_allclose(
        straight, read_at(between, motors.track.t, motors.track.reported), atol=1e-15
    )
