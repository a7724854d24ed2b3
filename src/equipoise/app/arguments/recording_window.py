"""Options that every command shares which reads a recording."""

from dataclasses import dataclass

from cyclopts import Parameter


@Parameter(name="*")
@dataclass(frozen=True, slots=True)
class Reading:
    """How a recording is read, and which part of it.

    Attributes
    ----------
    from_s
        Leave out what is before this time. Left out: of a bench's own record what is before the
        platform was let go, else nothing.
    to_s
        Leave out what is after this time.
    dialect
        How to read the table: native, optitrack or ros. Left out: by its header.
    columns
        Column map (TOML) for a table of any other kind.
    """

    from_s: float | None = None
    to_s: float | None = None
    dialect: str | None = None
    columns: str | None = None


WHOLE = Reading()
