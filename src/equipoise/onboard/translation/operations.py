"""Operations of Python as operations of C, in the same order.

Every operation stands in its own parentheses, so that C adds and multiplies in the order in which
Python does; an operation between two numbers that do not change is carried out here, in double
precision.
"""

import ast
from collections.abc import Callable
from typing import Any

from equipoise.onboard.translation.elements import Elements, as_text
from equipoise.onboard.translation.values import (
    ArrayType,
    Code,
    Known,
    Scalar,
    Value,
    common_type,
    type_of,
    widened,
)

ARITHMETIC: dict[type[ast.operator], tuple[str, Callable[[Any, Any], Any]]] = {
    ast.Add: ("+", lambda a, b: a + b),
    ast.Sub: ("-", lambda a, b: a - b),
    ast.Mult: ("*", lambda a, b: a * b),
    ast.Div: ("/", lambda a, b: a / b),
    ast.FloorDiv: ("//", lambda a, b: a // b),
    ast.Mod: ("%", lambda a, b: a % b),
    ast.Pow: ("**", lambda a, b: a**b),
}
COMPARISONS: dict[type[ast.cmpop], tuple[str, Callable[[Any, Any], bool]]] = {
    ast.Lt: ("<", lambda a, b: a < b),
    ast.LtE: ("<=", lambda a, b: a <= b),
    ast.Gt: (">", lambda a, b: a > b),
    ast.GtE: (">=", lambda a, b: a >= b),
    ast.Eq: ("==", lambda a, b: a == b),
    ast.NotEq: ("!=", lambda a, b: a != b),
}


class Operations(Elements):
    """Writes the operations of one function."""

    def of_binop(self, node: ast.BinOp) -> Value:
        """Return the result of an operation."""
        return self.combined(node.op, self.value(node.left), self.value(node.right))

    def combined(self, operator: ast.operator, left: Value, right: Value) -> Value:
        """Return the result of an operation on two numbers."""
        sign, function = ARITHMETIC[type(operator)]
        if isinstance(left, Known) and isinstance(right, Known):
            return Known(function(left.value, right.value))
        whole = all(widened(type_of(each)) is Scalar.INT for each in (left, right))
        if sign == "**":
            return Code(Scalar.REAL, f"eq_pow({self.real(left)}, {self.real(right)})")
        if whole and sign != "/":
            name = {"//": "/"}.get(sign, sign)  # of numbers that are not negative
            return Code(Scalar.INT, f"({self.integer(left)} {name} {self.integer(right)})")
        return Code(Scalar.REAL, f"({self.real(left)} {sign} {self.real(right)})")

    def of_unaryop(self, node: ast.UnaryOp) -> Value:
        """Return the negative or the opposite."""
        value = self.value(node.operand)
        if isinstance(node.op, ast.Not):
            found = self.truth(value)
            return Known(not found) if isinstance(found, bool) else Code(Scalar.BOOL, f"(!{found})")
        if isinstance(value, Known):
            return Known(-value.value)
        kind = type_of(value)
        text = self.integer(value) if kind is Scalar.INT else self.real(value)
        return Code(kind, f"(-{text})")

    def of_compare(self, node: ast.Compare) -> Value:
        """Return the result of a comparison; chains are taken pair by pair."""
        values, found = [self.value(each) for each in (node.left, *node.comparators)], list[Value]()
        for operator, left, right in zip(node.ops, values, values[1:], strict=False):
            found.append(self.compared(operator, left, right, node))
        return found[0] if len(found) == 1 else self.joined("&&", found)

    def compared(self, operator: ast.cmpop, left: Value, right: Value, node: ast.expr) -> Value:
        """Return the result of one comparison."""
        if isinstance(operator, (ast.Is, ast.IsNot)):
            same = self.known(left, node) is self.known(right, node)
            return Known(same == isinstance(operator, ast.Is))
        if isinstance(operator, (ast.In, ast.NotIn)):
            choices = self.known(right, node)
            equal = [self.compared(ast.Eq(), left, Known(each), node) for each in choices]
            inside = self.joined("||", equal)
            return inside if isinstance(operator, ast.In) else self.opposite(inside)
        sign, function = COMPARISONS[type(operator)]
        if isinstance(left, Known) and isinstance(right, Known):
            return Known(function(left.value, right.value))
        whole = all(widened(type_of(each)) is not Scalar.REAL for each in (left, right))
        a, b = map(self.integer if whole else self.real, (left, right))
        return Code(Scalar.BOOL, f"({a} {sign} {b})")

    def opposite(self, value: Value) -> Value:
        """Return the opposite of a truth value."""
        found = self.truth(value)
        return Known(not found) if isinstance(found, bool) else Code(Scalar.BOOL, f"(!{found})")

    def of_boolop(self, node: ast.BoolOp) -> Value:
        """Return whether all, or any, of some hold; what is decided by a known one ends there."""
        sign, found, ends = "&&", list[Value](), False
        if isinstance(node.op, ast.Or):
            sign, ends = "||", True
        for each in node.values:
            value = self.value(each)
            truth = self.truth(value)
            if truth is ends:
                return Known(ends) if not found else self.joined(sign, [*found, value])
            if not isinstance(truth, bool):
                found.append(value)
        return self.joined(sign, found) if found else Known(not ends)

    def joined(self, sign: str, values: list[Value]) -> Value:
        """Return several truth values joined by && or ||."""
        if all(isinstance(each, Known) for each in values):
            reduce = all if sign == "&&" else any
            return Known(reduce(each.value for each in values if isinstance(each, Known)))
        texts = [as_text(self.truth(each)) for each in values]
        return Code(Scalar.BOOL, f"({f' {sign} '.join(texts)})")

    def of_ifexp(self, node: ast.IfExp) -> Value:
        """Return one of two values."""
        truth = self.truth(self.value(node.test))
        if isinstance(truth, bool):
            return self.value(node.body if truth else node.orelse)
        first, other = self.value(node.body), self.value(node.orelse)
        kind = common_type(type_of(first), type_of(other))
        text = f"({truth} ? {self.as_type(first, kind)} : {self.as_type(other, kind)})"
        if isinstance(kind, ArrayType):
            return self.chosen(kind, text, first, other)
        return Code(kind, text)

    def chosen(self, kind: ArrayType, text: str, *either: Value) -> Code:
        """Return one of two arrays: who writes it may write both."""
        roots = [each.root for each in either if isinstance(each, Code) and each.root]
        self.unit.share(self, roots)
        return Code(kind, text, roots[0] if roots else None)

    def extreme(self, sign: str, values: list[Value]) -> Value:
        """Return the least or the greatest, the first of equals, as Python has it."""
        best = values[0]
        for each in values[1:]:
            if isinstance(best, Known) and isinstance(each, Known):
                best = Known((min if sign == "<" else max)(best.value, each.value))
                continue
            whole = all(widened(type_of(v)) is Scalar.INT for v in (best, each))
            kind = Scalar.INT if whole else Scalar.REAL
            a, b = self.as_type(best, kind), self.as_type(each, kind)
            best = Code(kind, f"({b} {sign} {a} ? {b} : {a})")
        return best
