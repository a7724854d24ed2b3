"""A guise of a known motion as a file, and the right answer to it."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType

from tests.support.recordings.recorded_motion import Motion

Write = Callable[[Motion, Path], Path]  # the motion as a file in a folder
ROUNDED, ROUNDED_RATE, STAMPED = 2e-6, 1e-6, 1e-6  # rad, rad/s, s: files have six decimals


@dataclass(frozen=True, slots=True)
class Reads:
    """The motion comes back, up to rounding and to what nobody can know."""

    by: str = "import"  # or 'inspect', where the header says what columns are
    lost: tuple[int, ...] = ()  # rows of the motion that are left out
    rate_lost: tuple[int, ...] | None = None  # those of the gyro; None: the same
    said: str = ""  # pattern of what is printed
    inspected: str = "--columns"  # pattern of what `inspect` says where `import` is needed
    sensors: tuple[str, ...] = ("attitude", "rate")
    turn: float = ROUNDED  # rad
    rate: float = ROUNDED_RATE  # rad/s
    time: float = STAMPED  # s
    renamed: bool = False  # which level axis of the body is x nobody can know
    options: tuple[str, ...] = ()  # that a person adds


@dataclass(frozen=True, slots=True)
class Refused:
    """No recording, but a sentence: patterns of cause and of remedy."""

    cause: str
    remedy: str
    by: tuple[str, ...] = ("inspect", "import")
    options: tuple[str, ...] = ()


Answer = Reads | Refused


@dataclass(frozen=True, slots=True)
class Variant:
    """A guise and its answer."""

    name: str
    write: Write
    answer: Answer


def answered(answer: Answer) -> Callable[[Write], Variant]:
    """Make a variant of how it is written."""
    return lambda write: Variant(write.__name__, write, answer)


def variants_of(*modules: ModuleType) -> list[Variant]:
    """Return the variants of modules, in the order in which they are written."""
    return [each for m in modules for each in vars(m).values() if isinstance(each, Variant)]
