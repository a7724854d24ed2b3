"""Kinds of options with their defaults in help, and the options that several commands share."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Annotated, Any

from cyclopts import Parameter, Token

from equipoise.io.columns.read_options import BAD_ROWS
from equipoise.model.errors import InputError


def _plain(values: tuple[float, ...]) -> str:
    """Return numbers as people type them."""
    return " ".join(f"{value:g}" for value in values)


def _whole(_kind: Any, tokens: Sequence[Token]) -> int:
    """Return a whole number; one with a fraction would be rounded without a word."""
    (token,) = tokens
    try:
        return int(token.value)
    except ValueError:
        raise InputError(token.keyword or "number", token.value, "a whole number") from None


BUDGET_S = 60.0  # s, chosen: what a person waits for
Flag = Annotated[bool, Parameter(show_default=False)]
Json = Annotated[
    bool, Parameter(show_default=False, help="Print one JSON document instead of text.")
]
Names = Annotated[tuple[str, ...], Parameter(show_default=False)]
Listed = Annotated[tuple[str, ...], Parameter(show_default=False, consume_multiple=True)]
Triple = Annotated[tuple[float, float, float], Parameter(show_default=_plain)]
Several = Annotated[tuple[float, ...], Parameter(show_default=_plain, consume_multiple=True)]
Whole = Annotated[int, Parameter(converter=_whole)]
On = Annotated[
    str,
    Parameter(
        help=(
            "Where to run: local, in processes of this computer; dask-local, in a "
            "temporary Dask cluster; or dask://HOST:PORT, on a running scheduler with all "
            "its workers."
        )
    ),
]


@Parameter(name="*")
@dataclass(frozen=True, slots=True)
class Seeking:
    """Parameters to estimate, and parameters taken as known.

    Attributes
    ----------
    hold
        Parameter to fix at the testbed's value, such as inertia_P_zz. May be repeated.
    term
        Torque term to estimate too: viscous, quadratic, constant, swirl, sag or drift. May be
        repeated.
    prior
        Use the testbed's inertia and centre of mass with their sd as prior; this fixes an open
        scale.
    """

    hold: Names = ()
    term: Names = ()
    prior: Flag = False


NOTHING_STATED = Seeking()


@Parameter(name="*")
@dataclass(frozen=True, slots=True)
class Spreading:
    """By what pieces of work are done that do not rest on each other.

    Attributes
    ----------
    workers
        Processes to distribute trials, budgets, runs of a series or recordings over.
    """

    workers: Whole = 1
    on: On = "local"


ALONE = Spreading()
IN_PAIR = Spreading(workers=2)


@Parameter(name="*")
@dataclass(frozen=True, slots=True)
class Searching:
    """How long a search may take.

    Attributes
    ----------
    budget_s
        Processor time of a search; it then ends with the best fit so far.
    """

    budget_s: float = BUDGET_S


USUAL = Searching()


@Parameter(name="*")
@dataclass(frozen=True, slots=True)
class Reading:
    """How a recording is read, and which part of it.

    Attributes
    ----------
    from_s
        Ignore rows before this time. If omitted: in a bench's own record those before the release,
        else none.
    to_s
        Ignore rows after this time.
    dialect
        Format of the table: native, optitrack, vicon, qualisys, phyphox, ros or euler. If omitted:
        by its header.
    columns
        Column map (TOML) for any other table.
    topic
        Topic of a log to use, where it has several. May be repeated.
    body
        Rigid body of a motion-capture export to use, where it has several; natnet: its name or id.
    instance
        Sensor of a log to use, where it has several of a kind; counted from 0.
    bad_rows
        Maximum share of faulty rows; beyond it the file is refused.
    max_memory_mb
        Memory for reading a file, in MB. If omitted: 64 times the file, at least 256, at most 2000.
    """

    from_s: float | None = None
    to_s: float | None = None
    dialect: str | None = None
    columns: str | None = None
    topic: Names = ()
    body: str | None = None
    instance: Whole | None = None
    bad_rows: float = BAD_ROWS
    max_memory_mb: float | None = None

    @property
    def whole(self) -> "Reading":
        """Return how another recording of the same kind is read as a whole."""
        return replace(self, from_s=None, to_s=None)


WHOLE = Reading()
