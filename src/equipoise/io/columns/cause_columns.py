"""The native columns of torque by cause: the mean over the second that begins at the row.

torque_<cause>_x_N_m  torque_<cause>_sd_x_N_m    body axes; the second is one sd of the first
"""

import re

from equipoise.io.columns.column_map import NamedColumn
from equipoise.model.torque_by_cause import CAUSES, TOTAL

COLUMN = re.compile(f"torque_((?:{'|'.join((*CAUSES, TOTAL))})_(?:sd_)?[xyz])_N_m")


def cause_of(column: str) -> NamedColumn | None:
    """Return what a native column says of a cause; None if it says nothing of one."""
    match = COLUMN.fullmatch(column)
    return None if match is None else NamedColumn(match[1], column, 1.0)


def cause_column(name: str) -> str:
    """Return the native column of a cause's component, as a recording names it ('gravity_x')."""
    return f"torque_{name}_N_m"
