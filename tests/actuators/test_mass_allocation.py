"""Whole steps in a feedback loop: as near as they can be, within travel, coarse ones at rest."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from equipoise.actuators.mass_allocation import (
    allocate,
    least_changes,
    rails_of,
    tiers_of,
    without_delay,
)
from equipoise.actuators.sliding_masses import com_shift, mass_maps
from equipoise.model.testbed import SlidingMass
from equipoise.procedure.steps.displacement_choice import displacements_for
from tests.support.builders import platform_with, sliding_masses

MASS = 14.0
ROUND = np.arange(4) * np.pi / 2
EDGES = [[np.cos(a), np.sin(a), 1.0] for a in ROUND]


def rail(mass, axis, resolution, travel=0.05):
    axis = np.array(axis, dtype=float)
    unit = axis / np.linalg.norm(axis)
    return SlidingMass(
        "m", mass, np.zeros(3), unit, (-travel, travel), resolution, 0.0, 0.0, 0.01
    )  # fmt: skip


COARSE = tuple(rail(0.5, e, 1e-4) for e in np.eye(3))
FINE = tuple(rail(0.05, e, 5e-6, 0.02) for e in np.eye(3))
LAYOUTS = {
    "orthogonal": sliding_masses(),
    "two per axis": sliding_masses() + sliding_masses(),
    "three edges of a pyramid": tuple(rail(0.2, EDGES[i], 1e-5) for i in (0, 1, 2)),
    "four edges of a pyramid": tuple(rail(0.2, e, 1e-5) for e in EDGES),
    "coarse and fine": COARSE + FINE,
    "fine and coarse": FINE + COARSE,
    "three tiers": tuple(rail(1.0, e, 1e-3) for e in np.eye(3)) + COARSE + FINE,
    "coarse and a fine pyramid": COARSE + tuple(rail(0.05, e, 5e-6, 0.02) for e in EDGES),
    "coarse and without steps": COARSE + tuple(replace(m, resolution=0.0) for m in FINE),
}
RIGHT_ANGLED = [name for name in LAYOUTS if "pyramid" not in name]
shares = st.lists(st.floats(-1.0, 1.0), min_size=9, max_size=9).map(np.array)
every_layout = pytest.mark.parametrize("name", LAYOUTS)


def places(masses, share, reach=0.9):
    """Displacements in whole steps, up to ``reach`` of each travel."""
    d = reach * share[: len(masses)] * [m.travel[1] for m in masses]
    step = np.array([m.resolution for m in masses])
    return np.where(step > 0, np.rint(d / np.where(step > 0, step, 1)) * step, d)


def quanta(masses):
    """What one step of each mass does to the centre of mass, (k, 3) m."""
    return mass_maps(masses).first_moment * [[m.resolution] for m in masses] / MASS


def rounding(masses):
    """Half the sum over the axes of three steps of the finest, m."""
    sizes = np.abs(quanta(masses)).sum(axis=1)
    lengths = np.linalg.norm(quanta(masses), axis=1)
    finest = sizes[lengths <= 2 * lengths.min()]
    return 0.5 * np.sort(finest)[-3:].sum()


@every_layout
@given(now=shares, there=shares, off=shares)
def test_within_reach_the_error_is_of_rounding(name, now, there, off):
    """From anywhere to up to a step beside any whole steps within 90 % of travel.

    At right angles, half the finest step on each axis; else half of three steps, summed over the
    axes, and once more for coarse masses at a corner of what fine ones on skew rails reach.
    """
    masses = LAYOUTS[name]
    step = np.abs(quanta(masses)).max(axis=1).min()
    shift = com_shift(mass_maps(masses), MASS, places(masses, there)) + step * off[:3]
    d = allocate(rails_of(masses, MASS), places(masses, now, 1.0), shift)
    error = np.abs(com_shift(mass_maps(masses), MASS, d) - shift)
    if name in RIGHT_ANGLED:
        assert error.max() <= 0.5 * step * (1 + 1e-3) + 1e-11
    else:
        assert error.sum() <= (2 if "coarse" in name else 1) * rounding(masses) * (1 + 2e-3)


@every_layout
@given(now=shares, there=shares)
def test_allocated_steps_are_whole_and_within_travel_for_any_request(name, now, there):
    """Ten times what can be reached, too."""
    masses = LAYOUTS[name]
    shift = com_shift(mass_maps(masses), MASS, places(masses, there, 10.0))
    d = allocate(rails_of(masses, MASS), places(masses, now, 1.0), shift)
    for mass, x in zip(masses, d, strict=True):
        assert mass.travel[0] - 1e-12 <= x <= mass.travel[1] + 1e-12
        steps = x / mass.resolution if mass.resolution else 0.0
        assert abs(steps - round(steps)) < 1e-6


@pytest.mark.parametrize("name", [n for n in RIGHT_ANGLED if "coarse" in n])
@given(now=shares, fine=shares)
def test_coarse_masses_stay_while_the_fine_ones_can_do_it(name, now, fine):
    """Whatever the fine ones can reach from where the coarse ones are."""
    masses = LAYOUTS[name]
    coarse = np.array([m.mass > 0.1 for m in masses])
    now, there = places(masses, now), places(masses, fine, 1.0)
    there[coarse] = now[coarse]
    d = allocate(rails_of(masses, MASS), now, com_shift(mass_maps(masses), MASS, there))
    np.testing.assert_allclose(d[coarse], now[coarse], atol=1e-12)


@given(now=shares, fine=shares)
def test_coarse_masses_stay_while_a_fine_pyramid_can_do_it(now, fine):
    masses = LAYOUTS["coarse and a fine pyramid"]
    now, there = places(masses, now), places(masses, fine, 0.98)
    there[:3] = now[:3]
    d = allocate(rails_of(masses, MASS), now, com_shift(mass_maps(masses), MASS, there))
    np.testing.assert_allclose(d[:3], now[:3], atol=1e-12)


def test_coarse_masses_go_no_further_than_leaves_the_fine_ones_room():
    """Fine reach: 0.05 kg x 20 mm = 1 kg mm, of which 0.6 is used when a coarse mass moves.

    Wanted 1.26 kg mm: fourteen steps of 0.05 kg mm. And back: from there the fine mass takes all
    down to -0.3 kg mm before the coarse one moves, to five steps, with -0.56 kg mm for the fine.
    """
    rails, along = rails_of(COARSE + FINE, MASS), np.array([1e-3 / MASS, 0.0, 0.0])
    d = allocate(rails, np.zeros(6), 1.26 * along)
    np.testing.assert_allclose(d, [14e-4, 0, 0, (1.26 - 0.7) / 0.05 * 1e-3, 0, 0], atol=1e-12)
    back = allocate(rails, d, -0.29 * along)
    np.testing.assert_allclose(back[:3], d[:3], atol=1e-12)
    assert allocate(rails, d, -0.31 * along)[0] == pytest.approx(5e-4)


def test_after_a_coarse_move_a_small_one_is_the_fine_masses_alone():
    """0.3 kg mm either way of where the coarse mass went; each is within the fine mass's reach."""
    rails, along = rails_of(COARSE + FINE, MASS), np.array([1e-3 / MASS, 0.0, 0.0])
    there = allocate(rails, np.zeros(6), 1.26 * along)
    for change in (-0.3, 0.3):
        d = allocate(rails, there, (1.26 + change) * along)
        np.testing.assert_allclose(d[:3], there[:3], atol=1e-12)
        assert d[3] - there[3] == pytest.approx(change / 0.05 * 1e-3)


def test_fine_masses_that_are_quick_do_alone_what_they_can_do_at_once():
    """0.4 kg mm are 8 mm of 0.05 kg; in half a second they go 0.5 s x speed, or a coarse step.

    The slow one goes 1 mm, a coarse step of 0.05 kg mm; seven coarse steps do the rest.
    """
    along = np.array([1e-3 / MASS, 0.0, 0.0])
    quick = tuple(replace(mass, speed=0.02) for mass in FINE)
    slow = tuple(replace(mass, speed=0.001) for mass in FINE)
    still, wish = np.zeros(6), 0.4 * along  # 8 mm of the fine mass
    alone = without_delay(rails_of(COARSE + quick, MASS), still, still, wish)
    np.testing.assert_allclose(alone, [0, 0, 0, 8e-3, 0, 0], atol=1e-12)
    shared = without_delay(rails_of(COARSE + slow, MASS), still, still, wish)
    np.testing.assert_allclose(shared, [7e-4, 0, 0, 1e-3, 0, 0], atol=1e-12)


def test_coarse_masses_may_move_from_where_fine_ones_do_not_go_at_once():
    """0.05 kg x 0.5 s x 20 mm/s = 0.5 kg mm; the fine from half a step of theirs on."""
    quick = tuple(replace(mass, speed=0.02) for mass in FINE)
    least = least_changes(rails_of(COARSE + quick, MASS)) * MASS
    np.testing.assert_allclose(least[:3], 0.5e-3)
    np.testing.assert_allclose(least[3:], 0.5 * 0.05 * FINE[0].resolution)


def test_a_wish_that_trembles_does_not_shake_the_coarse_masses():
    """Around the end of the fine mass's reach, by a tenth of a coarse step: one move, no more."""
    rails, rng = rails_of(COARSE + FINE, MASS), np.random.default_rng(0)
    d, moves = np.zeros(6), 0
    for _ in range(200):
        wish = np.array([1.0 + 0.005 * rng.uniform(-1, 1), 0.0, 0.0]) * 1e-3 / MASS
        before, d = d, allocate(rails, d, wish)
        moves += int(np.any(np.abs(d - before)[:3] > 1e-9))
    assert moves == 1


@given(there=shares)
def test_beyond_reach_it_does_as_well_as_the_programme_of_all_steps(there):
    """Sum over axes of the error, against the mixed integer programme; skew rails."""
    masses = LAYOUTS["three edges of a pyramid"]
    shift = com_shift(mass_maps(masses), MASS, places(masses, there, 2.0))
    best = displacements_for(platform_with(masses), np.zeros(3), shift)
    found = allocate(rails_of(masses, MASS), np.zeros(3), shift)
    error, least = (
        np.abs(com_shift(mass_maps(masses), MASS, d) - shift).sum() for d in (found, best)
    )
    assert error <= least + rounding(masses) * (1 + 2e-3)


def test_a_mass_off_its_steps_counts_as_at_the_nearest():
    d = allocate(rails_of(sliding_masses(), MASS), np.array([4e-4, 0.0, 0.0]), np.zeros(3))
    np.testing.assert_array_equal(d, 0.0)


def test_tiers_by_hand():
    """Within a factor of 2 of a tier's finest is the same tier; no steps at all are the finest."""
    np.testing.assert_array_equal(tiers_of(np.array([1.0, 1.9, 2.1, 50.0, 3.0])), [0, 0, 1, 2, 1])
    np.testing.assert_array_equal(tiers_of(np.array([5.0, 0.0, 5.0])), [1, 0, 1])
