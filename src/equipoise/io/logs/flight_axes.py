"""Axes of flight controllers and of their sensors, and ours.

They have FRD body axes (x ahead, y right, z down) in NED (north, east, down). FRD becomes ahead,
left, up; NED becomes north, west, up: half a turn about x on either side. So a platform that is
level in the log is level here, and a testbed's body axes are ahead, left, up of the board.
"""

from collections.abc import Sequence

from equipoise.io.columns.column_map import ColumnMap
from equipoise.io.logs.log_table import LogChannel, log_map

FLU = ("x", "-y", "-z")  # ahead, left, up in terms of ahead, right, down


def flight_map(channels: Sequence[LogChannel]) -> ColumnMap:
    """Return what the columns of a log in these axes mean."""
    return log_map(channels, lab_up="-z", body=FLU)
