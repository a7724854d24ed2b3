"""The numbers of a table of which nobody has said what they mean."""

import re
from dataclasses import dataclass

import numpy as np

from equipoise.model.arrays import Floats, Series1

WORD = re.compile(r"[A-Za-z]+|\d+")


@dataclass(frozen=True, slots=True, eq=False)
class NumberTable:
    """Columns side by side."""

    names: tuple[str, ...]
    values: Floats  # (n, k), NaN where there is no number
    units: tuple[str, ...] = ()  # as a row below the names has them; none: nothing is said

    def column(self, name: str) -> Series1:
        """Return one column."""
        return self.values[:, self.names.index(name)]

    def unit(self, name: str) -> str:
        """Return what the table says of a column's unit, '' if it says nothing."""
        return self.units[self.names.index(name)].lower() if self.units else ""


def words_of(name: str) -> tuple[str, ...]:
    """Return the words of a name, in small letters: 'gyroX [deg/s]' is gyro, x, deg, s."""
    spaced = re.sub(r"(?<=[a-z])(?=[A-Z])", " ", name)
    return tuple(word.lower() for word in WORD.findall(spaced))


def varies(values: Series1) -> bool:
    """Say whether a column has two different numbers."""
    finite = values[np.isfinite(values)]
    return bool(len(finite) > 1 and np.ptp(finite) > 0)
