"""Stamps that a channel has twice, and where it fell silent."""

import numpy as np

from equipoise.io.columns.row_faults import FaultyRows, RowFault
from equipoise.io.columns.table import Table
from equipoise.io.recording.channels import Channel
from equipoise.model.arrays import Series1

Notes = tuple[str, ...]
GAP = 3.0  # median intervals (chosen; one missed row is 2, two are 3)
NAMED = 3  # gaps that are named one by one


def without_duplicates(channel: Channel, table: Table) -> tuple[Channel, list[FaultyRows]]:
    """Return a channel with the first row of each time stamp alone."""
    again = np.append(False, channel.t[1:] == channel.t[:-1])
    if not again.any():
        return channel, []
    rows, t = channel.rows[again], channel.t[again]
    where = f"{table.source}, {table.place(int(rows[0]))}"
    found = f"the time {t[0]:.9g} s again"
    wanted = f"a time of its own for each row of {channel.name}"
    return channel.keep(~again), [FaultyRows(RowFault.REPEATED, rows, where, found, wanted)]


def gap_notes(channel: Channel) -> Notes:
    """Say where a sensor fell silent for more than three median intervals."""
    steps = np.diff(channel.t)
    if not len(steps):
        return ()
    where = np.flatnonzero(steps > GAP * np.median(steps))
    return gap_note(channel.name, steps[where], channel.t[where])


def gap_note(name: str, steps: Series1, times: Series1) -> Notes:
    """Say where gaps of some lengths (s) begin (s)."""
    if not len(steps):
        return ()
    longest = np.argsort(-steps, kind="stable")[:NAMED]
    reported = ", ".join(f"{steps[i]:.3g} s from {times[i]:.6g} s" for i in sorted(longest))
    named = f"the longest: {reported}" if len(steps) > NAMED else reported
    return (f"{name}: {len(steps)} gap{'s' * (len(steps) > 1)}: {named}.",)
