"""Read a TOML file against a schema; every problem becomes one sentence with file and key."""

import itertools
import re
import tomllib
from difflib import get_close_matches
from pathlib import Path
from typing import Any, TypeVar

from pydantic import ValidationError
from pydantic.fields import FieldInfo
from pydantic_core import ErrorDetails

from equipoise.io.files.source_file import read_text
from equipoise.io.toml.key_types import Table, table_in
from equipoise.io.toml.units import SPOKEN, split_unit
from equipoise.model.errors import MEANT, InputError, declared

Model = TypeVar("Model", bound=Table)
LARGEST = 1_000_000  # bytes of a file (chosen: forty times the longest testbed)
DEEPEST = 32  # tables within tables (chosen: ours have four)
# What is no key: texts of several lines and of one, remarks.
QUOTED = re.compile(
    r'"""[\s\S]*?"""'
    r"|'''[\s\S]*?'''"
    r'|"(?:\\.|[^"\\\n])*"'
    r"|'[^'\n]*'|#[^\n]*"
)
BRACKETS = re.compile(r"[\[\]{}]")
BETWEEN = re.compile(r"[^,=\[\]{}\n]+")  # what holds one key or one value
SHOWN = 60  # characters of a found value that are repeated; chosen: one line of a terminal
# What pydantic calls a problem: what the person should have written.
PLAIN = {
    "float_type": "a number without quotes",
    "int_type": "a whole number without quotes",
    "finite_number": "a finite number",
    "greater_than": "a number above {gt:g}",
    "greater_than_equal": "a number of at least {ge:g}",
    "less_than": "a number below {lt:g}",
    "less_than_equal": "a number of at most {le:g}",
    "too_short": "a list of {min_length} or more",
    "too_long": "a list of {max_length} at most",
    "string_type": "text in quotes",
    "list_type": "a list in square brackets",
    "literal_error": "{expected}",
    "string_pattern_mismatch": "a letter, then letters, digits, '_' or '-'",
    "string_too_short": "text that is not empty",
    "model_type": "a table",
    "model_attributes_type": "a table",
}


def read_toml(path: str | Path, schema: type[Model], wanted: str) -> Model:
    """Return the file's content as a record of ``schema``."""
    with declared(str(path), wanted):
        return parse_toml(read_text(path, wanted, LARGEST), str(path), schema)


def parse_toml(text: str, source: str, schema: type[Model]) -> Model:
    """Return TOML text as a record of ``schema``; ``source`` names the text in errors."""
    _check_depth(text, source)
    try:
        data = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise _syntax_error(text, source, error) from error
    except ValueError as error:  # a number of more digits than Python reads
        raise InputError(
            source, str(error).partition(";")[0], "numbers that a double holds"
        ) from error
    try:
        return schema.model_validate(data)
    except ValidationError as error:
        problems = error.errors(include_url=False)
        # A misspelt key is reported as unknown and as missing: the first says more.
        first = min(problems, key=lambda p: p["type"] != "extra_forbidden")
        raise _sentence(first, source, schema) from error


def _check_depth(text: str, source: str) -> None:
    """Raise InputError for tables or lists so deep in others that a parser takes for ever."""
    bare = QUOTED.sub(lambda quoted: "_" + "\n" * quoted[0].count("\n"), text)
    dotted = (m.start() for m in BETWEEN.finditer(bare) if m[0].count(".") > DEEPEST)
    places = [match.start() for match in BRACKETS.finditer(bare)]
    depths = itertools.accumulate(1 if bare[at] in "[{" else -1 for at in places)
    nested = (at for at, depth in zip(places, depths, strict=True) if depth > DEEPEST)
    at = next(itertools.chain(dotted, nested), None)
    if at is not None:
        line = bare.count("\n", 0, at) + 1
        wanted = f"at most {DEEPEST} of them"
        raise InputError(f"{source}, line {line}", "tables or lists deep in others", wanted)


def _syntax_error(text: str, source: str, error: tomllib.TOMLDecodeError) -> InputError:
    """Return where the text stops being TOML; the parser gives its place only in its words."""
    message, _, place = str(error).rpartition(" (at ")
    words = place.rstrip(")").replace(",", "").split()
    if len(words) < 2 or words[0] != "line":
        return InputError(f"{source}, last line", str(error), "valid TOML")
    line = int(words[1])
    shown = text.splitlines()[line - 1].strip() if line <= len(text.splitlines()) else ""
    return InputError(f"{source}, line {line}", f"'{shown}' ({message})", "valid TOML")


def _sentence(problem: ErrorDetails, source: str, schema: type[Table]) -> InputError:
    """Return one problem as found and wanted."""
    place = problem["loc"]
    where = f"{source}: {dotted(place)}"
    key = str(place[-1])
    if problem["type"] == "extra_forbidden":
        return InputError(
            where, f"unknown key '{key}'", _meant(key, list(_table_at(schema, place)))
        )
    if problem["type"] == "missing":
        return InputError(where, "no such key", _missing(place, schema))
    plain = PLAIN.get(problem["type"], problem["msg"]).format(**problem.get("ctx", {}))
    name = _last_name(place)
    unit = "" if problem["type"] == "literal_error" else _in_unit(name)
    if problem["type"] == "string_pattern_mismatch" and name in _table_at(schema, place):
        plain = _table_at(schema, place)[name].description or plain
    return InputError(where, _shown(problem["input"]), plain + unit)


def dotted(place: tuple[int | str, ...]) -> str:
    """Return a key's path as people write it; rows of a list count from 1."""
    parts = [f"[{p + 1}]" if isinstance(p, int) else f".{p}" for p in place]
    return "".join(parts).lstrip(".")


def _meant(key: str, known: list[str]) -> str:
    """Say which key was meant: the same quantity in another unit, else the nearest spelling."""
    stem = split_unit(key)[0]
    same = [name for name in known if split_unit(name)[0] == stem]
    if same:
        return f"the key '{same[0]}'{_in_unit(same[0])}: the unit belongs to the key"
    close = get_close_matches(key, known, n=1) or get_close_matches(stem, known, n=1)
    return f"{MEANT} '{close[0]}'?" if close else "one of " + ", ".join(known)


def _missing(place: tuple[int | str, ...], schema: type[Table]) -> str:
    """Say where a key that has to be there stands, in which unit, and what it is."""
    key, table = str(place[-1]), place[:-1]
    declared = _table_at(schema, place)[key]
    if table_in(declared.annotation) is not None:
        return "a table of this name"
    home = f"in the table {dotted(table)}" if table else "above all tables"
    meaning = f": {declared.description}" if declared.description else ""
    return f"it {home}{_in_unit(key)}{meaning}"


def _in_unit(key: str) -> str:
    """Return ', in mm' and the like."""
    unit = split_unit(key)[1]
    return f", in {SPOKEN[unit]}" if unit else ""


def _last_name(place: tuple[int | str, ...]) -> str:
    """Return the key that an entry of a list belongs to."""
    return next((p for p in reversed(place) if isinstance(p, str)), "")


def _shown(value: Any) -> str:
    """Return a found value, shortened."""
    text = repr(value)
    return text if len(text) <= SHOWN else text[: SHOWN - 3] + "..."


def _table_at(schema: type[Table], place: tuple[int | str, ...]) -> dict[str, FieldInfo]:
    """Return the keys of the table that holds ``place``, as they are declared."""
    table = schema
    for part in place[:-1]:
        if isinstance(part, str) and part in table.model_fields:
            table = table_in(table.model_fields[part].annotation) or table
    return dict(table.model_fields)
