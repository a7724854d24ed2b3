"""A JSON schema as tables: a section for each object, a row for each of its keys."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

Schema = Mapping[str, Any]
HEADINGS = ("key", "type", "required", "meaning")


def sections(schema: Schema) -> Iterator[str]:
    """Yield a heading and a table for each object of a schema, outer ones first."""
    waiting = [("", schema)]
    while waiting:
        path, found = waiting.pop(0)
        if path:
            yield f"## `{path}`\n"
            yield f"{text(found.get('description', ''))}\n"
        keys = found.get("properties", {})
        yield from _table([
            (f"`{key}`", text(kind(value, schema)), _needed(key, found), _meaning(value))
            for key, value in keys.items()
        ])  # fmt: skip
        waiting += [
            (f"{path}.{key}{mark}".lstrip("."), inner)
            for key, value in keys.items()
            for mark, inner in _objects(value, schema)
        ]


def _table(rows: Sequence[tuple[str, ...]]) -> Iterator[str]:
    """Yield a table without the columns that are empty in all rows."""
    used = [i for i in range(len(HEADINGS)) if any(row[i] for row in rows)]
    for row in (HEADINGS, ("---",) * len(HEADINGS), *rows) if rows else ():
        yield f"| {' | '.join(row[i] for i in used)} |"
    yield ""


def _needed(key: str, of: Schema) -> str:
    """Return whether a key must be there; nothing where all must."""
    required = of.get("required", ())
    return "" if key not in required or len(required) == len(of["properties"]) else "yes"


def _meaning(value: Schema) -> str:
    default = value.get("default")
    if default in (None, [], {}) or isinstance(default, dict):
        return text(value.get("description", ""))
    parts = (text(value.get("description", "")), f"default {_literal(default)}")
    return "; ".join(filter(None, parts))


def kind(schema: Schema, whole: Schema) -> str:
    """Return what a key may hold, in words."""
    schema = resolved(schema, whole)
    if "const" in schema or "enum" in schema:
        return ", ".join(map(_literal, schema.get("enum", [schema.get("const")])))
    choices = [*schema.get("anyOf", ()), *schema.get("oneOf", ())]
    if choices:
        return " or ".join(dict.fromkeys(kind(each, whole) for each in choices))
    named = schema.get("type", "any")
    if named == "array":
        return _array(schema, whole)
    if named == "object":
        inner = schema.get("additionalProperties")
        return f"object of {kind(inner, whole)}" if isinstance(inner, dict) else "object"
    return (named if isinstance(named, str) else " or ".join(named)) + _limits(schema)


def _array(schema: Schema, whole: Schema) -> str:
    if "prefixItems" in schema:
        kinds = [kind(each, whole) for each in schema["prefixItems"]]
        alike = len(set(kinds)) == 1
        return f"{len(kinds)} x {kinds[0]}" if alike else f"[{', '.join(kinds)}]"
    return f"array of {kind(schema.get('items', {}), whole)}"


def _limits(schema: Schema) -> str:
    """Return the range of a number."""
    signs = (("exclusiveMinimum", ">"), ("minimum", ">="), ("exclusiveMaximum", "<"),
             ("maximum", "<="))  # fmt: skip
    return ",".join(f" {sign} {schema[name]:g}" for name, sign in signs if name in schema)


def _objects(schema: Schema, whole: Schema) -> Iterator[tuple[str, Schema]]:
    """Yield the objects with keys of their own in what a key may hold, with the mark of arrays."""
    schema = resolved(schema, whole)
    if schema.get("properties"):
        yield "", schema
    if isinstance(schema.get("items"), dict):
        yield from ((f"[]{mark}", inner) for mark, inner in _objects(schema["items"], whole))
    inner = schema.get("additionalProperties")
    if isinstance(inner, dict) and not schema.get("properties"):
        yield from ((f".NAME{mark}", each) for mark, each in _objects(inner, whole))
    for choice in ("anyOf", "oneOf"):
        for each in schema.get(choice, ()):
            yield from _objects(each, whole)


def resolved(schema: Schema, whole: Schema) -> Schema:
    """Return a schema, or what it refers to, with its own description."""
    if "$ref" not in schema:
        return schema
    name = schema["$ref"].rpartition("/")[2]
    own = {key: value for key, value in schema.items() if key != "$ref"}
    return whole["$defs"][name] | own


def _literal(value: object) -> str:
    return f"`{value}`" if isinstance(value, str) else f"{value}"


def text(sentence: str) -> str:
    """Return text as a cell of a table, with nothing in it that Markdown would take."""
    return " ".join(sentence.split()).replace("|", "\\|").replace("<", "&lt;").replace("*", "\\*")
