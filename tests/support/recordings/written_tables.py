"""Columns of a motion, and texts of them."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from equipoise.model.arrays import Floats, Series1, Series3, Series4
from tests.support.recordings.recorded_motion import Motion

Columns = dict[str, Series1]
TURN, RATE = ("qw", "qx", "qy", "qz"), ("gx", "gy", "gz")
ROS = (
    "__time",
    *(f"/imu/orientation/{c}" for c in "wxyz"),
    *(f"/imu/angular_velocity/{c}" for c in "xyz"),
)
OURS = ("time_s", "q_w", "q_x", "q_y", "q_z", "omega_x_rad_s", "omega_y_rad_s", "omega_z_rad_s")


def saved(folder: Path, content: str | bytes, name: str = "run.csv") -> Path:
    """Write a file as it is, and return its path."""
    path = folder / name
    path.write_bytes(content.encode() if isinstance(content, str) else content)
    return path


def columns(  # noqa: PLR0913, PLR0917 - each is a part of the table
    motion: Motion,
    clock: str = "ms",
    t: Series1 | None = None,
    q: Series4 | None = None,
    w: Series3 | None = None,
    turn: Sequence[str] = TURN,
    rate: Sequence[str] = RATE,
) -> Columns:
    """Return clock (ms unless given), quaternion and rates, by the names of a hobbyist."""
    t = 1e3 * motion.t if t is None else t
    q, w = motion.q if q is None else q, motion.w if w is None else w
    return named((clock, *turn, *rate), np.column_stack([t, q, w]))


def named(names: Sequence[str], values: Floats) -> Columns:
    """Return columns by their names."""
    return dict(zip(names, values.T, strict=True))


def ours(motion: Motion, names: Sequence[str] = OURS) -> Columns:
    """Return columns in SI under names that are known."""
    return named(names, np.column_stack([motion.t, motion.q, motion.w]))


def lines(table: Columns, separator: str = ",", decimals: int = 7) -> list[str]:
    """Return a header and rows; whole numbers without decimals."""
    whole = [bool(np.array_equal(v, np.round(v))) for v in table.values()]
    form = separator.join("%d" if w else f"%.{decimals}f" for w in whole)
    rows = zip(*(v.tolist() for v in table.values()), strict=True)
    return [separator.join(table), *(form % row for row in rows)]


def text(table: Columns, separator: str = ",", decimals: int = 7) -> str:
    """Return a header and rows as a text."""
    return "\n".join([*lines(table, separator, decimals), ""])


def changed(rows: list[str], changes: dict[int, str]) -> str:
    """Return lines as a text, some of the motion's rows (counted from 0) replaced."""
    body = [changes.get(k, row) for k, row in enumerate(rows[1:])]
    return "\n".join([rows[0], *body, ""])
