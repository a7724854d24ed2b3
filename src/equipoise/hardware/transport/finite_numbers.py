"""Numbers as devices print them; what is not a finite number is none."""

import math
from collections.abc import Iterable
from typing import Any


def finite(text: Any) -> float | None:
    """Return a number; None if it is none, or not finite."""
    try:
        value = float(text)
    except (ValueError, OverflowError):
        return None
    return value if math.isfinite(value) else None


def all_finite(texts: Iterable[Any]) -> tuple[float, ...] | None:
    """Return numbers; None if one of them is none, or not finite."""
    values = [finite(text) for text in texts]
    found = tuple(value for value in values if value is not None)
    return found if len(found) == len(values) else None
