"""Something that a record holds, or that is wrong with it."""

from dataclasses import dataclass
from typing import Literal

Kind = Literal["content", "motion", "problem", "mended"]


@dataclass(frozen=True, slots=True)
class Finding:
    """One sentence for a person, and when it holds.

    ``content`` is what was recorded, ``motion`` what the platform did, ``problem`` what an
    estimate will suffer from, ``mended`` what reading the file set right.
    """

    kind: Kind
    sentence: str
    span: tuple[float, float] | None = None  # s; None: the record as a whole
    label: str = ""  # a word for its mark in a figure, if it has one
