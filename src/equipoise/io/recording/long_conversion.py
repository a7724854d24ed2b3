"""A long text table written in another format piece by piece, in memory that does not grow with it.

The text is cut once; its numbers go to the disk of the file that is written. What must be known of
the whole is found in a first pass over them (``piece_facts``); in a second each piece is set right
and written. The file is the same, to the last bit, as if the table were converted as a whole.
"""

from collections.abc import Callable, Iterator
from contextlib import closing
from dataclasses import replace
from pathlib import Path
from typing import Any, cast

import numpy as np

from equipoise.io.columns.column_map import ColumnMap
from equipoise.io.columns.column_store import Disk
from equipoise.io.columns.read_options import ReadOptions
from equipoise.io.columns.row_faults import without_faulty
from equipoise.io.columns.table import Table
from equipoise.io.columns.text_times import with_times_as_numbers
from equipoise.io.columns.unread_inputs import unread_inputs
from equipoise.io.files.atomic_file import whole_file
from equipoise.io.recording.attitude_columns import flip_note, unit_quaternions
from equipoise.io.recording.build_recording import check_count, names_of, sound_rows
from equipoise.io.recording.channels import Channel, Rows, read_channel
from equipoise.io.recording.format_registry import content_of, format_of, table_on_disk
from equipoise.io.recording.piece_clock import PieceClock, piece_clock
from equipoise.io.recording.piece_facts import ChannelFacts, Facts, facts_of
from equipoise.io.recording.piece_writers import WRITTEN, piece_writer
from equipoise.io.recording.recording_file import check_finite, columns_for
from equipoise.io.recording.rotation_columns import as_quaternions
from equipoise.model.arrays import Floats
from equipoise.model.recording import Recording, Samples

LONG = 64_000_000  # bytes of a text from which on it is converted in pieces (chosen)
PIECE = 1 << 16  # rows (chosen: as text they take 100 MB)
READ = 0.5  # share of the time in which a table is read (chosen)
TEXT = "csv"  # the format of all texts
OnProgress = Callable[[float], None]


def is_long(path: Path, out: Path, longest: int = LONG) -> bool:
    """Say whether a file is a long text, to be written in a format that grows by pieces."""
    grows = out.suffix.lower() in WRITTEN and (out.is_file() or not out.exists())
    if not grows or not path.is_file() or path.stat().st_size < longest:
        return False
    with content_of(path) as content:
        return format_of(path, content).name == TEXT


@np.errstate(invalid="ignore", over="ignore")  # an error names such a number and its row
def convert_in_pieces(
    path: Path, out: Path, options: ReadOptions, on_progress: OnProgress, size: int = PIECE
) -> Recording:
    """Write a long text table in the format of a suffix; return what is said of it, without rows.

    InputError says what cannot be used; the file is written whole or not at all.
    """
    with (
        content_of(path, options.max_memory) as content,
        whole_file(out) as temporary,
        closing(Disk(out.resolve().parent)) as disk,
    ):
        share: OnProgress = lambda done: on_progress(READ * done)  # noqa: E731
        table = table_on_disk(path, content, options, disk, share)
        columns = columns_for(table, None, options)
        table = with_times_as_numbers(table, columns)
        clock = piece_clock(table, columns, size)
        facts = facts_of(table, columns, clock, disk)
        faulty = (*table.faulty, *clock.faulty, *facts.faulty)
        left_out = without_faulty(table.source, len(table), faulty, options.bad_rows, table.place)
        check_count(table.source, facts.most(columns.native))
        pieces = _Pieces(table, columns, clock, facts)
        with closing(piece_writer(out.suffix.lower(), temporary, pieces.like())) as writer:
            for done, piece in enumerate(pieces.recordings(), 1):
                check_finite(piece, str(out))
                writer.add(piece)
                on_progress(READ + (1 - READ) * done / len(clock.pieces))
        notes = (*table.notes, *columns.notes, *left_out, *clock.notes, *pieces.notes())
        unread = unread_inputs(table, columns)
    return Recording(source=table.source, notes=notes, gaps=facts.gaps, unread=unread)


class _Pieces:
    """The recording in a table, piece by piece."""

    def __init__(self, table: Table, columns: ColumnMap, clock: PieceClock, facts: Facts) -> None:
        self._table, self._columns, self._clock, self._facts = table, columns, clock, facts
        self._there = [each for each in facts.channels if each.is_there(columns.native)]
        self._last: Floats | None = None  # attitude
        self._sign, self._flips = 1.0, 0

    def like(self) -> Recording:
        """Return a recording with the channels that there are, of one row each."""
        rows = {each.name: np.zeros((1, len(each.columns.names))) for each in self._there}
        rows = {name: np.eye(1, 4) if name == "attitude" else row for name, row in rows.items()}
        return self._recording({name: Samples(np.zeros(1), row) for name, row in rows.items()})

    def recordings(self) -> Iterator[Recording]:
        """Yield it."""
        for piece in self._clock.pieces:
            rows = self._clock.rows(self._table, self._columns, piece)
            rows = replace(rows, sentinels=self._facts.sentinels)
            found = {each.name: self._channel(each, rows) for each in self._there}
            yield self._recording(
                {name: each.samples() for name, each in found.items() if each is not None}
            )

    def notes(self) -> tuple[str, ...]:
        """Return what was set right of the channels, once all pieces are there."""
        facts = self._facts
        return (*facts.of_attitude, *flip_note(self._flips), *facts.of_others)

    def _recording(self, channels: dict[str, Samples]) -> Recording:
        given = cast("dict[str, Any]", channels) | names_of(self._columns, channels)
        return Recording(**given, source=self._table.source)

    def _channel(self, facts: ChannelFacts, source: Rows) -> Channel | None:
        channel, _ = read_channel(source, facts.name, facts.columns)
        if len(channel):
            channel = sound_rows(channel, source, facts.columns).channel
        if not len(channel):
            return None
        return self._attitude(channel, facts, source) if facts.name == "attitude" else channel

    def _attitude(self, channel: Channel, facts: ChannelFacts, source: Rows) -> Channel:
        """Return an attitude set right, with the sign that goes on from the piece before."""
        flips = 0
        if facts.columns is self._columns.quaternion:
            mended, flips = unit_quaternions(channel, self._columns, facts.off)
        else:
            mended, _ = as_quaternions(channel, source.table, self._columns)
        sign = self._sign_after(mended.values[0])
        if facts.columns is self._columns.quaternion:  # others' signs come of the conversion
            self._flips += flips + (sign != self._sign)
        q = -mended.values if sign < 0 else mended.values
        self._last, self._sign = q[-1], sign * (-1.0) ** flips
        return replace(mended, values=q)

    def _sign_after(self, q: Floats) -> float:
        """Return the sign with which an attitude goes on from the last one."""
        along = 0.0 if self._last is None else float(np.einsum("i,i->", q, self._last))
        return float(np.sign(along)) or self._sign
