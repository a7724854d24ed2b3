"""Whether a document is as its JSON Schema says: the few words that shipped schemas use.

A word that is not known here is an error, so that no part of a schema goes unchecked.
"""

from collections.abc import Iterator, Mapping
from typing import Any

TYPES = {
    "object": dict,
    "array": list,
    "string": str,
    "boolean": bool,
    "integer": int,
    "number": (int, float),
    "null": type(None),
}
WORDS = {
    "$schema",
    "title",
    "type",
    "properties",
    "required",
    "additionalProperties",
    "items",
    "anyOf",
    "const",
}


def faults(value: Any, schema: Mapping[str, Any], where: str = "") -> Iterator[str]:
    """Yield each place where a value is not as the schema says."""
    unknown = set(schema) - WORDS
    assert not unknown, f"{where}: {unknown} is not checked here"
    if "const" in schema and value != schema["const"]:
        yield f"{where}: {value!r}, wanted {schema['const']!r}"
    if "type" in schema and not is_of(value, schema["type"]):
        yield f"{where}: {value!r}, wanted {schema['type']}"
        return
    if "anyOf" in schema:
        found = [list(faults(value, each, where)) for each in schema["anyOf"]]
        if all(found):
            yield from min(found, key=len)
    if isinstance(value, dict):
        yield from faults_of_object(value, schema, where)
    if isinstance(value, list):
        for k, item in enumerate(value):
            yield from faults(item, schema.get("items", {}), f"{where}[{k}]")


def is_of(value: Any, kind: str | list[str]) -> bool:
    kinds = [kind] if isinstance(kind, str) else kind
    plain = [each for each in kinds if each != "boolean"]
    if isinstance(value, bool):
        return "boolean" in kinds
    return any(isinstance(value, TYPES[each]) for each in plain)


def faults_of_object(value: dict, schema: Mapping[str, Any], where: str) -> Iterator[str]:
    known, others = schema.get("properties", {}), schema.get("additionalProperties", True)
    for name in schema.get("required", ()):
        if name not in value:
            yield f"{where}: no '{name}'"
    for name, item in value.items():
        if name in known:
            yield from faults(item, known[name], f"{where}.{name}")
        elif others is False:
            yield f"{where}: '{name}' is not in the schema"
        elif others is not True:
            yield from faults(item, others, f"{where}.{name}")
