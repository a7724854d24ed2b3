"""What a header of several lines is made of, and the one line it becomes."""

import csv
import io
import math

PADDING = ' ,;\t"'  # of a line with one cell that a spreadsheet has saved


def line_of(cells: list[str], separator: str) -> str:
    """Return cells as a line."""
    stream = io.StringIO()
    csv.writer(stream, delimiter=separator, lineterminator="").writerow(cells)
    return stream.getvalue()


def rate_of(text: str) -> float | None:
    """Return a rate (Hz); None if a text is none."""
    try:
        rate = float(text)
    except ValueError:
        return None
    return rate if 0 < rate < math.inf else None
