"""Jumps as a user gives them: in order, within the record, and where a grid has them."""

import numpy as np
import pytest

from equipoise.estimation.output_error.segment_jumps import (
    UNCUT,
    Jump,
    carried,
    cuts_of,
    inside,
    walk,
    width,
)
from equipoise.estimation.parameters.fit_parameters import Layout
from equipoise.model.estimate import ATTITUDE, COM, RATE

LAYOUT = Layout(("swirl",), (), True, ("plumb_x",))
HIT = Jump(3.0, RATE, (0.1, 0.2, 0.3), is_event=True)
SLIP = Jump(5.0, ("com_x",), (1e-3,))


def test_only_jumps_within_the_record_count_and_in_order_of_time():
    """Neither its first nor its last moment is within."""
    edges = Jump(0.0, RATE, (1.0,) * 3), Jump(10.0, RATE, (1.0,) * 3)
    outside = Jump(-1.0, (), ()), Jump(11.0, (), ())
    assert inside((SLIP, *edges, *outside, HIT), 0.0, 10.0) == (HIT, SLIP)


def test_jumps_of_one_time_are_one():
    """Names and sd in the order given; one event among them makes it an event."""
    both = inside((Jump(5.0, RATE, (0.1, 0.2, 0.3), is_event=True), SLIP), 0.0, 10.0)
    assert both == (Jump(5.0, (*RATE, "com_x"), (0.1, 0.2, 0.3, 1e-3), is_event=True),)
    assert not inside((SLIP, Jump(5.0, ("com_y",), (1.0,))), 0.0, 10.0)[0].is_event


def test_jumps_that_differ_by_rounding_are_one():
    """At the first of their times; a microsecond apart they are two."""
    near, later = Jump(5.0 + 1e-12, ("com_y",), (1.0,)), Jump(5.0 + 1e-6, ("com_z",), (1.0,))
    assert inside((later, near, SLIP), 0.0, 10.0) == (
        Jump(5.0, ("com_x", "com_y"), (1e-3, 1.0)), later,
    )  # fmt: skip


def test_a_jump_at_the_edge_but_for_rounding_is_at_the_edge():
    """Before the first row, or behind the last, nothing shows it."""
    assert inside((Jump(1e-12, RATE, (1.0,) * 3), Jump(10 - 1e-12, (), ())), 0.0, 10.0) == ()


def test_walk_jumps_at_every_time():
    found = walk(np.array([1.0, 2.0]), RATE, np.array([0.1, 0.2, 0.3]))
    assert found == (Jump(1.0, RATE, (0.1, 0.2, 0.3)), Jump(2.0, RATE, (0.1, 0.2, 0.3)))


def test_width_is_that_of_the_widest():
    """At least one column, so that arrays are never empty."""
    assert width((HIT, SLIP)) == 3
    assert width((Jump(1.0, (), ()),)) == 1
    assert width(UNCUT) == 1


def test_values_are_carried_by_time_and_name():
    """What was there before keeps its value, wherever its column is now; the rest is zero."""
    old = (HIT, SLIP)
    values = np.array([[1.0, 2.0, 3.0], [4.0, 0.0, 0.0]])
    new = (
        Jump(2.0, RATE, (1.0,) * 3),
        Jump(3.0, ("com_x", "rate_z", "rate_x", "com_y"), (1.0,) * 4),
        Jump(5.0, (), ()),
    )
    found = carried(old, values, new)
    np.testing.assert_array_equal(found, [[0] * 4, [0, 3, 1, 0], [0] * 4])
    np.testing.assert_array_equal(carried(new, found, old), [[1, 0, 3], [0, 0, 0]])
    assert carried(UNCUT, np.zeros((0, 1)), UNCUT).shape == (0, 1)


def test_cuts_by_hand():
    """Nodes of the grid, coordinates of the layout, weights 1 / sd^2; what is not there is -1."""
    t = np.array([0.0, 1.5, 3.0, 4.0, 5.0, 10.0])
    cuts = cuts_of((HIT, Jump(4.0, (), ()), SLIP), t, LAYOUT)
    np.testing.assert_array_equal(cuts.nodes, [0, 2, 3, 4, 5])
    np.testing.assert_array_equal(cuts.free, [[3, 4, 5], [-1] * 3, [12, -1, -1]])
    np.testing.assert_allclose(cuts.weight, [[100, 25, 100 / 9], [0] * 3, [1e6, 0, 0]])


def test_uncut_is_one_stretch():
    cuts = cuts_of(UNCUT, np.linspace(0, 10, 11), LAYOUT)
    np.testing.assert_array_equal(cuts.nodes, [0, 10])
    assert cuts.free.shape == cuts.weight.shape == (0, 1)


@pytest.mark.parametrize("rounding", [-1e-12, 1e-12])
def test_a_node_is_found_in_spite_of_rounding(rounding):
    cuts = cuts_of((HIT,), np.array([0.0, 2.0, 3.0 + rounding, 10.0]), LAYOUT)
    assert cuts.nodes[1] == 2


def test_every_coordinate_may_jump():
    """Attitude, rate, com, a torque, a sensor's coefficient and the bias, each by its own place."""
    names = (*ATTITUDE, *RATE, *COM, "swirl", "plumb_x", "gyro_bias_z")
    cuts = cuts_of((Jump(1.0, names, (1.0,) * 12),), np.array([0.0, 1.0, 2.0]), LAYOUT)
    assert cuts.free[0].tolist() == [0, 1, 2, 3, 4, 5, 12, 13, 14, 15, 16, 19]
