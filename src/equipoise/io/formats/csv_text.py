"""Columns of numbers as CSV text that reads back to the last bit."""

from collections.abc import Mapping

from equipoise.model.arrays import Series1


def csv_text(columns: Mapping[str, Series1]) -> str:
    """Return a header and rows; NaN becomes a blank cell."""
    # Python prints the fewest digits (up to 17) that give the same double again.
    cells = [["" if x != x else repr(x) for x in map(float, v)] for v in columns.values()]
    rows = map(",".join, zip(*cells, strict=True))
    return "\n".join([",".join(columns), *rows]) + "\n"
