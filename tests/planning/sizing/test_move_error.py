"""What one move leaves, by hand: steps, stops, backlash, rails, and whether it pays."""

import numpy as np
import pytest

from equipoise.model.units import UM
from equipoise.planning.sizing.move_error import at_home, move
from tests.planning.sizing.layouts import X, Y, Z, box, mass, testbed

QUANTUM = 10e-6  # m: 100 g x 1 mm of 10 kg


def rms(rows):
    return np.sqrt(np.mean(rows**2, axis=0))


def moved(bed, found, normals=None, lean=0.0, now=None):
    """Return platforms after a move that knows their offset exactly."""
    n, k = len(found), len(bed.masses)
    leans = np.zeros((n, 2 * k)) if lean == 0 else np.random.default_rng(3).normal(size=(n, 2 * k))
    start = at_home(bed, found, leans, lean) if now is None else now
    return move(bed, start, found, np.zeros((n, k)) if normals is None else normals, lean)


def offsets(n=400, size=100 * UM):
    return size * np.random.default_rng(1).uniform(-1, 1, (n, 3))


def test_steps_leave_a_quantum_over_root_twelve():
    """Uniform over a quantum: within 4 sd, 0.45 / sqrt(400) each, of its rms."""
    after, left = moved(box(), offsets())
    np.testing.assert_allclose(rms(left.steps), QUANTUM / np.sqrt(12), rtol=0.09)
    assert np.abs(left.steps).max() <= QUANTUM / 2 + 1e-12
    np.testing.assert_allclose(after.error, left.steps, atol=1e-15)


def test_equal_masses_on_one_rail_are_no_finer_than_one():
    both = testbed(*(mass(axis) for axis in (X, Y, Z, X, Y, Z)))
    np.testing.assert_allclose(
        moved(both, offsets())[1].steps, moved(box(), offsets())[1].steps, atol=1e-12
    )


def test_a_fine_mass_beside_a_coarse_one_makes_it_fine():
    fine = testbed(*(mass(axis, resolution=step) for axis in (X, Y, Z) for step in (1e-3, 1e-4)))
    steps = moved(fine, offsets())[1].steps
    np.testing.assert_allclose(rms(steps), QUANTUM / 10 / np.sqrt(12), rtol=0.09)


def test_error_is_the_sum_of_its_causes():
    bed, rng = box(accuracy=2e-4, backlash=3e-4), np.random.default_rng(2)
    error, noise = offsets(), 3 * UM * rng.normal(size=(400, 3))
    start = at_home(bed, error, rng.normal(size=(400, 6)), 0.01)
    after, left = move(bed, start, error + noise, rng.normal(size=(400, 3)), 0.01)
    total = -noise + left.steps + left.stops + left.backlash + left.rails
    np.testing.assert_allclose(after.error, total, atol=1e-15)


def test_a_mass_that_moves_stops_elsewhere_and_one_that_does_not_stays():
    """Stops of 0.2 mm: 2 um. z is within half a step of where it should be and stays."""
    found = np.tile([50 * UM, -30 * UM, 1 * UM], (3, 1))
    normals = np.array([[1.0, 1.0, 1.0], [-2.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
    _, left = moved(box(accuracy=2e-4), found, normals)
    expected = [[2, 2, 0], [-4, 0, 0], [0, 0, 0]]
    np.testing.assert_allclose(left.stops / UM, expected, atol=1e-9)
    assert left.moved.tolist() == [[True, True, False]] * 3


def test_the_last_stops_error_goes_with_the_mass():
    bed = box(accuracy=2e-4)
    found = np.array([[50 * UM, 0, 0]])
    first, _ = moved(bed, found, np.array([[1.0, 0, 0]]))
    assert first.slip[0, 0] == pytest.approx(2e-4)
    _, left = moved(bed, found, np.array([[-1.0, 0, 0]]), now=first)
    np.testing.assert_allclose(left.stops[0] / UM, [-4, 0, 0], atol=1e-9)  # 2 um there, 2 beyond


def test_backlash_takes_half_of_it_from_home_nothing_onwards_all_in_a_turn():
    """Play of 0.6 mm: 6 um, of which a mass at home stands in the middle."""
    bed, way = box(backlash=6e-4), np.array([[-50 * UM, 0, 0]])
    first, left = moved(bed, way)
    assert left.backlash[0, 0] == pytest.approx(-3 * UM)
    onwards, left = moved(bed, way, now=first)
    assert left.backlash[0, 0] == pytest.approx(0.0, abs=1e-15)
    _, left = moved(bed, -way, now=onwards)
    assert left.backlash[0, 0] == pytest.approx(6 * UM)


def test_within_its_play_a_mass_is_not_taken_along():
    bed = box(backlash=6e-3, accuracy=2e-4)
    after, left = moved(bed, np.array([[20 * UM, 0, 0]]), np.ones((1, 3)))
    assert left.moved[0, 0]
    assert after.error[0, 0] == pytest.approx(20 * UM)
    assert after.slip[0, 0] == 0.0


def test_the_remaining_backlash_decides_whether_a_mass_is_carried_along():
    """Play of 6 mm, at one end of it: 2 mm onwards takes it along, 4 mm back do not, 7 do."""
    bed, first = box(backlash=6e-3, accuracy=2e-4), np.array([[50 * UM, 0, 0]])
    there, _ = moved(bed, first, np.full((1, 3), 0.5))
    for found, taken in ((20 * UM, True), (-40 * UM, False), (-70 * UM, True)):
        after, _ = moved(bed, np.array([[found, 0, 0]]), np.ones((1, 3)), now=there)
        assert after.slip[0, 0] == pytest.approx(2e-4 if taken else 1e-4), found


def test_a_move_along_a_rail_that_leans_too_much_does_not_pay():
    """It errs by sqrt(2) of the lean times the shift: as much as it undoes at 0.71."""
    found = np.array([[50 * UM, 0, 0]])
    assert moved(box(), found, lean=0.68)[1].moved[0, 0]
    assert not moved(box(), found, lean=0.74)[1].moved[0, 0]


def test_a_rail_that_leans_errs_across_it_by_shift_times_angle():
    """50 um along x at 10 mrad about y and z: 0.5 um each across, nothing along."""
    found = np.tile([50 * UM, 0, 0], (2000, 1))
    _, left = moved(box(), found, lean=0.01)
    np.testing.assert_allclose(left.rails[:, 0], 0.0, atol=1e-15)
    np.testing.assert_allclose(rms(left.rails)[1:], 0.5 * UM, rtol=0.07)


def test_a_move_that_leaves_more_than_there_is_is_not_made():
    """Three stops of 20 um leave 35 um: an offset of 30 um each (52) is moved, of 15 (26) not."""
    bed = box(accuracy=2e-3)
    found = np.array([[30 * UM] * 3, [15.2 * UM] * 3])
    after, left = moved(bed, found)
    assert left.moved.tolist() == [[True] * 3, [False] * 3]
    np.testing.assert_allclose(after.error[1], found[1])
    np.testing.assert_allclose(left.steps[1] + left.stops[1], found[1])


def test_a_second_stop_has_to_pay_for_the_first_ones_error_too():
    """35 um sqrt(2) = 49 um: 25 um on each axis (43) is worth a first move and not a second."""
    bed, found = box(accuracy=2e-3), np.array([[25 * UM] * 3])
    first, left = moved(bed, found, np.full((1, 3), 0.01))
    assert left.moved.all()
    assert not moved(bed, found, now=first)[1].moved.any()


def test_rails_end():
    after, _ = moved(box(), np.array([[700 * UM, 0, 0]]))
    assert after.error[0, 0] == pytest.approx(200 * UM)  # 500 um is all that there is


def test_a_mass_without_steps_leaves_nothing():
    _, left = moved(box(resolution=0.0), offsets(20))
    np.testing.assert_allclose(left.steps, 0.0, atol=1e-12)


def test_backlash_and_accuracy_belong_to_each_mass():
    masses = [mass(X, accuracy=1e-4), mass(Y), mass(Z, backlash=2e-4)]
    found = np.array([[50 * UM] * 3])
    _, left = moved(testbed(*masses), found, np.ones((1, 3)))
    np.testing.assert_allclose(left.stops[0] / UM, [1, 0, 0], atol=1e-9)
    np.testing.assert_allclose(left.backlash[0] / UM, [0, 0, 1], atol=1e-9)
