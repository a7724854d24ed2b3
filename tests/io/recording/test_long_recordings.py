"""A long table takes little more memory than its numbers; a conversion does not grow with it."""

import sys
from pathlib import Path

import pytest

from tests.support.long_tables import CONVERT, READ, in_its_own_process, long_table

ROWS = 1_000_000
LIMIT = 300_000  # kB of memory, all of Python included

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="the system says it elsewhere")


@pytest.fixture(scope="module")
def table(tmp_path_factory) -> Path:
    return long_table(tmp_path_factory.mktemp("long") / "long.csv", ROWS)


def test_a_million_rows_are_read_in_300_mb(table) -> None:
    attitude, rate, end, peak = in_its_own_process(READ, table)
    assert (int(attitude), int(rate)) == (ROWS, ROWS)
    assert float(end) == pytest.approx(0.01 * (ROWS - 1))
    assert int(peak) < LIMIT


def test_a_million_rows_are_converted_in_300_mb(table, tmp_path) -> None:
    *_, peak = in_its_own_process(CONVERT, table, tmp_path / "out.csv")
    assert int(peak) < LIMIT
    assert (tmp_path / "out.csv").read_bytes() == table.read_bytes()
