"""A finding: a fact about a recording, or a problem of it."""

from dataclasses import dataclass
from typing import Literal

from equipoise.model.reasons.reason import Coded, Reason

Kind = Literal["content", "motion", "problem", "wrong", "mended"]


@dataclass(frozen=True, slots=True)
class Finding(Coded):
    """What was found, the main thing first, and when it holds.

    ``content`` is what was recorded, ``motion`` what the platform did, ``problem`` what an
    estimate will suffer from, ``wrong`` what no estimate can stand, with what mends it, ``mended``
    what reading the file set right.
    """

    kind: Kind
    reasons: tuple[Reason, ...]
    span: tuple[float, float] | None = None  # s; None: the record as a whole
    label: str = ""  # a word for its mark in a figure, if it has one
