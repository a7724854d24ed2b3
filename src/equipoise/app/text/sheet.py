"""A table with what is said below it, alike in the terminal and in a report."""

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True, slots=True, eq=False)
class Sheet:
    """Title, heads, lines of texts, remarks."""

    title: str
    heads: Sequence[str]
    lines: Sequence[Sequence[str]]
    remarks: Sequence[str] = ()
    words: Sequence[int] = (0,)  # columns of words, on the left; others of them may be folded
