"""Where the numbers of a table's columns are kept while it grows: in memory, or on the disk."""

import tempfile
from bisect import bisect_right
from pathlib import Path
from typing import Protocol, runtime_checkable

import numpy as np

from equipoise.model.arrays import Floats

NUMBER = 8  # bytes


@runtime_checkable
class Store(Protocol):
    """The numbers of columns, block after block."""

    in_memory: bool

    def add(self, column: int, first: int, values: Floats) -> None:
        """Add the next rows of a column, from a first one on."""
        ...

    def read(self, column: int, start: int, stop: int) -> Floats:
        """Return the rows of a column from one to before another."""
        ...


class InMemory:
    """Columns in memory."""

    in_memory = True

    def __init__(self) -> None:
        self._values: dict[int, Floats] = {}

    def add(self, column: int, first: int, values: Floats) -> None:
        """Add the next rows of a column, from a first one on."""
        end, held = first + len(values), self._values.get(column, np.zeros(0))
        if end > len(held):
            wider = np.empty(max(end, 2 * first))  # what is not used yet takes no memory
            wider[:first] = held[:first]
            self._values[column] = held = wider
        held[first:end] = values

    def read(self, column: int, start: int, stop: int) -> Floats:
        """Return the rows of a column from one to before another."""
        return self._values[column][start:stop]


class OnDisk:
    """Columns in a file without a name, which is gone when it is closed."""

    in_memory = False

    def __init__(self, folder: Path) -> None:
        """Take the folder whose disk has the room."""
        self._file = tempfile.TemporaryFile(dir=folder)  # noqa: SIM115  # as long as the store
        self._end = 0  # bytes
        self._first: dict[int, list[int]] = {}  # row of each block of a column
        self._at: dict[int, list[int]] = {}  # its place in the file

    def add(self, column: int, first: int, values: Floats) -> None:
        """Add the next rows of a column, from a first one on."""
        self._first.setdefault(column, []).append(first)
        self._at.setdefault(column, []).append(self._end)
        self._file.seek(self._end)
        self._end += self._file.write(np.ascontiguousarray(values).tobytes())

    def read(self, column: int, start: int, stop: int) -> Floats:
        """Return the rows of a column from one to before another."""
        values = np.empty(stop - start)
        firsts = self._first[column]
        block, row = max(bisect_right(firsts, start) - 1, 0), start
        while row < stop:
            end = min(firsts[block + 1] if block + 1 < len(firsts) else stop, stop)
            self._file.seek(self._at[column][block] + NUMBER * (row - firsts[block]))
            read = self._file.read(NUMBER * (end - row))
            values[row - start : end - start] = np.frombuffer(read, np.float64)
            block, row = block + 1, end
        return values

    def close(self) -> None:
        """Let the file go."""
        self._file.close()


class Disk:
    """Stores on the disk of a folder, until it is closed."""

    def __init__(self, folder: Path) -> None:
        self._folder, self._stores = folder, list[OnDisk]()

    def store(self) -> OnDisk:
        """Return a new one."""
        self._stores.append(OnDisk(self._folder))
        return self._stores[-1]

    def close(self) -> None:
        """Let all of them go."""
        for store in self._stores:
            store.close()
