"""Lines that say before each number what it is, ``t:0.01 qw:1.0`` or ``t=0.01, qw=1.0``.

So programs of small boards print for a plotter. They become rows below a header of the names.
"""

import re
from collections import Counter
from dataclasses import dataclass

NAME = r"[A-Za-z_][\w./]*(?:\[\w+\])?"
PAIR = re.compile(rf"\s*({NAME})\s*[:=]\s*([^\s,;:=|]+)\s*[,;|]?")
NOTHING: frozenset[str] = frozenset()
NOTE = "Each number has its name before it; the names were taken as the header."


@dataclass(frozen=True, slots=True)
class Labelled:
    """Rows of cells below the names, and the lines that they stand on."""

    rows: list[list[str]]
    lines: list[int]


def labelled(lines: list[str], first: int) -> Labelled | None:
    """Return the rows of labelled lines; None unless most of the ``first`` lines are such, alike.

    A line that is none, or lacks a name, becomes a row with cells too few.
    """
    some = [line for line in lines if line.strip()][:first]
    found = [tuple(each) for each in map(pairs_of, some) if each]
    usual, often = next(iter(Counter(map(frozenset, found)).most_common(1)), (NOTHING, 0))
    if len(usual) < 2 or 2 * often <= len(some):
        return None
    names = next(each for each in found if usual == frozenset(each))
    numbered = [(k, line) for k, line in enumerate(lines, 1) if line.strip()]
    rows = [_row(line, names) for _, line in numbered]
    places = [k for k, _ in numbered]
    head = next(k for k, row in enumerate(rows) if len(row) == len(names))
    rows.insert(head, list(names))
    return Labelled(rows, [*places[:head], *places[head:][:1], *places[head:]])


def pairs_of(line: str) -> dict[str, str]:
    """Return the names and cells of a line; nothing if it has another part, or a name twice."""
    found: dict[str, str] = {}
    at = 0
    while pair := PAIR.match(line, at):
        if pair[1] in found:
            return {}
        found[pair[1]] = pair[2]
        at = pair.end()
    return {} if line[at:].strip() else found


def _row(line: str, names: tuple[str, ...]) -> list[str]:
    cells = pairs_of(line)
    return [cells[name] for name in names if name in cells] if {*cells} <= {*names} else [line]
