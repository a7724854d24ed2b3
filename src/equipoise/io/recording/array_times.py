"""The times of arrays in memory: numbers or dates, of one clock, with one zero."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from equipoise.io.columns.dated_times import DATED, seconds_since, start_note, zero_of
from equipoise.io.recording.build_recording import EPOCH
from equipoise.io.recording.checked_arrays import where
from equipoise.model.arrays import Series1
from equipoise.model.errors import InputError


@dataclass(frozen=True, slots=True, eq=False)
class Times:
    """The times of each group of arrays by the name of their argument; the first is ``t``."""

    seconds: dict[str, Series1]
    notes: tuple[str, ...]

    def of(self, name: str) -> str:
        """Return the argument that has the times: itself, or ``t`` where it is not given."""
        return name if name in self.seconds else "t"


def times_of(t: Any, others: Mapping[str, Any]) -> Times:
    """Return times in seconds since one zero; InputError for those that are not of one clock."""
    stated = {"t": t, **{name: each for name, each in others.items() if each is not None}}
    arrays = {name: _times(name, each) for name, each in stated.items()}
    kinds = {name: each.dtype.kind for name, each in arrays.items()}
    for name, kind in kinds.items():
        if kind != kinds["t"]:
            wanted = "numbers or dates in both"
            raise InputError(where(name), "times of another kind than in t", wanted)
    if kinds["t"] in DATED:
        zero = zero_of(arrays["t"])
        seconds = {name: seconds_since(each, zero) for name, each in arrays.items()}
        return Times(_of_one_clock(seconds), start_note(zero))
    start = _start(arrays["t"])
    if abs(start) < EPOCH:
        return Times(_of_one_clock(arrays), ())
    since = {name: each - start for name, each in arrays.items()}
    noted = f"The clock starts at {start:.3f} s; this is taken as zero."
    return Times(_of_one_clock(since), (noted,))


def _times(name: str, values: Any) -> NDArray[Any]:
    """Return times as dates or as float64."""
    wanted = "times (n,): numbers in s, or dates (datetime64)"
    array = np.asarray(values)
    if array.dtype.kind not in DATED:
        try:
            array = array.astype(np.float64)
        except (TypeError, ValueError) as error:
            raise InputError(where(name), "neither numbers nor dates", wanted) from error
    if array.ndim != 1 or not len(array):
        raise InputError(where(name), f"an array of shape {array.shape}", wanted)
    return array


def _of_one_clock(seconds: dict[str, Series1]) -> dict[str, Series1]:
    for name, each in seconds.items():
        start = _start(each)
        if abs(start) >= EPOCH:
            found = f"a clock that starts {start:.9g} s after the zero of t"
            raise InputError(where(name), found, "times of one clock")
    return seconds


def _start(times: Series1) -> float:
    """Return the first time that there is; zero if there is none."""
    there = times[np.isfinite(times)]
    return float(there[0]) if len(there) else 0.0
