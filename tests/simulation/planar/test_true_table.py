"""What a testbed's [truth.table] says, as the motion takes it."""

from dataclasses import replace

import pytest

from equipoise.dynamics.planar.friction_map import friction_at
from equipoise.simulation.planar.true_table import true_table
from tests.simulation.planar.test_planar_bench import bed


def test_corners_have_the_friction_in_the_order_that_is_documented():
    friction = true_table(bed()).top.friction
    assert friction_at(friction, -1.0, 1.0) == pytest.approx(0.1)  # low x, high y
    assert friction_at(friction, 1.0, -1.0) == pytest.approx(0.15)  # high x, low y


def test_gravity_leans_downhill_and_pulls_there():
    top = true_table(bed()).top
    assert top.pull[0] > 0 > top.pull[1]
    assert top.gravity_N[:2] == pytest.approx(top.pull)
    assert top.floating_mass == pytest.approx(19.0)


def test_without_a_truth_it_is_level_and_slippery_and_p_rests_in_its_middle():
    plain = bed()
    floor = true_table(replace(plain, truth=replace(plain.truth, table=None)))
    assert floor.top.pull == (0.0, 0.0)
    assert friction_at(floor.top.friction, 0.3, 0.4) == 0.0
    assert floor.position == pytest.approx([0.0, 0.0])
    assert floor.velocity == pytest.approx([0.0, 0.0])
