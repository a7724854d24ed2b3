"""Channels that nothing was connected to: columns of zeros throughout."""

import numpy as np

from equipoise.io.columns.column_map import Columns
from equipoise.io.recording.channels import Channel

Notes = tuple[str, ...]


def without_dead(channel: Channel, columns: Columns, native: bool) -> tuple[Channel | None, Notes]:
    """Return the channel, or None if it is all zero; say so, and say which columns are.

    A foreign gyro with one dead axis is left out as a whole: two true axes and a false zero
    mislead every estimator. In a native file a zero axis can be an exact simulation's.
    """
    dead = np.abs(channel.values).max(axis=0) == 0
    names = " ".join(n for n, zero in zip(columns.names, dead.tolist(), strict=True) if zero)
    misleads = channel.name == "rate" and not native and bool(dead.any())
    if dead.all() or misleads:
        return None, (f"{channel.name}: zero in every row ({names}); the channel was ignored.",)
    if dead.any() and channel.name == "rate":
        return channel, (f"{channel.name}: zero in every row ({names}).",)
    return channel, ()
