"""Which displacements are chosen, by hand and against brute force."""

import itertools
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from equipoise.actuators.sliding_masses import com_shift, mass_maps
from equipoise.procedure.steps import displacement_choice
from equipoise.procedure.steps.displacement_choice import displacements_for, gain_by_one
from tests.support.builders import MASS, SKEW, maps, platform_with, rail, sliding_masses

THREE = sliding_masses()
# m, what half a motor step does to the centre; a step more is worth an error of 1e-4 um less
HALF_STEP = 0.5e-3 * 0.0156 / MASS + 0.51e-10
along = st.floats(-0.05, 0.05)
displacements = arrays(np.float64, 3, elements=along)


@given(displacements, displacements)
def test_there_and_back_within_half_a_step(now, wanted):
    """A shift that the rails allow is made to half a motor step on each axis."""
    now = np.round(now, 3)
    shift = com_shift(maps(), MASS, wanted - now)
    d = displacements_for(platform_with(THREE), now, shift)
    assert np.abs(com_shift(maps(), MASS, d - now) - shift).max() <= HALF_STEP
    assert np.abs(d).max() <= 0.05 + 1e-12
    np.testing.assert_allclose(d * 1e3, np.round(d * 1e3), atol=1e-9)


@given(displacements)
def test_without_steps_the_way_back_is_exact(wanted):
    """Resolution 0: any place will do, and the shift is met to a nanometre."""
    free = sliding_masses(resolution=0.0)
    d = displacements_for(platform_with(free), np.zeros(3), com_shift(maps(), MASS, wanted))
    np.testing.assert_allclose(d, wanted, atol=1e-6)


@given(displacements)
def test_skew_rails_there_and_back(wanted):
    """Axes that are not at right angles: steps that lead somewhere lead back there."""
    wanted = np.round(wanted, 3)
    shift = com_shift(mass_maps(SKEW), MASS, wanted)
    d = displacements_for(platform_with(SKEW), np.zeros(3), shift)
    np.testing.assert_allclose(d, wanted, atol=1e-9)


def test_unreachable_is_approached():
    """A shift of 200 um along z needs 183 mm: the rail's end, and x and y are met all the same."""
    shift = np.array([10e-6, -5e-6, 200e-6])
    d = displacements_for(platform_with(THREE), np.zeros(3), shift)
    np.testing.assert_allclose(d, [0.009, -0.005, 0.05])  # 9.13 and 4.56 steps


def test_where_a_mass_stands_off_its_steps_it_still_moves_by_whole_steps():
    """From 0.4 mm, steps of 1 mm lead to 10.4 mm."""
    now = np.array([0.0004, 0.0, 0.0])
    shift = np.array([0.0101 * 0.0156 / MASS, 0.0, 0.0])
    d = displacements_for(platform_with(THREE), now, shift)
    np.testing.assert_allclose(d, [0.0104, 0.0, 0.0], atol=1e-12)


def best_of_grid(masses, shift, stood):
    """Try every whole number of millimetres: least error, new stops counted, then least travel."""
    ways = np.array(list(itertools.product(np.arange(-5, 6) * 1e-3, repeat=len(masses))))
    error = left_by(masses, ways, shift, stood)
    least = error <= error.min() + 1e-12
    return error.min(), np.abs(ways[least]).sum(axis=1).min()


def left_by(masses, ways, shift, stood):
    """Errors summed over the axes (m), the sd of what masses that move stop at with them."""
    moment = mass_maps(masses).first_moment / MASS
    moved = (ways != 0).astype(float)
    stops = moved @ (np.array([m.accuracy for m in masses])[:, None] * np.abs(moment))
    return (np.abs(ways @ moment - (moved * stood) @ moment - shift) + stops).sum(axis=-1)


@pytest.mark.parametrize("accuracy", [0.0, 5e-4])
@pytest.mark.parametrize("seed", range(8))
def test_least_error_then_least_travel(seed, accuracy):
    """Against all 11^3 places on skew rails of 5 mm, reachable or not, whatever the stops do."""
    rng = np.random.default_rng(seed)
    masses = tuple(replace(m, travel=(-0.005, 0.005), accuracy=accuracy) for m in SKEW)
    shift, stood = rng.uniform(-1, 1, 3) * 12e-6, accuracy * rng.normal(size=3)
    d = displacements_for(platform_with(masses), np.zeros(3), shift, stood=stood)
    error = left_by(masses, d, shift, stood)
    least_error, least_travel = best_of_grid(masses, shift, stood)
    assert error == pytest.approx(least_error, abs=1e-11)
    assert np.abs(d).sum() <= least_travel + 1e-9


COARSE = rail(0.5, [0, 0, 0], [1, 0, 0], name="coarse", resolution=2e-5, accuracy=1e-5)
DELICATE = rail(0.05, [0, 0, 0], [1, 0, 0], name="fine", resolution=1e-5, accuracy=5e-6)


@pytest.mark.parametrize(
    ("shift_um", "coarse_mm", "fine_mm"),
    [
        (0.5, 0.0, 0.2),  # a step of the coarse mass, which stops to 0.25 um: by the fine one
        (130.0, 5.2, 0.0),  # beyond what the fine one has: 5.2 mm are enough, to the step
        (0.01, 0.0, 0.0),  # less than a stop of the fine one adds
    ],
)
def test_a_fine_mass_corrects_what_it_can(shift_um, coarse_mm, fine_mm):
    """500 g shift 20 kg by 25 um for each mm, 50 g by 2.5 um; stops err by 0.25 and 0.0125 um."""
    bed = platform_with([COARSE, DELICATE], 20.0)
    d = displacements_for(bed, np.zeros(2), np.array([shift_um * 1e-6, 0, 0]))
    np.testing.assert_allclose(d, [coarse_mm * 1e-3, fine_mm * 1e-3], atol=1e-12)


def test_a_mass_that_moves_leaves_its_stop_behind():
    """It stands 0.4 mm too far, and 2 mm are wanted: 2.4 mm from where it was sent, whole steps."""
    one = [rail(0.5, [0, 0, 0], [1, 0, 0], resolution=1e-4)]
    wanted = com_shift(mass_maps(one), MASS, np.array([2e-3]))
    d = displacements_for(platform_with(one), np.zeros(1), wanted, stood=np.array([4e-4]))
    np.testing.assert_allclose(d, [2.4e-3], atol=1e-12)


def test_a_search_that_is_cut_short_keeps_to_the_rails(monkeypatch):
    """With hardly any of its nodes it answers all the same, by whole steps."""
    monkeypatch.setattr(displacement_choice, "NODES", 1)
    d = displacements_for(platform_with(SKEW), np.zeros(3), np.array([1e-5, -2e-5, 3e-5]))
    assert np.abs(d).max() <= 0.05
    np.testing.assert_allclose(d * 1e3, np.round(d * 1e3), atol=1e-9)


def test_redundant_masses_take_the_shortest_way():
    """Six masses, two an axis, one of them three times as heavy: the heavy ones go alone.

    Grid of whole steps on one axis: 30 um of 14.24 kg are 427 g mm: 9 x 46.8 g mm + 0.4 steps of
    15.6 g mm, and 9 steps is less travel than 27 of the light one.
    """
    heavy = tuple(replace(m, name=m.name + "2", mass=3 * m.mass) for m in THREE)
    shift = np.full(3, 9 * 3 * 0.0156e-3 / MASS)
    d = displacements_for(platform_with(THREE + heavy), np.zeros(6), shift)
    np.testing.assert_allclose(d, [0, 0, 0, 0.009, 0.009, 0.009], atol=1e-12)


def test_twins_share_only_when_in_haste():
    """Two equal masses: alone, one goes all the way; in haste they share it and finish sooner."""
    twins = (THREE[0], replace(THREE[0], name="x2"))
    shift = np.array([20 * 0.0156e-3 / MASS, 0.0, 0.0])
    alone = displacements_for(platform_with(twins), np.zeros(2), shift)
    hasty = displacements_for(platform_with(twins), np.zeros(2), shift, haste=1.0)
    np.testing.assert_allclose(np.sort(alone), [0.0, 0.02], atol=1e-12)
    np.testing.assert_allclose(hasty, [0.01, 0.01], atol=1e-12)


@pytest.mark.parametrize(
    ("shift_um", "now_mm", "gain_um"),
    [
        ((30.0, 0.0, 0.0), 0.0, 30.0),  # 0.6 mm are a whole number of steps
        ((-32.0, 0.0, 0.0), 0.0, 30.0),  # 0.64 mm are six steps of 0.1 mm
        ((1000.0, 0.0, 0.0), 0.0, 500.0),  # the rail ends after 10 mm
        ((30.0, 0.0, 0.0), 10.0, 0.0),  # where the mass stands already
        ((0.0, 30.0, 0.0), 0.0, 0.0),  # across the rail
    ],
)
def test_what_one_mass_gains_by_hand(shift_um, now_mm, gain_um):
    """0.5 kg of 10 kg along x: 50 um of the centre of mass for each mm, 5 um for each step."""
    one = [rail(0.5, [0, 0, 0], [1, 0, 0], resolution=1e-4, travel=(-0.01, 0.01))]
    gain = gain_by_one(
        platform_with(one, 10.0), np.array([now_mm * 1e-3]), 1e-6 * np.array(shift_um)
    )
    assert gain == pytest.approx(1e-6 * gain_um, abs=1e-12)


def test_what_a_stop_adds_is_taken_off_what_one_mass_gains():
    """It stops within 0.1 mm: 5 um."""
    rough = [rail(0.5, [0, 0, 0], [1, 0, 0], resolution=1e-4, accuracy=1e-4)]
    gain = gain_by_one(platform_with(rough, 10.0), np.zeros(1), np.array([30e-6, 0, 0]))
    assert gain == pytest.approx(25e-6)


@given(displacements, arrays(np.float64, 3, elements=st.floats(-1e-4, 1e-4)))
def test_all_masses_gain_no_less_than_one(now, shift):
    """To what a step more is worth."""
    goal = displacements_for(platform_with(SKEW), now, shift)
    left = shift - com_shift(mass_maps(SKEW), MASS, goal - now)
    gain = np.abs(shift).sum() - np.abs(left).sum()
    assert gain_by_one(platform_with(SKEW), now, shift) <= gain + 3 * HALF_STEP
