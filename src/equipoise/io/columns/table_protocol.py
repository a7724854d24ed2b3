"""What text tables and Parquet tables have in common."""

from typing import Protocol, runtime_checkable

from equipoise.model.arrays import Series1


@runtime_checkable  # so that the tests can check the annotations that name it
class Table(Protocol):
    """Named columns of numbers, each row with a place that a person can find."""

    @property
    def source(self) -> str:
        """The file."""
        ...

    @property
    def names(self) -> tuple[str, ...]:
        """The columns' names."""
        ...

    @property
    def notes(self) -> tuple[str, ...]:
        """What reading the table had to leave out."""
        ...

    def __len__(self) -> int:
        """Return the number of rows."""
        ...

    def place(self, row: int) -> str:
        """Return where a row is, such as 'line 7'."""
        ...

    def numbers(self, name: str) -> Series1:
        """Return a column, NaN where a cell is blank; InputError names line and column."""
        ...
