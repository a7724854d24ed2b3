"""Times that are dates in memory, made seconds."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from equipoise.model.arrays import Series1
from equipoise.model.units import NS

DATED = "mM"  # kinds of numpy's types: a span of time, and a date


def zero_of(times: NDArray[Any]) -> Any:
    """Return what dates count from: the first that there is; spans count from zero."""
    there = times[~np.isnat(times)]
    return there[0] if times.dtype.kind == "M" and len(there) else np.zeros(1, times.dtype)[0]


def seconds_since(times: NDArray[Any], zero: Any) -> Series1:
    """Return dates or spans as seconds since one of them, NaN where there is none."""
    since = (times - zero).astype("timedelta64[ns]")
    return np.where(np.isnat(since), np.nan, since.astype(np.int64) * NS)


def start_note(zero: Any) -> tuple[str, ...]:
    """Say which date is time zero; a span counts from zero already."""
    is_date = zero.dtype.kind == "M"
    return (f"The clock starts at {zero}; this is taken as zero.",) if is_date else ()
