"""Attitude columns to unit quaternions, scalar first, body to a laboratory whose Z is up."""

from collections.abc import Iterator

import numpy as np

from equipoise.io.columns.axis_permutation import TO_Z_UP, axes_matrix
from equipoise.io.columns.column_map import ColumnMap
from equipoise.io.columns.row_faults import FaultyRows, RowFault
from equipoise.io.columns.table import Table
from equipoise.io.recording.channels import Channel
from equipoise.maths.attitude import (
    conjugate,
    continuous,
    exponential,
    from_matrix,
    multiply,
    normalise,
    sign_changes,
)
from equipoise.model.arrays import Floats, Series1, Series4

Notes = tuple[str, ...]
JUMP = 0.05  # from unit: no rounding does this, so it is not a unit quaternion (chosen)
SHORTEST_MEAN = 0.5  # chosen: frames spread over more than half a turn have no mean
ROUNDING = 1e-12  # below this nothing is touched, so that our own files come back verbatim
WORTH_SAYING = 1e-5  # five printed digits
SINGLE = 2e-7  # what single precision does to the length of a quaternion, twice over
PART = 1 << 16  # rows that are looked at together (chosen)
DIGITS = 12  # decimals up to which a column is taken as rounded (chosen: a double has 15)


def lengths(channel: Channel) -> Channel | None:
    """Return the lengths (n, 1) of quaternions as found, if they differ by more than rounding.

    A component rounded to d decimals is off by 10^-d / 2 at most, a length by 10^-d.
    """
    norm = _lengths(channel.values)
    if np.abs(norm - 1).max() <= max(10.0 ** -_decimals(channel.values), SINGLE):
        return None
    return Channel(channel.name, channel.t, norm[:, None], channel.rows)


def _lengths(values: Floats) -> Series1:
    return np.concatenate([np.linalg.norm(part, axis=1) for part in _parts(values)])


def _decimals(values: Floats) -> int:
    """Return how many decimals the values were printed with."""
    for decimals in range(DIGITS):
        off = (np.abs(part - np.round(part, decimals)).max() for part in _parts(values))
        if all(each < ROUNDING for each in off):
            return decimals
    return DIGITS


def _parts(values: Floats) -> Iterator[Floats]:
    """Yield the rows, some at a time: whole copies of a long table count."""
    return (values[at : at + PART] for at in range(0, len(values), PART))


def quaternions(channel: Channel, table: Table, columns: ColumnMap) -> tuple[Channel, Notes]:
    """Return a quaternion channel set right, with what was set right."""
    q, notes = _unit(channel, table)
    q, flips = _continuous(_in_our_axes(q, columns))
    return Channel(channel.name, channel.t, q, channel.rows), (*notes, *flips)


def of_unit_length(
    channel: Channel, table: Table, columns: ColumnMap
) -> tuple[Channel, list[FaultyRows]]:
    """Return the quaternions whose length is one, as far as rounding and means go."""
    norm = _lengths(channel.values)
    least = SHORTEST_MEAN if columns.mean_of_frames else 1 - JUMP
    good = (norm >= least) & (norm <= 1 + JUMP)
    if good.all():
        return channel, []
    rows, found = channel.rows[~good], f"a quaternion of length {norm[~good][0]:.4g}"
    where = f"{table.source}, {table.place(int(rows[0]))}"
    wanted = f"length 1 within {JUMP:.0%}"
    return channel.keep(good), [FaultyRows(RowFault.NOT_UNIT, rows, where, found, wanted)]


def euler_angles(channel: Channel, columns: ColumnMap) -> tuple[Channel, Notes]:
    """Return a channel of three angles (rad) as quaternions."""
    assert columns.euler is not None  # the caller has read these columns
    wraps = int((np.abs(np.diff(channel.values, axis=0)) > np.pi).sum())
    q = _from_euler(channel.values, columns.euler.sequence)
    reported = f"attitude: {wraps} wraps of an angle by a whole turn; taken as turning on."
    return rotations(channel, q, columns), (reported,) if wraps else ()


def rotations(channel: Channel, q: Series4, columns: ColumnMap) -> Channel:
    """Return rotations that were no quaternions in the table as quaternions in our axes."""
    mended, _ = _continuous(_in_our_axes(q, columns))  # their signs come of the conversion
    return Channel(channel.name, channel.t, mended, channel.rows)


def _from_euler(angles: Floats, sequence: str) -> Series4:
    """Return the attitude; capitals turn about the turned axes, small letters about the fixed."""
    turns: list[Floats] = []
    for letter, angle in zip(sequence.lower(), angles.T, strict=True):
        turns.append(exponential(angle[:, None] * np.eye(3)["xyz".index(letter)]))
    first, second, third = turns if sequence.isupper() else turns[::-1]
    return multiply(first, multiply(second, third))


def _in_our_axes(q: Series4, columns: ColumnMap) -> Series4:
    """Return R_ours = L R_table S^T: L turns the laboratory to Z up, S the body axes to ours."""
    if columns.inverse:
        q = conjugate(q)
    if columns.lab_up != "z":
        q = multiply(np.array(TO_Z_UP[columns.lab_up]), q)
    if columns.body != ("x", "y", "z"):
        q = multiply(q, conjugate(from_matrix(axes_matrix(columns.body))))
    return q


def _continuous(q: Series4) -> tuple[Series4, Notes]:
    flips = sign_changes(q)
    count = int(flips.sum())
    reported = f"attitude: the quaternion changed its sign {count} times; made continuous."
    return (continuous(q), (reported,)) if count else (q, ())


def _unit(channel: Channel, table: Table) -> tuple[Series4, Notes]:
    """Return quaternions of unit length."""
    norm = _lengths(channel.values)
    if np.abs(norm - 1).max() < ROUNDING:
        return channel.values, ()
    return normalise(channel.values), _norm_note(norm, channel, table)


def _norm_note(norm: Series1, channel: Channel, table: Table) -> Notes:
    off = np.abs(norm - 1)
    if off.max() < WORTH_SAYING:
        return ()
    mostly_short = float(np.quantile(norm, 0.9)) < 1 - WORTH_SAYING
    count, worst = int((off >= WORTH_SAYING).sum()), int(off.argmax())
    cause = "; most are short, as means of several frames are" if mostly_short else ""
    return (
        f"attitude: {count} of {len(norm)} quaternions were off unit length (median "
        f"{np.median(norm):.6f}, worst {norm[worst]:.6f} at "
        f"{table.place(int(channel.rows[worst]))}){cause}; normalised.",
    )
