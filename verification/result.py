"""What a check found: one record, the same for terminal, document and test."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any

Spread = Callable[[Callable[[Any], Any], Iterable[Any]], list[Any]]


@dataclass(frozen=True, slots=True)
class Row:
    """One number, and what it should be."""

    quantity: str
    found: str
    wanted: str
    ok: bool


@dataclass(frozen=True, slots=True)
class Result:
    """A claim with the numbers for it."""

    name: str
    claim: str
    rows: tuple[Row, ...]
    notes: tuple[str, ...] = ()

    @property
    def missed(self) -> tuple[Row, ...]:
        """Return the rows that are not as wanted."""
        return tuple(row for row in self.rows if not row.ok)


def at_most(quantity: str, found: float, limit: float, form: str = ".3g") -> Row:
    """Return a row whose number may not exceed a limit."""
    return Row(quantity, f"{found:{form}}", f"at most {limit:{form}}", bool(found <= limit))


def at_least(quantity: str, found: float, limit: float, form: str = ".3g") -> Row:
    """Return a row whose number may not fall below a limit."""
    return Row(quantity, f"{found:{form}}", f"at least {limit:{form}}", bool(found >= limit))


def between(quantity: str, found: float, band: tuple[float, float], form: str = ".3g") -> Row:
    """Return a row whose number belongs in a band, ends included."""
    low, high = band
    wanted = f"{low:{form}} to {high:{form}}"
    return Row(quantity, f"{found:{form}}", wanted, bool(low <= found <= high))


def triple(values: Sequence[float], form: str = ".2f") -> str:
    """Return three numbers as text."""
    return "(" + ", ".join(f"{v:{form}}" for v in values) + ")"


def in_turn(work: Callable[[Any], Any], items: Iterable[Any]) -> list[Any]:
    """Do the work here, one item after the other."""
    return [work(item) for item in items]
