"""Lines that say before each number what it is, ``t:0.01 qw:1.0`` or ``t=0.01, qw=1.0``.

So programs of small boards print for a plotter. They become rows below a header of the names. A
line that is none, or lacks a name, becomes a row with cells too few.
"""

import re
from collections import Counter

NAME = r"[A-Za-z_][\w./]*(?:\[\w+\])?"
PAIR = re.compile(rf"\s*({NAME})\s*[:=]\s*([^\s,;:=|]+)\s*[,;|]?")
NOTHING: frozenset[str] = frozenset()
NOTE = "Each number has its name before it; the names were taken as the header."


def labels_of(lines: list[str], first: int) -> tuple[str, ...]:
    """Return the names in labelled lines; none unless most of the ``first`` are such, alike."""
    some = [line for line in lines if line.strip()][:first]
    found = [tuple(each) for each in map(pairs_of, some) if each]
    usual, often = next(iter(Counter(map(frozenset, found)).most_common(1)), (NOTHING, 0))
    if len(usual) < 2 or 2 * often <= len(some):
        return ()
    return next(each for each in found if usual == frozenset(each))


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


def row_of(line: str, names: tuple[str, ...]) -> list[str]:
    """Return the cells of a line, in the order of the names; of any other line the line itself."""
    cells = pairs_of(line)
    return [cells[name] for name in names if name in cells] if {*cells} <= {*names} else [line]
