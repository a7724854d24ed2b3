"""Bands of many runs: the quantiles of groups that share the rows evenly."""

from datetime import datetime, timedelta

import numpy as np
import pytest

from equipoise.app.figures.study import trend
from equipoise.app.logbook.trend_bands import CROWDED, GROUPS, over, over_time

FIRST = datetime(2026, 1, 1)


def times(count):
    return [FIRST + timedelta(hours=k) for k in range(count)]


def test_few_runs_stand_one_by_one():
    assert over_time(times(CROWDED), np.zeros((CROWDED, 6))) == []


def test_a_group_has_the_quantiles_of_its_rows():
    """300 groups of 41 numbers 0, 0.025, ... 1: their quantiles are 0.025, 0.5 and 0.975."""
    numbers = np.tile(np.linspace(0.0, 1.0, 41), GROUPS)
    (band,) = over_time(times(len(numbers)), numbers[:, None])
    assert len(band.at) == GROUPS
    assert band.at[0] == np.datetime64(FIRST + timedelta(hours=20))  # the middle row of the first
    assert band.low == pytest.approx(np.full(GROUPS, 0.025))
    assert band.middle == pytest.approx(np.full(GROUPS, 0.5))
    assert band.high == pytest.approx(np.full(GROUPS, 0.975))


def test_groups_are_in_the_order_of_what_they_stand_over_and_without_gaps():
    x = np.array([3.0, 1.0, np.nan, 2.0])
    first, none = over(x, np.array([[30.0, np.nan], [10.0, np.nan], [5.0, 1.0], [20.0, np.nan]]))
    assert first.at.tolist() == [1.0, 2.0, 3.0]
    assert first.middle.tolist() == [10.0, 20.0, 30.0]
    assert none.at.tolist() == none.middle.tolist() == []


def test_many_runs_are_drawn_as_bands():
    """One line and one shade a value, in units of the axes, however many runs there are."""
    count = CROWDED + 1
    values, warmth = np.full((count, 6), 3e-6), np.linspace(20.0, 21.0, count)
    values[:, 3:] = np.nan  # an inertia that no run found
    figure = trend.draw(
        trend.Trend("a", times(count), values, values, ["A"] * count, warmth,
                    over_time(times(count), values), over(warmth, values))
    )  # fmt: skip
    assert len(figure.axes) == 12
    for axes in figure.axes:
        assert (len(axes.lines), len(axes.collections)) == (1, 1)
    assert set(figure.axes[0].lines[0].get_ydata()) == {3.0}  # um
