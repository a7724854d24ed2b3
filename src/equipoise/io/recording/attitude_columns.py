"""Attitude columns to unit quaternions, scalar first, body to a laboratory whose Z is up."""

from collections.abc import Iterator
from dataclasses import dataclass

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
from equipoise.model.arrays import Floats, Ints, Series1, Series4

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
    norm = lengths_of(channel.values)
    if np.abs(norm - 1).max() <= max(10.0 ** -_decimals(channel.values), SINGLE):
        return None
    return Channel(channel.name, channel.t, norm[:, None], channel.rows)


def lengths_of(values: Floats) -> Series1:
    """Return the lengths of quaternions."""
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
    norm = lengths_of(channel.values)
    off = is_off(norm)
    notes = norm_note(Norms.of(norm), len(norm), table, channel.rows) if off else ()
    q, flips = unit_quaternions(channel, columns, off)
    return q, (*notes, *flip_note(flips))


def is_off(norm: Series1) -> bool:
    """Say whether lengths differ from one by more than a double's rounding."""
    return bool(np.abs(norm - 1).max() >= ROUNDING)


def unit_quaternions(channel: Channel, columns: ColumnMap, off: bool) -> tuple[Channel, int]:
    """Return a quaternion channel in our axes, and how often its sign changed.

    It is made of unit length if it is ``off``, else left as it is to the last bit.
    """
    q = _in_our_axes(normalise(channel.values) if off else channel.values, columns)
    flips = int(sign_changes(q).sum())
    q = continuous(q) if flips else q
    return Channel(channel.name, channel.t, q, channel.rows), flips


def flip_note(count: int) -> Notes:
    """Say how often the sign of a quaternion changed."""
    reported = f"attitude: the quaternion changed its sign {count} times; made continuous."
    return (reported,) if count else ()


def of_unit_length(
    channel: Channel, table: Table, columns: ColumnMap
) -> tuple[Channel, list[FaultyRows]]:
    """Return the quaternions whose length is one, as far as rounding and means go."""
    norm = lengths_of(channel.values)
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
    q = _from_euler(channel.values, columns.euler.sequence)
    return rotations(channel, q, columns), wrap_note(wraps_in(channel.values))


def wraps_in(angles: Floats) -> int:
    """Return how often angles (rad) jump by more than half a turn."""
    return int((np.abs(np.diff(angles, axis=0)) > np.pi).sum())


def wrap_note(count: int) -> Notes:
    """Say how often an angle wrapped."""
    reported = f"attitude: {count} wraps of an angle by a whole turn; unwrapped."
    return (reported,) if count else ()


def rotations(channel: Channel, q: Series4, columns: ColumnMap) -> Channel:
    """Return rotations that were no quaternions in the table as quaternions in our axes."""
    mended = continuous(_in_our_axes(q, columns))  # their signs come of the conversion
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


@dataclass(frozen=True, slots=True)
class Norms:
    """What is said of the lengths of quaternions."""

    count: int  # that are off by more than five printed digits
    worst: float
    place: int  # of the worst
    median: float
    high: float  # the 0.9 quantile

    @classmethod
    def of(cls, norm: Series1) -> "Norms":
        """Return this of lengths."""
        off = np.abs(norm - 1)
        count, worst = int((off >= WORTH_SAYING).sum()), int(off.argmax())
        median, high = float(np.median(norm)), float(np.quantile(norm, 0.9))
        return cls(count, float(norm[worst]), worst, median, high)


def norm_note(norms: Norms, total: int, table: Table, rows: Ints) -> Notes:
    """Say how far of so many quaternions were off unit length."""
    if not norms.count:
        return ()
    mostly_short = norms.high < 1 - WORTH_SAYING
    cause = "; most are short, as means of several frames are" if mostly_short else ""
    return (
        f"attitude: {norms.count} of {total} quaternions were off unit length (median "
        f"{norms.median:.6f}, worst {norms.worst:.6f} at "
        f"{table.place(int(rows[norms.place]))}){cause}; normalised.",
    )
