"""Numbers, tables and files as TOML; a person's file keeps its comments and its order."""

from collections.abc import Mapping, Sequence
from typing import Any, cast

import numpy as np
import tomlkit
from tomlkit import TOMLDocument
from tomlkit.items import InlineTable

Value = str | float | int | list["Value"] | dict[str, "Value"]
DIGITS = 15  # 200.0 mm comes back as 200.0, not 200.00000000000003


def number(value: float, unit: float = 1.0) -> float:
    """Return a number as it is written, in a unit of so much SI."""
    return float(f"{value / unit:.{DIGITS}g}")


def as_written(value: Any, unit: float = 1.0) -> Any:
    """Return a value in SI as it is written in a unit, however deep its numbers lie."""
    if isinstance(value, float):
        return number(value, unit)
    if isinstance(value, Mapping):
        return {key: as_written(each, unit) for key, each in cast(Any, value).items()}
    if isinstance(value, tuple | list | np.ndarray):
        return [as_written(each, unit) for each in cast("Sequence[Any]", value)]
    return value


def toml_text(keys: Mapping[str, Any]) -> str:
    """Return a file of keys, tables and rows of tables."""
    return tomlkit.dumps(keys)


def edited(text: str, keys: Mapping[str, Any]) -> str:
    """Return a file's text with other values of keys and further rows; all else stays."""
    document = tomlkit.parse(text)
    _edit(document, keys)
    return tomlkit.dumps(document)


def set_key(table: Any, key: str, value: Any, remark: str = "") -> None:
    """Set a key of a parsed table where it stands, else behind the last one that is there."""
    item = cast(Any, tomlkit.item(value))
    if remark and not isinstance(table, InlineTable):  # no comment may stand in one
        item.comment(remark)
        item.trivia.comment_ws = "  "
    body = table.body if isinstance(table, TOMLDocument) else table.value.body
    last = max((i for i, (name, _) in enumerate(body) if name is not None), default=-1)
    behind = body[last + 1 :]  # blank lines, and what is said of the table that follows
    del body[last + 1 :]
    table[key] = item
    body.extend(behind)


def _edit(table: Any, keys: Mapping[str, Any]) -> None:
    for key, value in keys.items():
        old = table.get(key)
        if isinstance(old, list) and value and isinstance(value[0], dict):
            rows = cast("list[Any]", old)
            for row, new in zip(rows, value, strict=False):
                _edit(row, new)
            for new in value[len(rows) :]:
                rows.append(new)
        elif old != value:
            set_key(table, key, value)
