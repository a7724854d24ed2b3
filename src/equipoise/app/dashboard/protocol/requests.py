"""Requests of a person at the page to the runner, and what each of their values may be.

The annotations are the one schema: ``sound`` checks a request against it before the request gets
to the runner. What a value may be at a certain platform (its laws, its masses, its recordings) is
added by who knows the platform.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, Any, get_args

from pydantic import AfterValidator, ConfigDict, Field, TypeAdapter, ValidationError

from equipoise.io.toml.plausible import SIZES
from equipoise.model.errors import InputError
from equipoise.model.visible_text import is_all_visible

FASTEST = 100.0  # times, chosen
LENGTH, LASTING = SIZES["length"], SIZES["time"]  # m, s
LETTERS = 400  # of a text, chosen: a few lines
SHOWN = 40  # characters of a found value that are repeated; chosen: half a line


def _visible(text: str) -> str:
    if not is_all_visible(text):
        raise ValueError
    return text


Length = Annotated[float, Field(
    ge=-LENGTH, le=LENGTH, allow_inf_nan=False,
    description=f"a length of -{LENGTH:g} to {LENGTH:g} m")]  # fmt: skip
Tolerance = Annotated[float, Field(
    gt=0, le=LENGTH, allow_inf_nan=False,
    description=f"a length above 0, at most {LENGTH:g} m")]  # fmt: skip
Text = Annotated[str, Field(
    max_length=LETTERS,
    description=f"a text of at most {LETTERS} visible characters"), AfterValidator(_visible)
]  # fmt: skip
Flag = Annotated[bool, Field(description="true or false")]
Factor = Annotated[float, Field(
    ge=0, le=FASTEST, allow_inf_nan=False,
    description=f"0 (as fast as possible) to {FASTEST:g}")]  # fmt: skip
Seed = Annotated[int, Field(ge=0, lt=2**63, description="a whole number of at least 0, below 2^63")]
Moment = Annotated[float, Field(
    ge=-LASTING, le=LASTING, allow_inf_nan=False, description="a time in s")]  # fmt: skip
Lasting = Annotated[float, Field(
    gt=0, le=LASTING, allow_inf_nan=False, description="a duration above 0 s")]  # fmt: skip

Wait = Annotated[float, Field(
    ge=0, le=LASTING, allow_inf_nan=False, description="a duration of at least 0 s")]  # fmt: skip


@dataclass(frozen=True, slots=True)
class Balance:
    """Balance by a law; on a real bench only if somebody holds the platform."""

    target: tuple[Length, Length, Length]  # m
    tolerance: tuple[Tolerance, Tolerance, Tolerance]  # m
    law: Text
    max_time: Lasting | None = None  # s; None: the law's own
    held: Flag = False
    keep: Wait = 0.0  # s, to keep the balance afterwards


@dataclass(frozen=True, slots=True)
class Stand:
    """Let masses stand still while a balance is kept, or move again."""

    on: Flag


@dataclass(frozen=True, slots=True)
class Identify:
    """Identify from the rows since the platform was let go."""

    method: Text


@dataclass(frozen=True, slots=True)
class Stop:
    """End the running procedure and halt every mass."""


@dataclass(frozen=True, slots=True)
class Jog:
    """Send one mass to a displacement from home."""

    mass: Text
    displacement: Length  # m


@dataclass(frozen=True, slots=True)
class Mark:
    """Note that something happened now."""

    text: Text


@dataclass(frozen=True, slots=True)
class Record:
    """Begin a recording, or end it."""

    on: Flag


@dataclass(frozen=True, slots=True)
class Pause:
    """Hold the simulated platform or the replay, or let it go on."""

    on: Flag


@dataclass(frozen=True, slots=True)
class Speed:
    """Let so many seconds of the bench pass in one."""

    factor: Factor


@dataclass(frozen=True, slots=True)
class Anew:
    """Take another simulated platform."""

    seed: Seed


@dataclass(frozen=True, slots=True)
class Replay:
    """Show a recording of the data folder; with no name go back to the simulated platform."""

    name: Text


@dataclass(frozen=True, slots=True)
class Seek:
    """Go to a time of the recording that is shown."""

    t: Moment  # s


Request = (
    Balance | Stand | Identify | Stop | Jog | Mark | Record | Pause | Speed | Anew | Replay | Seek
)
KINDS: tuple[type[Any], ...] = get_args(Request)
EXACT = ConfigDict(strict=True, revalidate_instances="always", hide_input_in_errors=True)


def _adapter(kind: type[Any]) -> TypeAdapter[Any]:
    kind.__pydantic_config__ = EXACT
    return TypeAdapter(kind)


SCHEMAS: Mapping[type[Any], TypeAdapter[Any]] = {kind: _adapter(kind) for kind in KINDS}


def sound(request: object) -> Request:
    """Return a request that keeps to the schema; InputError names what does not."""
    schema = SCHEMAS.get(type(request))
    if schema is None:
        raise InputError("request", type(request).__name__, "a request that this page offers")
    try:
        return schema.validate_python(request)
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        raise _sentence(type(request), first["loc"], first["input"]) from None


def _sentence(kind: type[object], place: tuple[int | str, ...], found: Any) -> InputError:
    name = str(place[0])
    alone = len(kind.__annotations__) == 1
    where = kind.__name__.lower() + ("" if alone else f", {name}")
    return InputError(where, shown(found), described(kind.__annotations__[name]))


def described(annotation: Any) -> str:
    """Return what a value may be, in words."""
    for field in getattr(annotation, "__metadata__", ()):
        return str(field.description)
    first, *others = get_args(annotation)
    number = f"{1 + len(others)} times " if len(others) > 1 else ""
    return number + described(first)


def shown(found: Any) -> str:
    """Return a found value within one line: a part of a large one, its kind where it has parts."""
    if isinstance(found, bool | float | str | None):
        text = ascii(found)
        return text if len(text) <= SHOWN else f"{text[:SHOWN]}..."
    if isinstance(found, int):
        return str(found) if found.bit_length() < 64 else f"a number of {found.bit_length()} bits"
    return f"a value of kind {type(found).__name__}"
