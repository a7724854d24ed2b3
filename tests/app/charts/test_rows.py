"""What of a record stands in a chart: nothing that shows is lost."""

import numpy as np

from equipoise.app.charts.rows import STRETCHES, banded, rows_of, straight


def test_numbers_come_in_the_unit_shown():
    rows = rows_of(("x", "y"), np.array([0.0, 1.0]), np.array([[1e-6, 2e-6], [3e-6, 4e-6]]), 1e-6)
    assert rows.x == (0.0, 1.0)
    assert rows.columns == ((1.0, 3.0), (2.0, 4.0))


def test_a_spike_of_one_row_stays_in_a_long_record():
    n = 100_000
    t = np.arange(n) / 100.0
    values = np.zeros((n, 2))
    values[54_321, 0], values[77_777, 1] = 7.0, -3.0
    rows = rows_of(("x", "y"), t, values, 1.0)
    assert len(rows.x) == 2 * STRETCHES
    assert (max(rows.columns[0]), min(rows.columns[1])) == (7.0, -3.0)
    where = rows.x[rows.columns[0].index(7.0)]
    assert abs(where - t[54_321]) <= n / STRETCHES / 100.0
    assert list(rows.x) == sorted(rows.x)


def test_a_line_breaks_where_the_record_has_a_gap():
    t = np.array([0.0, 1.0, 2.0, 50.0, 51.0])
    values = np.arange(5.0)[:, None]
    assert rows_of(("x",), t, values, 1.0).columns[0] == (0.0, 1.0, 2.0, None, 3.0, 4.0)
    assert rows_of(("x",), t, values, 1.0, "dots").columns[0] == (0.0, 1.0, 2.0, 3.0, 4.0)
    assert straight(("x",), t, values, 1.0).columns[0] == (0.0, 1.0, 2.0, 3.0, 4.0)


def test_a_gap_stays_in_a_long_record():
    n = 10_000
    t = np.arange(n) / 10.0
    t[n // 2 :] += 500.0
    assert rows_of(("x",), t, np.ones((n, 1)), 1.0).columns[0].count(None) == 2


def test_bands_are_two_sd_on_either_side():
    one = np.ones((2, 1))
    rows = banded(("x",), np.array([0.0, 1.0]), 10.0 * one, 3.0 * one, 2.0)
    assert (rows.columns, rows.low, rows.high) == (((5.0, 5.0),), ((2.0, 2.0),), ((8.0, 8.0),))


def test_rows_at_one_time_stand_behind_each_other():
    rows = rows_of(("x",), np.array([0.0, 5.0, 5.0, 10.0]), np.arange(4.0)[:, None], 1.0)
    assert rows.x[0] < rows.x[1] < rows.x[2] < rows.x[3]
    assert rows.x[2] - rows.x[1] < 1e-4
