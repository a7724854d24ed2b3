"""Expressions of Python as expressions of C: calls, and what they are made of.

What has no counterpart raises NotTranslatable with the line.
"""

import ast
import math
from collections.abc import Mapping
from typing import Any

from equipoise.onboard.translation.operations import Operations
from equipoise.onboard.translation.unit import NotTranslatable
from equipoise.onboard.translation.values import (
    Code,
    Host,
    Known,
    Record,
    Scalar,
    Value,
    source_function,
    type_of,
)

WHOLE = {math.ceil, math.floor}  # give an int in Python
FUNCTIONS: Mapping[Any, str] = {
    math.sin: "eq_sin", math.cos: "eq_cos", math.atan2: "eq_atan2", math.sqrt: "eq_sqrt",
    math.exp: "eq_exp", math.ceil: "eq_ceil", math.floor: "eq_floor",
}  # fmt: skip


class Expressions(Operations):
    """Writes the expressions of one function."""

    def of_call(self, node: ast.Call) -> Value:
        """Return what a call gives."""
        target = self.value(node.func)
        if not isinstance(target, Host):
            raise NotTranslatable(node, ast.unparse(node))
        arguments = [self.value(each) for each in node.args]
        named = {str(each.arg): self.value(each.value) for each in node.keywords}
        return self.called(target.thing, arguments, named, node)

    def called(
        self, thing: Any, arguments: list[Value], named: dict[str, Value], node: ast.Call
    ) -> Value:
        """Return what a call of a thing of Python gives."""
        if hasattr(thing, "_fields"):
            fields = dict(zip(thing._fields, arguments, strict=False)) | named
            return Record(thing, fields)
        if thing in (min, max):
            return self.extreme("<" if thing is min else ">", arguments)
        if thing is abs:
            return Code(Scalar.REAL, f"eq_fabs({self.real(arguments[0])})")
        if thing in (int, float, bool):
            return self.converted(thing, arguments[0])
        if thing in FUNCTIONS:
            text = f"{FUNCTIONS[thing]}({', '.join(map(self.real, arguments))})"
            return Code(Scalar.INT, f"((int){text})") if thing in WHOLE else Code(Scalar.REAL, text)
        function = source_function(thing)
        if function is None:
            raise NotTranslatable(node, ast.unparse(node))
        return self.unit.call(self, function, arguments, named)

    def converted(self, thing: type, value: Value) -> Value:
        """Return a number of another kind."""
        if isinstance(value, Known):
            return Known(thing(value.value))
        kind = {int: Scalar.INT, float: Scalar.REAL, bool: Scalar.BOOL}[thing]
        if kind is Scalar.REAL:
            return Code(kind, self.real(value))
        return Code(kind, f"(({kind.value}){self.as_type(value, type_of(value))})")
