"""How a file is to be read: what a person states where the file itself does not."""

from dataclasses import dataclass

from equipoise.io.columns.column_map import ColumnMap, Layout
from equipoise.model.from_memory import BAD_ROWS


@dataclass(frozen=True, slots=True)
class ReadOptions:
    """What is stated of a file; what is left out is detected, or refused where it is open."""

    dialect: str | None = None  # one of ``dialects.DIALECTS``
    columns: ColumnMap | None = None  # goes before a dialect
    topics: tuple[str, ...] = ()  # of a log: those to take
    body: str | None = None  # of a motion-capture export
    instance: int | None = None  # of a log's sensors of one kind, counted from 0
    bad_rows: float = BAD_ROWS  # share of the rows
    max_memory: int | None = None  # bytes that reading may take; None: by the file's size

    @property
    def layout(self) -> Layout:
        """Return how a text is cut into cells."""
        return Layout() if self.columns is None else self.columns.layout


AS_IT_IS = ReadOptions()
