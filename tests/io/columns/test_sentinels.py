"""Numbers that stand for no reading: taken for such on clear evidence, else left alone."""

import numpy as np
import pytest

from equipoise.io.columns.sentinels import sentinel_rows

READINGS = np.sin(np.arange(40.0))
ROWS = [3, 17, 20]


def column(mark: float, rows=ROWS, readings=READINGS):
    """Return readings, some of them replaced."""
    values = readings.copy()
    values[list(rows)] = mark
    return values


@pytest.mark.parametrize("mark", [-999.0, 999.0, -9999.0, 99999.0, -999.9, 1e30, -3.4028235e38])
def test_a_number_in_use_that_recurs_beyond_the_others_is_none(mark) -> None:
    assert sentinel_rows(column(mark)).tolist() == ROWS


@pytest.mark.parametrize(
    "values",
    [
        READINGS,
        column(-999.0, rows=[3]),  # once: a spike
        column(-998.0),  # no number that programs write
        column(-999.0, readings=20.0 * READINGS),  # near the others
        column(-999.0, rows=range(30)),  # most of the column
        column(-999.0, readings=np.zeros(40)),  # a setting that is on or off
        column(1e29),
        np.full(5, np.nan),
        np.full(5, -999.0),
    ],
)
def test_all_else_is_left_alone(values) -> None:
    assert sentinel_rows(values).tolist() == []


def test_rows_without_a_number_do_not_count() -> None:
    values = column(-999.0)
    values[5:10] = np.nan
    assert sentinel_rows(values).tolist() == ROWS
