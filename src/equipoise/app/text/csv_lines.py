"""Tables of runs as CSV: a line a run."""

import csv
from collections.abc import Iterable, Sequence
from io import StringIO
from typing import Any

from equipoise.app.text.escaping import for_csv_cell


def csv_lines(heads: Sequence[str], lines: Iterable[Sequence[Any]]) -> str:
    """Return the file's text; None is left blank, and no cell is a formula to a spreadsheet."""
    text = StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerows([for_csv_cell(cell) for cell in line] for line in (heads, *lines))
    return text.getvalue()
