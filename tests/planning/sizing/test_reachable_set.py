"""What masses can reach: by hand, against all corners, against linear programming."""

from itertools import product

import numpy as np
import pytest
from scipy.optimize import linprog
from scipy.spatial import ConvexHull

from equipoise.io.testbed.presets import read_preset
from equipoise.model.units import UM
from equipoise.planning.sizing.reachable_set import (
    box_about_home,
    contains,
    furthest,
    outline,
    reach_of,
    tolerance,
    unreachable,
    volume,
    weakest,
)
from tests.planning.sizing.layouts import TOTAL, X, Y, Z, mass, pyramid

REACH = 500e-6  # m: 100 g of 10 kg, 50 mm to either side
SKEW = (mass((1, 0.2, 0)), mass((0, 1, 0.4), travel=(-0.02, 0.06)), mass((0.3, 0, 1), weight=0.03),
        mass((1, 1, 1), weight=0.05), mass((-1, 0.5, 0.2), travel=(0.0, 0.03)))  # fmt: skip


def corners(masses):
    ends = product(*(m.travel for m in masses))
    return np.array([sum(m.mass * d * m.axis for m, d in zip(masses, e, strict=True))
                     for e in ends]) / TOTAL  # fmt: skip


def test_sputnix_reaches_110_um_along_each_axis():
    """Two masses of 15.6 g, 50 mm each way, of 14.24 kg: 2 x 15.6 x 50 / 14.24 = 109.55 um."""
    bed = read_preset("sputnix")
    reach = reach_of(bed.masses, bed.body.mass)
    expected = 2 * 15.6e-3 * 50e-3 / 14.24
    assert reach.rank == 3
    assert [furthest(reach, way) for way in (X, -Y, Z)] == pytest.approx([expected] * 3)
    assert tolerance(reach) == pytest.approx(expected)
    assert volume(reach) == pytest.approx((2 * expected) ** 3)
    assert furthest(reach, np.ones(3) / np.sqrt(3)) == pytest.approx(expected * np.sqrt(3))


def test_equation_7_counts_from_end_to_end():
    """da Silva 2021 Eq. 7: m d / M with d the whole excursion; from mid-rail half of that."""
    reach = reach_of([mass(X), mass(Y), mass(Z)], TOTAL)
    whole = 0.1 * 0.1 / TOTAL
    assert furthest(reach, X) + furthest(reach, -X) == pytest.approx(whole)
    assert tolerance(reach) == pytest.approx(whole / 2)


def test_a_mass_that_stands_at_an_end_corrects_one_way_only():
    reach = reach_of([mass(X, travel=(0.0, 0.05)), mass(Y), mass(Z)], TOTAL)
    assert furthest(reach, X) == pytest.approx(REACH)
    assert furthest(reach, -X) == pytest.approx(0.0, abs=1e-12)
    assert tolerance(reach) == pytest.approx(0.0, abs=1e-12)
    np.testing.assert_allclose(weakest(reach), -X, atol=1e-12)


@pytest.mark.parametrize("slant", [0.2, 0.6, 1.2])
def test_pyramid_by_hand(slant):
    """Facets +-x, +-y at 2 a c and eight (s, s, c) / sqrt(1 + s^2) at 4 a s c / sqrt(1 + s^2)."""
    a, c, s = REACH, np.cos(slant), np.sin(slant)
    reach = reach_of(pyramid(slant), TOTAL)
    slanted = 4 * a * s * c / np.sqrt(1 + s * s)
    assert len(reach.normals) == 12
    assert sorted(reach.heights) == pytest.approx(sorted([2 * a * c] * 4 + [slanted] * 8))
    assert tolerance(reach) == pytest.approx(min(2 * a * c, slanted))
    assert furthest(reach, X) == pytest.approx(2 * a * c)
    assert furthest(reach, -Z) == pytest.approx(4 * a * s)
    assert volume(reach) == pytest.approx(64 * a**3 * c * c * s)


@pytest.mark.parametrize("masses", [SKEW, pyramid(0.7)], ids=["skew", "pyramid"])
def test_it_is_the_hull_of_all_corners(masses):
    reach, points = reach_of(masses, TOTAL), corners(masses)
    hull = ConvexHull(points / UM)
    assert volume(reach) == pytest.approx(hull.volume * UM**3)
    for normal, height in zip(reach.normals, reach.heights, strict=True):
        assert (points @ normal).max() == pytest.approx(height)
    for *normal, offset in hull.equations:
        assert np.isclose(reach.normals @ normal, 1.0, atol=1e-9).any()
        assert tolerance(reach) <= -offset * UM + 1e-12
    assert tolerance(reach) == pytest.approx(-hull.equations[:, 3].max() * UM, abs=1e-12)


@pytest.mark.parametrize("plane", [(0, 1), (0, 2), (1, 2)])
def test_outline_is_the_hull_of_the_shadow(plane):
    observed, flat = outline(reach_of(SKEW, TOTAL), plane), corners(SKEW)[:, plane]
    hull = ConvexHull(flat / UM)
    area = 0.5 * np.sum(
        observed[:, 0] * np.roll(observed[:, 1], -1) - np.roll(observed[:, 0], -1) * observed[:, 1]
    )
    assert area == pytest.approx(hull.volume * UM**2)  # in order, and so counter-clockwise
    for vertex in flat[hull.vertices]:
        assert np.isclose(observed, vertex, atol=1e-12).all(axis=1).any()


def test_inside_is_what_a_linear_programme_can_do():
    rng, reach = np.random.default_rng(1), reach_of(SKEW, TOTAL)
    tried = np.abs(corners(SKEW)).max(axis=0) * rng.uniform(-0.6, 0.6, (60, 3))
    gain = np.array([m.mass * m.axis for m in SKEW]).T / TOTAL
    bounds = [m.travel for m in SKEW]
    can = [linprog(np.zeros(5), A_eq=gain / UM, b_eq=shift / UM, bounds=bounds).status == 0
           for shift in tried]  # fmt: skip
    assert 10 < sum(can) < 50
    assert contains(reach, tried).tolist() == can


def test_a_single_rail_reaches_a_line():
    reach = reach_of([mass((1, 1, 0)), mass((1, 1, 0))], TOTAL)
    along = np.array([1, 1, 0]) / np.sqrt(2)
    assert reach.rank == 1
    assert furthest(reach, along) == pytest.approx(2 * REACH)
    assert furthest(reach, X) == 0.0
    assert tolerance(reach) == pytest.approx(2 * REACH)
    assert volume(reach) == 0.0
    np.testing.assert_allclose(along @ unreachable(reach), 0.0, atol=1e-12)
    inside = np.array([1.9 * REACH * along, 2.1 * REACH * along, REACH * X])
    assert contains(reach, inside).tolist() == [True, False, False]


def test_rails_in_a_plane_reach_a_polygon_there():
    """Edges a (1, 0) and a/2 (1, 1) / sqrt(2): their parallelogram is a / sqrt(8) high."""
    reach = reach_of([mass(X), mass((1, 1, 0), weight=0.05)], TOTAL)
    assert reach.rank == 2
    assert furthest(reach, Z) == 0.0
    assert tolerance(reach) == pytest.approx(REACH / np.sqrt(8))
    assert sorted(reach.heights / REACH) == pytest.approx([8**-0.5] * 2 + [2**-0.5] * 2)
    assert furthest(reach, Y) == pytest.approx(REACH / np.sqrt(8))
    np.testing.assert_allclose(np.abs(unreachable(reach).T), [Z], atol=1e-12)
    assert contains(reach, np.array([REACH * X, 1e-9 * Z])).tolist() == [True, False]


def test_a_box_about_home_of_rails_at_45_degrees_has_half_the_square_s_corners():
    """Two rails reach |x| + |y| <= sqrt(2) e: half a side of the box in it is e / sqrt(2)."""
    reach = reach_of([mass((1, 1, 0)), mass((1, -1, 0))], TOTAL)
    expected = REACH / np.sqrt(2)
    np.testing.assert_allclose(box_about_home(reach), [expected, expected, 0.0], atol=1e-15)


def test_a_box_about_home_keeps_to_the_shorter_way():
    """Of 20 mm one way and 60 mm the other 20 mm count; at an end, nothing; no mass, no box."""
    lame = reach_of([mass(X, travel=(-0.02, 0.06)), mass(Y), mass(Z)], TOTAL)
    np.testing.assert_allclose(box_about_home(lame), REACH * np.array([0.4, 1.0, 1.0]))
    still = reach_of([mass(X, travel=(0.0, 0.06)), mass(Y), mass(Z)], TOTAL)
    np.testing.assert_allclose(box_about_home(still), REACH * np.array([0.0, 1.0, 1.0]))
    np.testing.assert_array_equal(box_about_home(reach_of([], TOTAL)), np.zeros(3))


def test_every_corner_of_a_box_about_home_is_reached_and_of_a_larger_one_not():
    reach = reach_of(SKEW[:4], TOTAL)
    half = box_about_home(reach)
    ways = half * np.array(list(product((-1, 1), repeat=3)))
    assert half.min() > 50e-6
    assert contains(reach, 0.999 * ways).all()
    assert not contains(reach, 1.001 * ways).all()
