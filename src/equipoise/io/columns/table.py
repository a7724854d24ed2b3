"""A table of a file, whatever its format: named columns of numbers that are read when asked for."""

from collections.abc import Callable
from dataclasses import dataclass

from equipoise.model.arrays import Series1
from equipoise.model.errors import InputError


@dataclass(frozen=True, slots=True, eq=False)
class Table:
    """Named columns of numbers, each row with a place that a person can find.

    A column stays as it stands in the file until it is asked for: foreign tables carry many columns
    that nobody needs.
    """

    source: str  # the file
    names: tuple[str, ...]  # of the columns
    count: int  # rows
    column: Callable[["Table", str], Series1]  # NaN where blank; InputError for what is no number
    lines: tuple[int, ...] = ()  # the line of the file each row ends on; none: rows are counted
    notes: tuple[str, ...] = ()  # what reading the table had to leave out

    def __len__(self) -> int:
        """Return the number of rows."""
        return self.count

    def place(self, row: int) -> str:
        """Return where a row is, such as 'line 7' or, counted from 1, 'row 7'."""
        return f"line {self.lines[row]}" if self.lines else f"row {row + 1}"

    def numbers(self, name: str) -> Series1:
        """Return a column, NaN where a cell is blank; InputError names line and column."""
        return self.column(self, name)

    def not_a_number(self, row: int, name: str, found: object, blank: str) -> InputError:
        """Return the error for a cell that is neither a finite number nor ``blank``."""
        where = f"{self.source}, {self.place(row)}, column '{name}'"
        return InputError(where, f"'{found}'", f"a finite number, or {blank} for no reading")
