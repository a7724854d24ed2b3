"""The header of QTM's exports as TSV (Qualisys), made one line.

    NO_OF_FRAMES 2000
    FREQUENCY 100                           frames a second
    BODY_NAMES Platform
    Frame Time Platform X Y Z Roll Pitch Yaw Residual Rot[0] ... Rot[8]

Cells are parted by tabs, 'Platform X' is one; lines of other keys may stand between. The last line
may lack, or Frame and Time in it. The names become 'Frame (100 Hz)', 'Time', 'Platform/Rot[0]';
what stands above becomes blank lines, so that rows keep their places.
"""

import itertools
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

from equipoise.io.formats.header_line import line_of, rate_of
from equipoise.io.formats.text_blocks import Text
from equipoise.model.errors import InputError

MARK = "NO_OF_FRAMES\t"
COUNT = ("Frame", "Time")
OF_BODY = ("X", "Y", "Z", "Roll", "Pitch", "Yaw", "Residual", *(f"Rot[{i}]" for i in range(9)))


@dataclass(frozen=True, slots=True)
class Export:
    """An export's header, and its rows."""

    rate: str  # Hz
    bodies: tuple[str, ...]
    titles: tuple[str, ...]  # of its columns, as far as a line gives them
    above: int  # lines before the rows
    rows: list[str]


def with_qualisys_header(text: Text, source: str) -> Text:
    """Return a text with one header line if it is QTM's, else as it is.

    InputError where the header lacks what explains the columns.
    """
    lines = text.first_lines()
    if not lines or not lines[0].startswith(MARK):
        return text
    export = _export(lines, source)
    count = _count(export, source)
    frames = f" ({export.rate} Hz)"
    names = [f"Frame{frames}" if each == "Frame" else each for each in count]
    names += [f"{body}/{column}" for body in export.bodies for column in OF_BODY]
    if not count:
        names = [f"Row{frames}", *names]
    above = "\n" * (export.above - 1) + line_of(names, "\t") + "\n"
    rows = _rows(text, export.above, numbered=not count)
    return replace(text, blocks=lambda: itertools.chain([above], rows()))


def _rows(text: Text, above: int, numbered: bool) -> Callable[[], Iterator[str]]:
    """Return the lines below some, in blocks, perhaps each with its number before it."""

    def blocks() -> Iterator[str]:
        before, frames = above, itertools.count()
        for block in text.blocks():
            lines = block.splitlines()
            rows = lines[before:]
            before = max(before - len(lines), 0)
            if numbered:
                rows = [f"{next(frames)}\t{row}" for row in rows]
            yield "\n".join([*rows, ""])

    return blocks


def _export(lines: list[str], source: str) -> Export:
    keyed = {line.split("\t")[0]: place for place, line in enumerate(lines) if line[:1].isalpha()}
    lacking = [key for key in ("FREQUENCY", "BODY_NAMES") if key not in keyed]
    if lacking:
        wanted = "an export of 6DOF data as TSV, with its header"
        raise InputError(f"{source}, header", f"no {' and no '.join(lacking)}", wanted)
    rate, *bodies = (
        name.strip()
        for key in ("FREQUENCY", "BODY_NAMES")
        for name in lines[keyed[key]].split("\t")[1:]
        if name.strip()
    )
    if rate_of(rate) is None:
        raise InputError(f"{source}, line {keyed['FREQUENCY'] + 1}", f"'{rate}'", "a rate in Hz")
    above = keyed["BODY_NAMES"] + 1
    titles = tuple(lines[above].rstrip("\t").split("\t")) if above < len(lines) else ()
    if not any("Rot[0]" in title for title in titles):
        return Export(rate, tuple(bodies), (), above, lines[above:])
    return Export(rate, tuple(bodies), titles, above + 1, lines[above + 1 :])


def _count(export: Export, source: str) -> tuple[str, ...]:
    """Return which of 'Frame' and 'Time' stand before the bodies; InputError if more does."""
    width = max((len(row.rstrip("\t").split("\t")) for row in export.rows), default=0)
    before = (len(export.titles) or width) - len(OF_BODY) * len(export.bodies)
    count = export.titles[: max(before, 0)] if export.titles else COUNT[: max(before, 0)]
    plain = export.titles or before in (0, len(COUNT))  # one without a title could be either
    if before == len(count) and set(count) <= {*COUNT} and plain:
        return count
    found = f"{len(export.titles) or width} columns for {len(export.bodies)} bodies"
    wanted = f"Frame and Time, then {' '.join(OF_BODY[:-8])} to Rot[8] for each body"
    raise InputError(f"{source}, header", found, wanted)
