"""Moments, inertia and covariance of weights by hand; which ones are chosen, by brute force."""

import itertools
from dataclasses import replace

import numpy as np
import pytest

from equipoise.actuators.placed_weights import handling_covariance, load_of, refusal
from equipoise.actuators.weight_choice import (
    Wanted,
    actions_of,
    bulk_of,
    chosen,
    left_by,
    price,
)
from equipoise.model.mass_properties import MassProperties
from equipoise.model.testbed import Testbed
from equipoise.model.units import UM
from equipoise.model.weights import Weight, WeightGrid, places_of, unloaded
from tests.support.builders import platform

X, Y, Z = np.eye(3)


def deck(**other) -> WeightGrid:
    """Two by three places 25 mm apart, 100 mm above P; B2 is not free."""
    first = np.array([0.1, 0.0, 0.1])
    made = WeightGrid("deck", first, X, Y, 0.025, 2, 3, 4, 0.001, ("B2",))
    return replace(made, **other)


def bed(*grids: WeightGrid, weights: tuple[Weight, ...] = ()) -> Testbed:
    """The platform of the other tests with 1 g and 5 g weights, 2 mm and 4 mm high."""
    stock = weights or (
        Weight("g1", 1e-3, 6, 1e-5, 0.002),
        Weight("g5", 5e-3, 2, 2e-5, 0.004),
    )
    return replace(platform(), masses=(), weights=stock, grids=grids or (deck(),))


def loading_of(testbed: Testbed, **counts: tuple[int, ...]) -> np.ndarray:
    """Return counts by place, such as A1=(2, 0)."""
    loading = unloaded(testbed.grids, testbed.weights)
    names = [place.name.split(":")[1] for place in places_of(testbed.grids)]
    for name, count in counts.items():
        loading[names.index(name)] = count
    return loading


def test_places_are_named_along_both_axes_and_taken_ones_left_out():
    names = [place.name for place in places_of((deck(),))]
    assert names == ["deck:A1", "deck:A2", "deck:A3", "deck:B1", "deck:B3"]
    last = places_of((deck(),))[-1]
    np.testing.assert_allclose(last.foot, [0.125, 0.05, 0.1], atol=1e-15)
    np.testing.assert_allclose(last.up, Z)
    sideways = places_of((deck(letter_axis=Z, number_axis=X),))[0]
    np.testing.assert_allclose(sideways.up, Y)  # z cross x


def test_a_pile_adds_mass_first_moment_and_inertia_as_worked_by_hand():
    """Two of 1 g (middles 101 and 103 mm up) and one of 5 g on them (106 mm up), at A1."""
    testbed = bed()
    load = load_of(testbed, loading_of(testbed, A1=(2, 1)))
    assert load.mass == pytest.approx(7e-3)
    moment = [7e-3 * 0.1, 0.0, 1e-3 * 0.101 + 1e-3 * 0.103 + 5e-3 * 0.106]
    np.testing.assert_allclose(load.first_moment, moment, rtol=1e-12)
    zz = 1e-3 * 0.101**2 + 1e-3 * 0.103**2 + 5e-3 * 0.106**2
    J = load.inertia_P
    np.testing.assert_allclose(np.diag(J), [zz, zz + 7e-3 * 0.01, 7e-3 * 0.01], rtol=1e-12)
    assert J[0, 2] == pytest.approx(-0.1 * moment[2])  # minus the integral of x z
    assert J[0, 1] == 0.0


def test_what_is_not_handled_adds_nothing_to_what_is_unsure():
    """One of 1 g off A1, one of 5 g on A3: sd of mass along x, of place across the grid."""
    testbed = bed()
    before = loading_of(testbed, A1=(2, 0), B3=(1, 0))
    after = loading_of(testbed, A1=(1, 0), B3=(1, 0), A3=(0, 1))
    a1, a3 = np.array([0.1, 0, 0.1]), np.array([0.1, 0.05, 0.1])
    mass = 1e-10 * np.outer(a1, a1) + 4e-10 * np.outer(a3, a3)
    place = ((1e-3 * 1e-3) ** 2 + (5e-3 * 1e-3) ** 2) * np.diag([1.0, 1.0, 0.0])
    found = handling_covariance(testbed, before, after)
    np.testing.assert_allclose(found, mass + place, rtol=1e-12, atol=1e-20)
    assert not handling_covariance(testbed, before, before).any()


def test_left_counts_the_mass_that_is_added():
    """The platform itself moves nothing; 1 kg at 0.1 m on 9 kg with r = 0 leaves 10 mm."""
    testbed = bed(weights=(Weight("kg", 1.0, 1, 0.0, 0.0),))
    body = MassProperties(9.0, np.zeros(3), np.eye(3))
    wanted = Wanted(body, loading_of(testbed), np.array([0.0, 0.0, 0.002]), np.ones(3))
    left = left_by(testbed, wanted, loading_of(testbed, A1=(1,)))
    np.testing.assert_allclose(left, [0.01, 0.0, 0.008], atol=1e-15)


REFUSED = {
    "seven of six": ({"A1": (3, 0), "A2": (4, 0)}, "7 x g1, of which there are 6"),
    "five on four": ({"A1": (4, 1)}, "5 weights at deck:A1, which holds 4"),
    "fewer than none": ({"A1": (-1, 0)}, "fewer than no weights"),
}


@pytest.mark.parametrize(("counts", "why"), REFUSED.values(), ids=REFUSED.keys())
def test_beyond_stock_or_pile_is_refused_with_a_sentence(counts, why):
    testbed = bed()
    assert why in refusal(testbed, loading_of(testbed, **counts))
    assert refusal(testbed, loading_of(testbed, A1=(3, 1))) == ""


def corners(testbed: Testbed) -> Testbed:
    """Four corners of a deck and four below: all directions can be reached."""
    four = {"step": 0.2, "letters": 2, "numbers": 2, "capacity": 2, "taken": ()}
    above = deck(name="above", first=np.array([-0.1, -0.1, 0.1]), **four)
    below = deck(name="below", first=np.array([-0.1, -0.1, -0.1]), **four)
    return replace(testbed, grids=(above, below))


def every_loading(testbed: Testbed) -> list[np.ndarray]:
    """Return all loadings that stock and piles allow."""
    shape = unloaded(testbed.grids, testbed.weights).shape
    capacity = max(grid.capacity for grid in testbed.grids)
    counts = itertools.product(range(capacity + 1), repeat=shape[0] * shape[1])
    found = (np.array(each, dtype=np.int64).reshape(shape) for each in counts)
    return [loading for loading in found if not refusal(testbed, loading)]


@pytest.mark.parametrize("seed", range(6))
def test_the_choice_is_the_best_of_all_loadings_of_a_small_stock(seed):
    """Three weights of 1 g on eight places, from a loading that is already there."""
    testbed = corners(bed(weights=(Weight("g1", 1e-3, 3, 0.0, 0.002),)))
    rng = np.random.default_rng(seed)
    now = unloaded(testbed.grids, testbed.weights)
    now[rng.integers(8), 0] = 1
    com = rng.uniform(-25, 25, 3) * UM
    body = MassProperties(14.0, com, testbed.body.inertia_P)
    wanted = Wanted(body, now, np.array([0.0, 0.0, -5 * UM]), np.full(3, 3 * UM))
    best = min(price(testbed, wanted, each) for each in every_loading(testbed))
    assert price(testbed, wanted, chosen(testbed, wanted)) == pytest.approx(best, rel=1e-9)


def test_the_choice_of_weights_never_exceeds_the_stock():
    """So far off that the whole stock does not bring it back: all of it goes to one side."""
    testbed = corners(bed())
    body = MassProperties(14.0, np.array([-2e-3, 0.0, 0.0]), testbed.body.inertia_P)
    now = unloaded(testbed.grids, testbed.weights)
    wanted = Wanted(body, now, np.zeros(3), np.full(3, 3 * UM))
    found = chosen(testbed, wanted)
    assert refusal(testbed, found) == ""
    assert list(found.sum(axis=0)) == [6, 2]
    right = [place.foot[0] > 0 for place in places_of(testbed.grids)]
    assert not found[~np.array(right)].any()


def test_nothing_is_moved_where_nothing_helps():
    testbed = corners(bed())
    target = np.array([0.0, 0.0, -100 * UM])
    body = MassProperties(14.0, target + 0.2 * UM, testbed.body.inertia_P)
    now = unloaded(testbed.grids, testbed.weights)
    assert not chosen(testbed, Wanted(body, now, target, np.full(3, 3 * UM))).any()


def test_every_single_placement_has_its_stated_effect():
    """On or off, of either kind: against the loading with and without it, to the added mass."""
    testbed = bed()
    now = loading_of(testbed, A1=(2, 1), B3=(1, 0))
    body = MassProperties(14.0, np.array([3.0, -2.0, 1.0]) * UM, testbed.body.inertia_P)
    wanted = Wanted(body, now, np.array([0.0, 0.0, -100 * UM]), np.array([2.0, 2.0, 3.0]) * UM)
    found, before = actions_of(testbed, wanted, now), left_by(testbed, wanted, now)
    assert set(found.way) == {-1, 1}
    for p, k, way, lever in zip(*found, strict=True):
        if way < 0 and k == 0 and now[p, 1]:
            continue  # from below another: the programme takes it for the top one
        after = now.copy()
        after[p, k] += way
        if way > 0 and now[p].any():
            continue  # onto another kind: the order of the stock puts it below
        change = left_by(testbed, wanted, after) - before
        np.testing.assert_allclose(lever * wanted.spread, change, rtol=2e-3, atol=2e-8)


def test_the_bulk_counts_the_mass_that_is_added():
    """8 kg at 0 and n of 1 kg 0.1 m up, wanted 20 mm up: n 0.08 = 0.16, two of them."""
    one = deck(first=np.array([0.0, 0.0, 0.1]), letters=1, numbers=1, taken=(), capacity=9)
    testbed = bed(one, weights=(Weight("kg", 1.0, 9, 0.0, 0.0),))
    body = MassProperties(8.0, np.zeros(3), np.eye(3))
    wanted = Wanted(body, np.zeros((1, 1), np.int64), np.array([0.0, 0.0, 0.02]), np.full(3, 1e-4))
    assert bulk_of(testbed, wanted).item() == 2
