"""Statements of Python as statements of C; a branch excluded by what is known is not written."""

import ast

from equipoise.onboard.translation.elements import as_text
from equipoise.onboard.translation.storing import Storing, as_read, plain
from equipoise.onboard.translation.unit import (
    NOTHING,
    NotTranslatable,
    c_name,
)
from equipoise.onboard.translation.values import (
    Code,
    Known,
    RecordType,
    Scalar,
    type_of,
    widened,
)


class Statements(Storing):
    """Writes the statements of one function."""

    def body(self, nodes: list[ast.stmt]) -> bool:
        """Write statements; say whether none after them is reached."""
        for node in nodes:
            handler = getattr(self, f"write_{type(node).__name__.lower()}", None)
            if handler is None:
                raise NotTranslatable(node, ast.unparse(node))
            if handler(node):
                return True
        return False

    def write_pass(self, node: ast.Pass) -> None:
        """Write nothing."""

    def write_assert(self, node: ast.Assert) -> None:
        """Write nothing: Python has checked it."""

    def write_expr(self, node: ast.Expr) -> None:
        """Write a call; a docstring is not one."""
        if isinstance(node.value, ast.Call):
            value = self.value(node.value)
            assert isinstance(value, Code)
            self.put(f"{value.text};" if value.type == NOTHING else f"(void){value.text};")

    def write_return(self, node: ast.Return) -> bool:
        """Write the end."""
        if node.value is None:
            self.put("return;")
            return True
        value = self.value(node.value)
        kind = type_of(value)
        kind = kind if isinstance(kind, RecordType) else widened(kind)
        self.returns = self.returns or kind
        self.put(f"return {self.as_type(value, self.returns)};")
        return True

    def write_if(self, node: ast.If) -> bool:
        """Write a branch, or the one branch that is reached."""
        truth = self.truth(self.value(node.test))
        if isinstance(truth, bool):
            return self.body(node.body if truth else node.orelse)
        self.put(f"if ({truth.removeprefix('(').removesuffix(')') if plain(truth) else truth}) {{")
        ended = self.block(node.body)
        if node.orelse:
            self.put("} else {")
            ended = self.block(node.orelse) and ended
        self.put("}")
        return bool(node.orelse) and ended

    def block(self, nodes: list[ast.stmt]) -> bool:
        """Write statements one level deeper."""
        self.depth += 1
        ended = self.body(nodes)
        self.depth -= 1
        return ended

    def write_for(self, node: ast.For) -> None:
        """Write a loop over a range."""
        if not (isinstance(node.iter, ast.Call) and isinstance(node.target, ast.Name)):
            raise NotTranslatable(node, ast.unparse(node.iter))
        bounds = [self.value(each) for each in node.iter.args]
        first, last = (Known(0), bounds[0]) if len(bounds) == 1 else (bounds[0], bounds[1])
        name = c_name(node.target.id)
        a, b = self.integer(first), self.integer(last)
        self.put(f"for (int {name} = {a}; {name} < {b}; {name}++) {{")
        self.names[node.target.id] = Code(Scalar.INT, name)
        self.block(node.body)
        self.put("}")

    def write_while(self, node: ast.While) -> None:
        """Write a loop."""
        truth = self.truth(self.value(node.test))
        self.put(f"while ({as_text(truth)}) {{")
        self.block(node.body)
        self.put("}")

    def write_augassign(self, node: ast.AugAssign) -> None:
        """Write a change of a variable or of an element."""
        self.store(node.target, self.combined(node.op, self.value(as_read(node.target)),
                                              self.value(node.value)))  # fmt: skip

    def write_annassign(self, node: ast.AnnAssign) -> None:
        """Write an assignment with a type that the reader needs."""
        assert node.value is not None
        self.store(node.target, self.value(node.value))

    def write_assign(self, node: ast.Assign) -> None:
        """Write an assignment to one target or several."""
        value = self.value(node.value)
        if len(node.targets) > 1 and isinstance(value, Code):
            value = self.kept(value)
        for target in node.targets:
            self.store(target, value)
