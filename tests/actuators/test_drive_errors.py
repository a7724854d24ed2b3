"""Drives in doubt: the effects of gain, rail and backlash."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.actuators.drive_errors import drive_errors, plays, rails_of
from equipoise.actuators.lost_motion import directions, play_of
from equipoise.actuators.mass_errors import mass_errors, unit_of
from equipoise.actuators.sliding_masses import inertia_shift, mass_maps
from equipoise.maths.axes_across import axes_across
from equipoise.model.recording import Samples
from equipoise.model.testbed import DriveDoubt, SlidingMass

DOUBT = DriveDoubt(0.1, 0.1, 1e-3)
HOME = np.array([0.0, 0.2, -0.05])


def rail(axis, doubt=DOUBT, gain=1.0, backlash=4e-3):
    return SlidingMass("x1", 0.5, HOME, np.array(axis), (-0.05, 0.05), 0.0, 0.0, backlash, 0.01,
                       0.0, 0.0, gain, doubt)  # fmt: skip


# Out by 20 mm from 10 to 12 s, back by 10 mm from 20 to 21 s.
TRACK = Samples(
    np.array([0.0, 10.0, 12.0, 20.0, 21.0, 30.0]),
    np.array([0.0, 0.0, 0.02, 0.02, 0.01, 0.01])[:, None],
)


def response_at(name, t):
    errors = mass_errors(TRACK, (rail([1.0, 0.0, 0.0]),))
    index = list(errors.names).index(name)
    (column,) = np.flatnonzero(errors.owner[:, 1] == index)
    return np.interp(t, errors.response.t, errors.response.values[:, column]), errors.owner[
        column, 0
    ]


@pytest.mark.parametrize(
    ("name", "owner", "expected"),
    [
        ("gain_x1", 0, [0.0, 0.001, 0.01, 0.02, 0.018, 0.01]),
        ("across_x1_1", 1, [0.0, 0.001, 0.01, 0.02, 0.018, 0.01]),
        ("across_x1_2", 2, [0.0, 0.001, 0.01, 0.02, 0.018, 0.01]),
        ("backlash_x1", 0, [0.0, -0.25, -0.5, -0.5, 0.0, 0.5]),
        ("play_x1", 0, [0.0, 0.5, 1.0, 1.0, 1.0, 1.0]),
    ],
)
def test_each_drive_error_has_the_derived_signature(name, owner, expected):
    """At home, crossing half of 4 mm of play, half way out, out, crossing all of it, and back."""
    values, where = response_at(name, [5.0, 10.1, 11.0, 15.0, 20.2, 25.0])
    assert where == owner
    np.testing.assert_allclose(values, expected, atol=1e-12)


def test_the_error_of_a_stop_passes_over_while_the_mass_is_taken_along():
    """Play until 10.2 and 20.4 s: half way between 10.2 and 12, and between 20.4 and 21."""
    coarse = replace(rail([1.0, 0.0, 0.0]), accuracy=1e-4)
    errors = mass_errors(TRACK, (coarse,))
    at = [10.0, 10.2, 11.1, 12.0, 20.0, 20.4, 20.7, 21.0, 30.0]
    first, second = (errors.names.index(f"error_x1_{k}") for k in (1, 2))

    def response(index):
        (column,) = np.flatnonzero(errors.owner[:, 1] == index)
        return np.interp(at, errors.response.t, errors.response.values[:, column])

    expected = [0.0, 0.0, 0.5, 1.0, 1.0, 1.0, 0.5, 0.0, 0.0]
    np.testing.assert_allclose(response(first), expected, atol=1e-12)
    np.testing.assert_allclose(response(second), [*[0.0] * 6, 0.5, 1.0, 1.0], atol=1e-12)


def test_rails_across_are_square_and_right_handed():
    for axis in ([1.0, 0.0, 0.0], [0.0, 0.6, 0.8], [-0.48, 0.6, 0.64]):
        v, w = axes_across(np.array(axis))
        frame = np.array([axis, v, w])
        np.testing.assert_allclose(frame @ frame.T, np.eye(3), atol=1e-12)
        assert np.linalg.det(frame) == pytest.approx(1.0)


def test_a_travel_shorter_than_the_play_takes_the_mass_nowhere():
    """Out 20 mm, back 3 of 4 mm, on 3 mm: the side goes 1, -1/2, 1, as a clipped sum says."""
    t = np.array([0.0, 2.0, 4.0, 4.3, 5.0, 5.3])
    d = np.array([0.0, 0.02, 0.02, 0.017, 0.017, 0.02])
    play = play_of(t, d, directions(t, d, 0.01), 4e-3)
    np.testing.assert_allclose(play.t, [0.0, 0.0, 0.2, 4.0, 4.3, 5.0, 5.3])
    np.testing.assert_allclose(play.side, [0.0, 0.0, 1.0, 1.0, -0.5, -0.5, 1.0], atol=1e-12)


def test_the_side_is_that_of_a_nut_followed_in_small_steps():
    """The play operator x -> clip(x, d - b/2, d + b/2) of a walk with turns; s = 2 (d - x) / b."""
    rng = np.random.default_rng(3)
    t = np.arange(0.0, 40.0, 0.5)
    d = np.cumsum(rng.choice([-1.0, 1.0], len(t)) * 5e-3 * rng.uniform(0.2, 1.0, len(t)))
    fine = np.linspace(t[0], t[-1], 79 * 500 + 1)  # turns among them
    x, side = d[0], []
    for reported in np.interp(fine, t, d):
        x = min(max(x, reported - 2e-3), reported + 2e-3)
        side.append((reported - x) / 2e-3)
    play = play_of(t, d, directions(t, d, 0.01), 4e-3)
    np.testing.assert_allclose(np.interp(fine, play.t, play.side), side, atol=1e-3)


def test_a_turn_back_without_rest_ends_a_travel():
    t, d = np.arange(5.0), np.array([0.0, 0.01, 0.02, 0.01, 0.01])
    assert directions(t, d, 0.01) == [(0, 2, 1.0), (2, 3, -1.0)]


def test_a_mass_that_is_trusted_has_no_gain_and_one_that_stands_nothing():
    trusted = rail([1.0, 0.0, 0.0], DriveDoubt(0.0, 0.1, 0.0))
    taken_up = plays(TRACK, (trusted,))
    assert [e.name for e in drive_errors(TRACK.t, TRACK, (trusted,), taken_up)] == [
        "across_x1_1", "across_x1_2",
    ]  # fmt: skip
    still = Samples(TRACK.t, np.zeros((6, 1)))
    assert plays(still, (rail([1.0, 0.0, 0.0]),)) == {}
    assert len(rails_of((rail([1.0, 0.0, 0.0], None),))) == 1


def test_units_are_those_of_the_unknowns():
    units = [unit_of(n) for n in ("gain_x1", "across_x1_1", "backlash_x1", "error_x1_1")]
    assert units == ["1", "rad", "m", "m"]


def test_a_gain_moves_a_mass_so_much_further():
    """Hand-worked: 0.5 kg commanded 20 mm with gain 1.1 goes 22 mm: 0.011 kg m, and its inertia."""
    maps, d = mass_maps([rail([1.0, 0.0, 0.0], None, 1.1)]), np.array([0.02])
    np.testing.assert_allclose(d @ maps.first_moment, [0.011, 0.0, 0.0])
    there = HOME + np.array([0.022, 0.0, 0.0])
    about = [r @ r * np.eye(3) - np.outer(r, r) for r in (HOME, there)]
    change = 0.5 * (about[1] - about[0])
    found = inertia_shift(maps, d)
    np.testing.assert_allclose(found, change[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]], atol=1e-15)
    np.testing.assert_allclose(maps.momentum[0], 0.55 * np.cross(HOME, [1.0, 0.0, 0.0]))
