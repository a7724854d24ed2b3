"""A board's program in C: its functions, its memory field by field, and how that begins.

The memory is one struct of numbers and arrays. A field that no function uses is left out, so that
its size is what the program needs.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from equipoise.model.arrays import Vector3
from equipoise.model.testbed import Testbed
from equipoise.onboard.program.board import Board, Memory, board_of, on_row
from equipoise.onboard.translation.functions import new_unit
from equipoise.onboard.translation.literals import literal, real_literal
from equipoise.onboard.translation.unit import Leaf, Unit, class_of, followed
from equipoise.onboard.translation.values import (
    ArrayType,
    Code,
    RecordType,
    Scalar,
    Type,
    source_function,
    type_of,
)

ELEMENTS = {"f": Scalar.REAL, "i": Scalar.INT, "b": Scalar.BOOL}
OWN, MEMORY = "own", "memory"
BYTES_IN_DOUBLE = {Scalar.REAL: 8, Scalar.INT: 4, Scalar.BOOL: 1}  # larger first: no gaps
BYTES = {Scalar.REAL: 4, Scalar.INT: 4, Scalar.BOOL: 1}  # in single precision on 32 bits


@dataclass(frozen=True, slots=True)
class Field:
    """A field of the memory."""

    name: str
    kind: ArrayType
    start: Any  # the array before the first row


@dataclass(frozen=True, slots=True)
class Translated:
    """A board's program in C."""

    method: str
    law: str
    testbed: Testbed
    target: Vector3  # m
    board: Board
    memory: Memory  # before the first row
    functions: str
    call: str  # of the entry, from the memory ``self`` and the row
    fields: tuple[Field, ...]
    table_size: int  # numbers in constant tables

    @property
    def state_bytes(self) -> int:
        """Bytes of the memory in single precision."""
        size = sum(BYTES[field.kind.element] * field.kind.size for field in self.fields)
        return -(-size // 4) * 4

    @property
    def table_bytes(self) -> int:
        """Bytes of the constant tables in single precision."""
        return BYTES[Scalar.REAL] * self.table_size


def memory_type(thing: Any) -> Type:
    """Return the type of arrays and of records of them: nothing in them is known."""
    if hasattr(thing, "dtype"):
        return ArrayType(ELEMENTS[thing.dtype.kind], thing.shape)
    fields = ((name, memory_type(getattr(thing, name))) for name in thing._fields)
    return RecordType(class_of(thing), tuple(fields))


def translated(method: str, law: str, testbed: Testbed, target: Vector3) -> Translated:
    """Return a method and a law for a testbed in C."""
    board, memory = board_of(method, law, testbed, target)
    unit, masses = new_unit(), len(testbed.masses)
    constants = unit.lifted(board)
    real, (q, rate, d) = Scalar.REAL, (ArrayType(Scalar.REAL, (n,)) for n in (4, 3, masses))
    kinds = {OWN: type_of(constants), MEMORY: memory_type(memory),
             "dt": real, "q": q, "rate": rate, "d": d}  # fmt: skip
    function = source_function(on_row)
    assert function is not None
    entry = unit.instance(function, kinds)
    found = [
        Field(leaf.name.removeprefix("memory_"), leaf.kind, array_at(memory, leaf.path[1:]))
        for leaf in entry.leaves
        if leaf.path[0] == MEMORY and isinstance(leaf.kind, ArrayType)
    ]
    fields = tuple(sorted(found, key=lambda field: -BYTES_IN_DOUBLE[field.kind.element]))
    call = f"{entry.name}({', '.join(argument(unit, constants, leaf) for leaf in entry.leaves)});"
    text = unit.text_for(entry.name, call)
    tables = sum(
        code.type.size for code, line in unit.tables.values()
        if line in text and isinstance(code.type, ArrayType)
    )  # fmt: skip
    return Translated(method, law, testbed, target, board, memory, text, call, fields, tables)


def argument(unit: Unit, constants: Any, leaf: Leaf) -> str:
    """Return what the entry is given for a leaf."""
    if leaf.path[0] == MEMORY:
        return f"self->{leaf.name.removeprefix('memory_')}"
    if leaf.path[0] != OWN:
        return leaf.name
    value = followed({OWN: constants}, leaf.path)
    assert isinstance(value, Code)
    return value.text


def array_at(memory: Any, path: tuple[str, ...]) -> Any:
    """Return an array of the memory."""
    for name in path:
        memory = getattr(memory, name)
    return memory


def beginnings(fields: tuple[Field, ...]) -> list[str]:
    """Return the lines that set what does not begin with nought."""
    write = {Scalar.REAL: real_literal, Scalar.INT: literal, Scalar.BOOL: literal}
    return [
        f"self->{field.name}[{k}] = {write[field.kind.element](value.item())};"
        for field in fields
        for k, value in enumerate(np.asarray(field.start).reshape(-1))
        if value.item()
    ]
