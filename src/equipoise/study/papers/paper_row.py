"""One number or finding of a paper beside this program's own, and whether they agree."""

from collections.abc import Iterable
from dataclasses import dataclass
from enum import StrEnum


class Agreement(StrEnum):
    """What a paper's number and ours are to each other."""

    AGREES = "agrees"  # within the scatter that is printed or measured
    BETTER = "better"  # ours errs less than what is printed
    DIFFERS = "differs"  # and ``why`` says why
    SHOWN = "shown"  # a figure, or a number of ours where the paper prints none


def no_larger(ours: Iterable[float], printed: Iterable[float], nearly: float = 0.0) -> Agreement:
    """Return what numbers that should be small are to printed ones; ``nearly``: a share more."""
    pairs = list(zip(ours, printed, strict=True))
    if all(a <= b for a, b in pairs):
        return Agreement.BETTER
    near = nearly > 0 and all(a <= (1 + nearly) * b for a, b in pairs)
    return Agreement.AGREES if near else Agreement.DIFFERS


@dataclass(frozen=True, slots=True)
class PaperRow:
    """A quantity of a paper: where it stands, what is printed, what is found here."""

    place: str  # such as "Fig. 9a", "section 5" or "Table 1, Bologna"
    quantity: str  # what it is, without its unit
    unit: str  # as the numbers are shown; empty: none
    printed: tuple[float, ...]  # in that unit; empty: no number is printed
    ours: tuple[float, ...]  # in that unit, component by component
    agreement: Agreement
    why: str = ""  # where it differs the cause; else the condition that matters
