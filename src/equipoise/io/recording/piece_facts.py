"""What must be known of a whole table before its pieces can be set right one by one.

of a column     the number that stands for no reading; whether it is zero in every row
of a channel    its faulty rows, its gaps, how far quaternions are off unit length
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace

import numpy as np

from equipoise.io.columns.column_map import ColumnMap, Columns
from equipoise.io.columns.column_store import Disk, OnDisk
from equipoise.io.columns.row_faults import FaultyRows, RowFault
from equipoise.io.columns.sentinels import Largest, largest_of
from equipoise.io.columns.table import Table, no_rows
from equipoise.io.recording.attitude_columns import (
    WORTH_SAYING,
    Norms,
    is_off,
    lengths_of,
    norm_note,
    wrap_note,
    wraps_in,
)
from equipoise.io.recording.build_recording import dead_note, sound_rows
from equipoise.io.recording.channels import (
    Channel,
    Rows,
    columns_of,
    may_have_sentinels,
    read_channel,
)
from equipoise.io.recording.piece_clock import PieceClock, ranges
from equipoise.io.recording.rotation_columns import blank_note
from equipoise.io.recording.streamed_ranks import streamed_median, streamed_quantile
from equipoise.io.recording.time_stamps import GAP, gap_note
from equipoise.model.arrays import Floats, Ints, Series1
from equipoise.model.recording import CHANNELS

Notes = tuple[str, ...]
TIMES, NORMS, ROWS = 0, 1, 2  # columns of what is kept of a channel
PART = 1 << 16  # rows that are looked at together (chosen)
SENSED = ("attitude", "rate")  # channels whose gaps are named


class Faults:
    """Faulty rows of one channel, piece after piece: of each kind the first is reported."""

    def __init__(self) -> None:
        self._first: dict[RowFault, FaultyRows] = {}
        self._rows: dict[RowFault, list[Ints]] = {}

    def add(self, faulty: Iterable[FaultyRows], begin: int) -> None:
        """Add those of a piece that begins at a row."""
        for each in faulty:
            self._first.setdefault(each.fault, each)
            self._rows.setdefault(each.fault, []).append(each.rows + begin)

    def all(self) -> tuple[FaultyRows, ...]:
        """Return them, by rows of the table."""
        return tuple(
            replace(each, rows=np.concatenate(self._rows[kind]))
            for kind, each in self._first.items()
        )


@dataclass(slots=True, eq=False)
class ChannelFacts:
    """What is known of a channel."""

    name: str
    columns: Columns
    zero: Floats  # of each column: 0 while it is zero in every row
    read: int = 0  # rows with a reading
    count: int = 0  # rows that can be used
    faulty: Faults = field(default_factory=Faults)
    unsound: Faults = field(default_factory=Faults)
    blank: list[Ints] = field(default_factory=list[Ints])  # rows of matrices of zeros
    store: OnDisk | None = None  # of what is kept of its rows
    off: bool = False  # quaternions that are not of unit length to the last digit
    wraps: int = 0
    last: Floats | None = None  # angles

    def dead(self, native: bool) -> tuple[bool, Notes]:
        """Say whether nothing was connected."""
        if not self.read:
            return False, ()
        return dead_note(self.name, self.zero == 0, self.columns, native)

    def is_there(self, native: bool) -> bool:
        """Say whether the recording has the channel."""
        return bool(self.count) and not self.dead(native)[0]


@dataclass(frozen=True, slots=True, eq=False)
class Facts:
    """What is known of a table."""

    channels: tuple[ChannelFacts, ...]
    sentinels: dict[str, float | None]
    of_attitude: Notes  # but for the signs of its quaternions
    of_others: Notes  # on the other channels
    gaps: Notes
    faulty: tuple[FaultyRows, ...]

    def most(self, native: bool) -> int:
        """Return how many rows the longest of attitude and rate has."""
        sensed = (each for each in self.channels if each.name in SENSED and each.is_there(native))
        return max((each.count for each in sensed), default=0)


def sentinels_of(table: Table, columns: ColumnMap, size: int) -> dict[str, float | None]:
    """Return the number of each column that stands for no reading."""
    names = [
        name
        for channel in CHANNELS
        if may_have_sentinels(channel, columns)
        and (group := columns_of(columns, channel)) is not None
        for name in group.names
        if name in table.names
    ]
    found = dict.fromkeys(names, Largest())
    for piece in ranges(len(table), size):
        part = table.part(*piece)
        for name in found:
            found[name] = found[name].joined(largest_of(part.numbers(name).values))
    return {name: each.sentinel for name, each in found.items()}


def facts_of(table: Table, columns: ColumnMap, clock: PieceClock, disk: Disk) -> Facts:
    """Return what is known of a table; what is kept of its rows goes to a disk."""
    sentinels = sentinels_of(table, columns, max(end - begin for begin, end in clock.pieces))
    groups = [(name, group) for name in CHANNELS if (group := columns_of(columns, name))]
    found = [
        ChannelFacts(
            name,
            group,
            np.zeros(len(group.names)),
            store=disk.store() if name in SENSED else None,
        )
        for name, group in groups
    ]
    for piece in clock.pieces:
        rows = replace(clock.rows(table, columns, piece), sentinels=sentinels)
        for each in found:
            _add(each, rows, piece[0])
    native = columns.native
    attitude, others = (
        tuple(
            n for e in found if (e.name == "attitude") == which for n in _notes(e, table, columns)
        )
        for which in (True, False)
    )
    gaps = tuple(note for each in found if each.is_there(native) for note in _gaps(each))
    faulty = [f for e in found for f in (*e.faulty.all(), *_unsound(e, native))]
    return Facts(tuple(found), sentinels, attitude, others, gaps, tuple(faulty))


def _unsound(facts: ChannelFacts, native: bool) -> tuple[FaultyRows, ...]:
    return () if facts.dead(native)[0] else facts.unsound.all()


def _add(facts: ChannelFacts, source: Rows, begin: int) -> None:
    """Add what a piece shows of a channel."""
    channel, faulty = read_channel(source, facts.name, facts.columns)
    facts.faulty.add(faulty, begin)
    facts.read += len(channel)
    if not len(channel):
        return
    facts.zero += np.logical_or.reduce(channel.values != 0, axis=0)
    sound = sound_rows(channel, source, facts.columns)
    facts.unsound.add(sound.faulty, begin)
    facts.blank.append(sound.blank + begin)
    if facts.store is not None and len(sound.channel):
        _keep(facts, sound.channel, source.columns, begin)
    facts.count += len(sound.channel)


def _keep(facts: ChannelFacts, channel: Channel, columns: ColumnMap, begin: int) -> None:
    store = facts.store
    assert store is not None  # the caller has looked
    store.add(TIMES, facts.count, channel.t)
    if facts.columns is columns.quaternion:
        norm = lengths_of(channel.values)
        store.add(NORMS, facts.count, norm)
        store.add(ROWS, facts.count, (channel.rows + begin).astype(float))
        facts.off |= is_off(norm)
    elif columns.euler is not None and facts.columns is columns.euler.columns:
        angles = channel.values if facts.last is None else np.vstack([facts.last, channel.values])
        facts.wraps += wraps_in(angles)
        facts.last = channel.values[-1:]


def _notes(facts: ChannelFacts, table: Table, columns: ColumnMap) -> Notes:
    """Return what is said of a channel, but for the signs of its quaternions."""
    dead = facts.dead(columns.native)[1]
    if not facts.is_there(columns.native):
        return dead
    lost = np.concatenate([no_rows(), *facts.blank])
    norms = _norm_notes(facts, table) if facts.off else ()
    return (*dead, *blank_note(lost, table), *norms, *wrap_note(facts.wraps))


def _kept(facts: ChannelFacts, column: int, before: int = 0) -> Iterator[Series1]:
    """Yield what is kept of a channel's rows, each part with some rows before it."""
    assert facts.store is not None  # of channels whose rows are kept
    for begin, end in ranges(facts.count, PART):
        yield facts.store.read(column, max(begin - before, 0), end)


def _norm_notes(facts: ChannelFacts, table: Table) -> Notes:
    """Say how far quaternions were off unit length."""
    count, worst, place, begin = 0, 1.0, 0, 0
    for norm in _kept(facts, NORMS):
        off = np.abs(norm - 1)
        count += int((off >= WORTH_SAYING).sum())
        if off.max() > abs(worst - 1):
            place, worst = begin + int(off.argmax()), float(norm[off.argmax()])
        begin += len(norm)
    if not count:
        return ()
    norms, store = (lambda: _kept(facts, NORMS)), facts.store
    assert store is not None  # of channels whose rows are kept
    row = store.read(ROWS, place, place + 1).astype(np.int64)
    median, high = streamed_median(norms), streamed_quantile(norms, 0.9)
    return norm_note(Norms(count, worst, 0, median, high), facts.count, table, row)


def _gaps(facts: ChannelFacts) -> Notes:
    """Say where a sensor fell silent."""
    if facts.store is None or facts.count < 2:
        return ()
    usual = streamed_median(lambda: (np.diff(t) for t in _kept(facts, TIMES, 1)))
    lengths, times = list[Series1](), list[Series1]()
    for t in _kept(facts, TIMES, 1):
        steps = np.diff(t)
        where = np.flatnonzero(steps > GAP * usual)
        lengths.append(steps[where])
        times.append(t[where])
    return gap_note(facts.name, np.concatenate(lengths), np.concatenate(times))
