"""A course of numbers as a line of letters."""

from collections.abc import Mapping, Sequence
from itertools import pairwise

BLOCKS = "▁▂▃▄▅▆▇█"
PLAIN = "_.:-=+*#"  # for terminals whose encoding lacks blocks


def sparkline(values: Sequence[float | None], letters: str = BLOCKS) -> str:
    """Return a letter for each number from zero to the greatest; a blank for None."""
    greatest = max((value for value in values if value is not None), default=0.0)
    return "".join(" " if value is None else _letter(value, greatest, letters) for value in values)


def above_least(values: Sequence[float | None], width: int, letters: str = BLOCKS) -> str:
    """Return a letter for each of ``width`` parts of a course, from its least to its greatest.

    A letter is of the first number of its part; a blank of a part without one.
    """
    known = [value for value in values if value is not None]
    if not known:
        return ""
    least, parts = min(known), min(width, len(values))
    starts = [k * len(values) // parts for k in range(parts + 1)]
    first = (next((v for v in values[a:b] if v is not None), None)
             for a, b in pairwise(starts))  # fmt: skip
    return sparkline([None if v is None else v - least for v in first], letters)


def in_columns(
    by_second: Mapping[int, float], span: int, width: int
) -> tuple[list[float | None], int]:
    """Return the greatest of each of some columns, and how many seconds they are of.

    The columns end with the newest second and are of whole seconds, each of as many; no more than
    ``width`` of them, of ``span`` seconds at most. A column begins where its number of seconds
    divides the time, so that what it shows stays while time goes on.
    """
    if not by_second:
        return [], 0
    each = -(-span // max(min(width, span), 1))
    last = max(by_second) // each
    first = max(min(by_second) // each, last - span // each + 1)
    columns: list[float | None] = [None] * (last - first + 1)
    for second, value in by_second.items():
        k = second // each - first
        if k >= 0:
            columns[k] = max(columns[k] or 0.0, value)
    return columns, each * len(columns)


def _letter(value: float, greatest: float, letters: str) -> str:
    share = value / greatest if greatest > 0 else 0.0
    return letters[min(int(share * len(letters)), len(letters) - 1)]
