"""What may be declared about documents: keys renamed, added and removed, units, codes, prose.

A path is the keys and list indices from the root, joined by dots: ``steps.3.verdict.com_um.0``. In
a pattern, ``*`` stands for one step or a part of it and ``**`` for any number of steps, none
included. A pattern that meets a node holds for all below it.
"""

import re
from dataclasses import dataclass
from fnmatch import fnmatchcase
from functools import cache
from itertools import accumulate

KeyPath = tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Declared:
    """Where a declaration holds.

    Attributes
    ----------
    case
        Pattern of the cases' names.
    path
        Pattern of the paths: of the former document, unless it is said otherwise.
    """

    case: str
    path: str

    def holds(self, case: str, path: KeyPath) -> bool:
        """Say whether it holds for this node of a case's document."""
        return fnmatchcase(case, self.case) and meets(self.path, path)

    def covers(self, case: str, path: KeyPath) -> bool:
        """Say whether it holds for this node or for one above it."""
        return any(self.holds(case, above) for above in accumulate((step,) for step in path))


@dataclass(frozen=True, slots=True)
class Rename(Declared):
    """A key that bears another name, and all numbers below it another unit, perhaps.

    Attributes
    ----------
    new_name
        The new key; with dots in it, a path below the old key's place.
    former_per_new
        The former number is the new one times this, such as 1e6 where um became m. The factor is
        this way round since the former code multiplied so: the numbers must be equal to the bit.
    """

    new_name: str
    former_per_new: float = 1.0


@dataclass(frozen=True, slots=True)
class Added(Declared):
    """A key that only the new document has; its path is one of the new document."""


@dataclass(frozen=True, slots=True)
class Removed(Declared):
    """A key that only the former document has."""


@dataclass(frozen=True, slots=True)
class Recoded(Declared):
    """Words of a fixed vocabulary that became others, such as the schema's name.

    Attributes
    ----------
    words
        Pairs of a former word and the new one.
    """

    words: tuple[tuple[str, str], ...]


@dataclass(frozen=True, slots=True)
class Ignored(Declared):
    """A key that must be there on both sides, while its value may differ.

    Attributes
    ----------
    reason
        Why the values cannot be compared.
    """

    reason: str


@dataclass(frozen=True, slots=True)
class SchemaChange:
    """All that is declared to have changed from the former documents to the new ones."""

    renamed: tuple[Rename, ...] = ()
    added: tuple[Added, ...] = ()
    removed: tuple[Removed, ...] = ()
    recoded: tuple[Recoded, ...] = ()


@cache
def meets(pattern: str, path: KeyPath) -> bool:
    """Say whether a path is one of those that a pattern stands for."""
    return _compiled(pattern).fullmatch("".join(f"{step}." for step in path)) is not None


@cache
def _compiled(pattern: str) -> re.Pattern[str]:
    """Return the pattern as a regular expression of steps, each with a dot after it."""
    return re.compile("".join(map(_of_step, pattern.split("."))))


def _of_step(step: str) -> str:
    """Return the regular expression of one step of a pattern."""
    if step == "**":
        return r"(?:[^.]*\.)*"
    return "[^.]*".join(map(re.escape, step.split("*"))) + r"\."
