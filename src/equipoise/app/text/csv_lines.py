"""Tables of runs as CSV: a line a run."""

import csv
from collections.abc import Iterable, Sequence
from io import StringIO
from typing import Any


def csv_lines(heads: Sequence[str], lines: Iterable[Sequence[Any]]) -> str:
    """Return the file's text; None is left blank."""
    text = StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(heads)
    writer.writerows(lines)
    return text.getvalue()
