"""The header of Vicon's exports as CSV (Tracker, Nexus), five lines made one.

    Objects                                 or Segments
    100                                     frames a second
    ,,Platform:Platform,,,,,
    Frame,Sub Frame,RX,RY,RZ,TX,TY,TZ       or with RW after RZ
    ,,rad,rad,rad,mm,mm,mm

The names become 'Frame (100 Hz)' and 'Platform/RX (rad)'. Other blocks may stand before and after,
each parted by a blank line; all but rows become blank lines, so that these keep their places.
"""

import csv
from collections.abc import Iterator
from dataclasses import replace
from itertools import chain, islice, pairwise, takewhile

from equipoise.io.formats.header_line import PADDING, line_of, rate_of
from equipoise.io.formats.text_blocks import Text
from equipoise.model.errors import InputError

BLOCKS = ("Objects", "Segments")
MARK = "Sub Frame"
HEAD = 5  # lines
ANGLES = "Global Angle "  # before the names in some exports of Tracker


def with_vicon_header(text: Text, source: str) -> Text:
    """Return a text with one header line if it is Vicon's, else as it is.

    InputError where the block of bodies has no rows.
    """
    if not any(MARK in block for block in text.blocks()):
        return text
    first = _block(text.lines())
    if first is None:
        return text
    head = list(islice(text.lines(), first, first + HEAD + 1))
    if len(head) <= HEAD or not head[HEAD].strip(PADDING):
        wanted = "names of bodies, columns, units and rows of numbers"
        raise InputError(f"{source}, line {first + 1}", "a block that ends in its header", wanted)
    above = "\n" * (first + HEAD - 1) + _header(head[:HEAD]) + "\n"
    return replace(text, blocks=lambda: chain([above], _rows(text.blocks(), first + HEAD)))


def _rows(blocks: Iterator[str], above: int) -> Iterator[str]:
    """Yield the lines below some, up to the first that is blank, in blocks."""
    for block in blocks:
        lines = block.splitlines()
        rows = [*takewhile(lambda line: line.strip(PADDING), lines[above:])]
        yield "\n".join([*rows, ""])
        if len(rows) < len(lines[above:]):
            return
        above = max(above - len(lines), 0)


def _block(lines: Iterator[str]) -> int | None:
    """Return the place of the block of bodies: its kind, and its rate on the line below."""
    bare = pairwise(line.strip(PADDING) for line in lines)
    places = (i for i, (kind, rate) in enumerate(bare) if kind in BLOCKS and rate_of(rate))
    return next(places, None)


def _header(head: list[str]) -> str:
    """Return the five lines as one."""
    separator = next((s for s in ";\t" if s in head[3]), ",")
    bodies, labels, units = (next(csv.reader([line], delimiter=separator)) for line in head[2:])
    names = [f"Frame ({head[1].strip(PADDING)} Hz)", *labels[1:2]]
    body = ""
    for column, label in enumerate(labels[2:], 2):
        body = _cell(bodies, column) or body  # it stands above the first of its columns
        unit = _cell(units, column)
        names.append(f"{_name(body)}/{label.strip()}" + (f" ({unit})" if unit else ""))
    return line_of(names, separator)


def _name(body: str) -> str:
    """Return 'Platform' for 'Platform:Platform', a subject and its only segment."""
    subject, _, segment = body.removeprefix(ANGLES).partition(":")
    return subject if segment in ("", subject) else f"{subject}:{segment}"


def _cell(row: list[str], column: int) -> str:
    return row[column].strip() if column < len(row) else ""
