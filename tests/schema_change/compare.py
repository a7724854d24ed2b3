"""`python -m tests.schema_change.compare BEFORE AFTER [--rtol R]`: say how documents differ.

A document is flattened to its leaves by path. Leaves of the former document are taken to where
the table of changes puts them, and there compared: numbers by ==, unless a tolerance is given.
"""

import argparse
import math
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import accumulate
from pathlib import Path
from typing import Any, TypeGuard

from tests.schema_change.changes import Ignored, KeyPath, SchemaChange
from tests.schema_change.renames import CHANGE, IGNORED
from tests.schema_change.run import CONSOLE, Document, read

Leaf = str | float | bool | list[Any] | dict[str, Any] | None  # lists and records: empty ones


@dataclass(frozen=True, slots=True)
class Difference:
    """What is not as it was, and where."""

    case: str
    path: str
    what: str

    def __str__(self) -> str:
        return f"{self.case}: {self.path}: {self.what}"


@dataclass(frozen=True, slots=True)
class Expected:
    """A leaf as the former document leads to expect it.

    Attributes
    ----------
    value
        Its value, in the former unit.
    factor
        What the new number is to be multiplied by for the former unit.
    ignored
        Whether it need only be there.
    """

    value: Leaf
    factor: float = 1.0
    ignored: bool = False


@dataclass(frozen=True, slots=True)
class Comparison:
    """How documents are compared.

    Attributes
    ----------
    change
        What is declared to have changed.
    ignored
        Keys whose values are not compared.
    rtol
        Greatest relative difference of two numbers; 0: they are equal.
    """

    change: SchemaChange = CHANGE
    ignored: tuple[Ignored, ...] = IGNORED
    rtol: float = 0.0

    def differences(self, case: str, before: Document, after: Document) -> list[Difference]:
        """Return how a case's documents differ beyond what is declared."""
        wanted, found = self._expected(case, before), self._remaining(case, after)
        former = {
            path: f"lost, was {wanted[path].value!r}" for path in wanted.keys() - found.keys()
        }
        former |= {path: f"new, {found[path]!r}" for path in found.keys() - wanted.keys()}
        for path in wanted.keys() & found.keys():
            if not self._same(wanted[path], found[path]):
                former[path] = _changed(wanted[path], found[path])
        return [
            Difference(case, ".".join(path), former[path]) for path in sorted(former, key=_order)
        ]

    def _expected(self, case: str, before: Document) -> dict[KeyPath, Expected]:
        """Return the leaves of the former document, each where it is expected now."""
        kept = [
            (path, value)
            for path, value in leaves(before)
            if not any(rule.covers(case, path) for rule in self.change.removed)
        ]
        wanted = {self._moved(case, path): self._leaf(case, path, value) for path, value in kept}
        if len(wanted) < len(kept):
            raise ValueError(f"{case}: renames put several keys in one place")
        return wanted

    def _leaf(self, case: str, path: KeyPath, value: Leaf) -> Expected:
        """Return what is expected of one leaf."""
        ignored = any(rule.covers(case, path) for rule in self.ignored)
        return Expected(self._recoded(case, path, value), self._factor(case, path), ignored)

    def _remaining(self, case: str, after: Document) -> dict[KeyPath, Leaf]:
        """Return the leaves of the new document without those that are declared as added."""
        return {
            path: value
            for path, value in leaves(after)
            if not any(rule.covers(case, path) for rule in self.change.added)
        }

    def _moved(self, case: str, path: KeyPath) -> KeyPath:
        """Return where a leaf of the former document is in the new one."""
        above = accumulate((step,) for step in path)
        return tuple(step for node in above for step in self._steps(case, node))

    def _steps(self, case: str, node: KeyPath) -> KeyPath:
        """Return what stands now for the last step of a node's path."""
        names = (rule.new_name for rule in self.change.renamed if rule.holds(case, node))
        name = next(names, None)
        return node[-1:] if name is None else tuple(name.split("."))

    def _factor(self, case: str, path: KeyPath) -> float:
        """Return what a new number is to be multiplied by for the former unit."""
        rules = self.change.renamed
        return math.prod(rule.former_per_new for rule in rules if rule.covers(case, path))

    def _recoded(self, case: str, path: KeyPath, value: Leaf) -> Leaf:
        """Return the word that stands now for a former one, and any other value as it is."""
        if not isinstance(value, str):
            return value
        rules = (dict(rule.words) for rule in self.change.recoded if rule.covers(case, path))
        return next((words[value] for words in rules if value in words), value)

    def _same(self, wanted: Expected, found: Leaf) -> bool:
        """Say whether a leaf is as expected."""
        if wanted.ignored:
            return True
        if not (_is_number(wanted.value) and _is_number(found)):
            return type(wanted.value) is type(found) and wanted.value == found
        return math.isclose(wanted.value, found * wanted.factor, rel_tol=self.rtol, abs_tol=0.0)


def leaves(value: Any, path: KeyPath = ()) -> Iterator[tuple[KeyPath, Leaf]]:
    """Yield every leaf of a document with its path; a list or record of nothing is a leaf."""
    if not (isinstance(value, list | dict) and value):
        yield path, value
        return
    steps = enumerate(value) if isinstance(value, list) else value.items()
    for step, inner in steps:
        yield from leaves(inner, (*path, str(step)))


def _is_number(value: Leaf) -> TypeGuard[float]:
    """Say whether a leaf is a number; true and false are none."""
    return isinstance(value, int | float) and not isinstance(value, bool)


def _changed(wanted: Expected, found: Leaf) -> str:
    """Return in words how a leaf differs."""
    unit = "" if wanted.factor == 1 else f" (times {wanted.factor:g})"
    return f"was {wanted.value!r}, is {found!r}{unit}"


def _order(path: KeyPath) -> list[tuple[int, str]]:
    """Return what sorts paths by keys, and rows of a list by number."""
    return [(int(step) if step.isdecimal() else -1, step) for step in path]


def compared_folders(before: Path, after: Path, how: Comparison) -> Iterator[Difference]:
    """Yield differences of the documents in two folders; one that is missing is an error."""
    for path in sorted(before.glob("*.json")):
        yield from how.differences(path.stem, read(path), read(after / path.name))


def main(words: Sequence[str]) -> int:
    """Compare two folders and return 1 if anything differs."""
    parser = argparse.ArgumentParser(prog="python -m tests.schema_change.compare")
    parser.add_argument("before", type=Path, help="folder with the former documents")
    parser.add_argument("after", type=Path, help="folder with the new ones")
    parser.add_argument("--rtol", type=float, default=0.0, help="relative tolerance (0: equal)")
    options = parser.parse_args(words)
    found = list(compared_folders(options.before, options.after, Comparison(rtol=options.rtol)))
    for difference in found:
        CONSOLE.print(str(difference), markup=False)
    CONSOLE.print(f"{len(found)} differences")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
