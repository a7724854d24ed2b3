"""Numbers and tables as the text of a TOML file."""

import json
from collections.abc import Iterable, Mapping

Value = str | float | int | list[str] | list[float] | list[list[float]]
DIGITS = 15  # 200.0 mm comes back as 200.0, not 200.00000000000003


def number(value: float, factor: float = 1.0) -> float:
    """Return a number as it is written."""
    return float(f"{value * factor:.{DIGITS}g}")


def numbers(values: Iterable[float], factor: float = 1.0) -> list[float]:
    """Return numbers as they are written."""
    return [number(v, factor) for v in values]


def table(head: str, keys: Mapping[str, Value]) -> str:
    """Return one table; JSON's numbers, strings and lists are TOML's."""
    if not keys:
        return ""
    lines = [f"{key} = {json.dumps(value, ensure_ascii=False)}" for key, value in keys.items()]
    return "\n".join([*([head] if head else []), *lines, ""])
