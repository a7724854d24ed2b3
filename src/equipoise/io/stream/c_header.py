"""The header in C99 that decodes the datagram of the gravity torque, written from its fields.

It needs no heap, no library beside memcpy and no byte order of its own.
"""

from pathlib import Path

from equipoise.io.stream.gravity_datagram import (
    FADE,
    FIELDS,
    MAGIC,
    OFFSETS,
    SIZE,
    VERSION,
    Field,
)
from equipoise.model.gravity_torque import TorqueStatus

TEMPLATE = Path(__file__).with_name("gravity_torque_template.h")
HEADER = "equipoise_gravity_torque.h"
WIDTHS = {"H": 2, "I": 4, "Q": 8}
TABLE_HEAD = ("offset", "bytes", "field", "type", "meaning")


def header() -> str:
    """Return the whole header."""
    text = TEMPLATE.read_text(encoding="utf-8")
    parts = {"CONSTANTS": _constants(), "STRUCTURE": _structure(), "FINITE": _finite(),
             "TAKEN": "".join(map(_taken, FIELDS, OFFSETS))}  # fmt: skip
    for name, part in parts.items():
        text = text.replace(f"@{name}@", part)
    return text


def table() -> str:
    """Return the fields as a table in Markdown."""
    rows = [
        (str(offset), str(each.size), f"`{each.name}`", _type(each), each.meaning)
        for each, offset in zip(FIELDS, OFFSETS, strict=True)
    ]
    lines = [TABLE_HEAD, tuple("---" for _ in TABLE_HEAD), *rows]
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def _type(field: Field) -> str:
    return field.c_type if field.elements == 1 else f"{field.c_type}[{field.elements}]"


def _constants() -> str:
    """Return what the code of the header names: numbers of the layout, and the statuses."""
    numbers = {
        "MAGIC": f'"{MAGIC.decode()}"',
        "VERSION": VERSION,
        "SIZE": SIZE,
        "AT_VERSION": _at("version"),
        "AT_SIZE": _at("size"),
        "FADE_S": FADE,
    }
    defined = "".join(f"#define EQUIPOISE_{name} {value}\n" for name, value in numbers.items())
    statuses = ", ".join(f"EQUIPOISE_{each.name} = {each.value}" for each in TorqueStatus)
    return f"{defined}\nenum {{ {statuses} }}; /* of the field status */\n"


def _structure() -> str:
    lines = [
        f"    {each.c_type} {each.name}{'' if each.elements == 1 else f'[{each.elements}]'};"
        f" /* {each.meaning} */\n"
        for each in FIELDS
    ]
    return f"typedef struct {{\n{''.join(lines)}}} equipoise_gravity_torque;\n"


def _finite() -> str:
    """Return a line for each number that has to be finite."""
    return "".join(
        f"    if (!equipoise_is_finite(data + {offset + 8 * k})) return EQUIPOISE_NOT_FINITE;\n"
        for each, offset in zip(FIELDS, OFFSETS, strict=True)
        if each.code == "d"
        for k in range(each.count)
    )


def _at(name: str) -> int:
    return OFFSETS[[each.name for each in FIELDS].index(name)]


def _taken(field: Field, offset: int) -> str:
    if field.code == "4s":
        return f"    memcpy(found->{field.name}, data + {offset}, {field.size});\n"
    if field.code in WIDTHS:
        width = WIDTHS[field.code]
        return (
            f"    found->{field.name} = "
            f"({field.c_type})equipoise_whole(data + {offset}, {width});\n"
        )
    if field.count == 1:
        return f"    found->{field.name} = equipoise_double(data + {offset});\n"
    return (
        f"    for (int k = 0; k < {field.count}; ++k)\n"
        f"        found->{field.name}[k] = equipoise_double(data + {offset} + 8 * k);\n"
    )
