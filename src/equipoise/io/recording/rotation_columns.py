"""Rotations that are no quaternions, as a table may have them: matrices, vectors, angles."""

import numpy as np

from equipoise.io.columns.column_map import ColumnMap
from equipoise.io.columns.row_faults import FaultyRows, RowFault
from equipoise.io.columns.table import Table
from equipoise.io.recording.attitude_columns import euler_angles, rotations
from equipoise.io.recording.channels import Channel
from equipoise.maths.attitude import exponential, from_matrix
from equipoise.model.arrays import Floats, Ints

Notes = tuple[str, ...]
ROUNDED = 0.05  # by which columns of a matrix may miss unit length and right angles (chosen)


def as_quaternions(channel: Channel, table: Table, columns: ColumnMap) -> tuple[Channel, Notes]:
    """Return a channel of rotations of whichever kind as unit quaternions, with notes."""
    if columns.matrix is not None:
        return rotations(channel, from_matrix(_square(channel)), columns), ()
    if columns.rotation_vector is not None:
        return rotations(channel, exponential(channel.values), columns), ()
    return euler_angles(channel, columns)


def of_rotations(channel: Channel, table: Table) -> tuple[Channel, list[FaultyRows], Ints]:
    """Return the matrices (n, 9), row by row, that are rotations, as far as rounding goes.

    Rows of zeros alone, returned last, hold no reading; others that are no rotation are faulty.
    """
    blank = (channel.values == 0).all(axis=1)
    turns = _square(channel)
    misses = np.abs(turns.swapaxes(1, 2) @ turns - np.eye(3)).max(axis=(1, 2)) > ROUNDED
    bad = (misses | (np.linalg.det(turns) < 0)) & ~blank
    lost = channel.rows[blank]
    if not bad.any():
        return channel.keep(~blank), [], lost
    rows, kind = channel.rows[bad], "no rotation" if misses[bad][0] else "a mirror image"
    where = f"{table.source}, {table.place(int(rows[0]))}"
    wanted = "columns of unit length at right angles, right-handed"
    fault = FaultyRows(RowFault.NOT_ROTATION, rows, where, f"a matrix that is {kind}", wanted)
    return channel.keep(~blank & ~bad), [fault], lost


def _square(channel: Channel) -> Floats:
    return channel.values.reshape(-1, 3, 3)


def blank_note(rows: Ints, table: Table) -> Notes:
    """Say which rows of matrices hold nothing but zeros."""
    if not len(rows):
        return ()
    text = f"attitude: {len(rows)} rows of zeros alone, first at {table.place(int(rows[0]))}"
    return (f"{text}: no reading, as where tracking is lost; left out.",)
