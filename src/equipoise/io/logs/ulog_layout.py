"""The layout of a topic of PX4's logs, as columns in the order of their bytes.

    "type field;type[n] field;..."      types may be layouts

Layouts stand within layouts, so a few bytes may declare more columns than there are atoms: they are
made one by one, and no more of them than any log has.
"""

import functools
from collections.abc import Iterator, Mapping
from itertools import islice

TYPES = {
    "int8_t": "<i1", "uint8_t": "<u1", "int16_t": "<i2", "uint16_t": "<u2", "int32_t": "<i4",
    "uint32_t": "<u4", "int64_t": "<i8", "uint64_t": "<u8", "float": "<f4", "double": "<f8",
    "bool": "<u1", "char": "<u1",
}  # fmt: skip
DEEPEST = 4  # layouts within layouts; chosen: PX4 has two
MOST = 4096  # columns of a topic; chosen: PX4 has some hundreds
LONGEST = 200  # letters of a name; chosen: PX4's are below 40
Column = tuple[str, str]  # name, type of NumPy


class _Senseless(Exception):
    """A layout that makes no sense."""


def flat_layout(layouts: Mapping[str, str], topic: str) -> tuple[Column, ...]:
    """Return a topic's columns; none if its layout makes no sense."""
    try:
        found = tuple(islice(_columns(layouts, topic, DEEPEST), MOST + 1))
    except _Senseless:
        return ()
    return found if len(found) <= MOST else ()


def _columns(layouts: Mapping[str, str], topic: str, deep: int) -> Iterator[Column]:
    parts = _parts(layouts.get(topic, ""))
    if not parts or not deep:
        raise _Senseless
    for kind, name in parts:
        yield from _field(layouts, kind, name, deep)


@functools.lru_cache(maxsize=64)
def _parts(layout: str) -> tuple[tuple[str, str], ...]:
    """Return types and names of fields, without what may be left out at the end."""
    parts = [part.split(" ") for part in layout.split(";") if part]
    while parts and parts[-1][-1].startswith("_padding"):
        parts.pop()
    if any(len(part) != 2 or len(part[1]) > LONGEST for part in parts):
        raise _Senseless
    return tuple((part[0], part[1]) for part in parts)


def _field(layouts: Mapping[str, str], kind: str, name: str, deep: int) -> Iterator[Column]:
    """Yield the columns of one field, which may be an array or a layout."""
    base, bracket, rest = kind.partition("[")
    count = rest.removesuffix("]")
    if bracket and not (len(count) < 6 and count.isdecimal() and 0 < int(count) < 1 << 16):
        raise _Senseless
    for each in (f"{name}[{k}]" for k in range(int(count))) if bracket else (name,):
        if base in TYPES:
            yield each, TYPES[base]
        else:
            for part, type_ in _columns(layouts, base, deep - 1):
                yield f"{each}.{part}", type_
