"""Errors of use, as exceptions that a person can act on.

Poor data is not an error but an outcome (see ``outcome``); these are for wrong use and bad input.
"""

from collections.abc import Generator, Sequence
from contextlib import contextmanager
from difflib import get_close_matches
from typing import Any

from equipoise.model.reasons.reason import Reason
from equipoise.model.units import MM


class EquipoiseError(Exception):
    """Anything the user can mend; its text says what was found, where, and what was wanted."""

    def __reduce__(self) -> tuple[Any, ...]:
        """Return how to make it anew in another process, whatever it was made from."""
        return _made_anew, (type(self), self.args, self.__dict__)


def _made_anew(
    kind: type[EquipoiseError], args: tuple[str, ...], state: dict[str, Any]
) -> EquipoiseError:
    error = kind.__new__(kind)
    error.args = args
    error.__dict__.update(state)
    return error


MEANT = "did you mean"


LONGEST = 1000  # characters of each part of a sentence (chosen: ten lines of a terminal)


def shortened(text: str, longest: int) -> str:
    """Return a text of so many characters at most; its end is kept, which says the most."""
    if len(text) <= longest:
        return text
    half = (longest - 5) // 2
    return f"{text[:half]} ... {text[-half:]}"


class InputError(EquipoiseError):
    """A file, key, column or option that cannot be used; ``wanted`` may ask what was meant."""

    def __init__(self, where: str, found: str, wanted: str) -> None:
        where, found, wanted = (shortened(text, LONGEST) for text in (where, found, wanted))
        end = wanted if wanted.startswith(MEANT) else f"wanted {wanted}"
        super().__init__(f"{where}: found {found}; {end}")
        self.where = where
        self.found = found
        self.wanted = wanted


class UnforeseenError(EquipoiseError):
    """A fault of this program, met while something was read or done; its cause is the error."""

    def __init__(self, where: str, error: BaseException) -> None:
        said = shortened(f"{type(error).__name__}: {error}", LONGEST)
        super().__init__(f"{where}: {said}")
        self.where = where


@contextmanager
def declared(where: str, wanted: str) -> Generator[None]:
    """Let nothing out that is no EquipoiseError, while something is read at ``where``.

    InputError where the memory is at its end or the file cannot be read; UnforeseenError for all
    that nobody thought of.
    """
    try:
        yield
    except EquipoiseError:
        raise
    except MemoryError as error:
        raise InputError(where, "more than this computer's memory holds", wanted) from error
    except OSError as error:
        raise InputError(where, error.strerror or str(error), wanted) from error
    except Exception as error:
        raise UnforeseenError(where, error) from error


class MoveRefused(EquipoiseError):
    """A mass was asked to go where it may not; nothing has moved."""

    def __init__(self, mass: str, at: float, requested: float, low: float, high: float) -> None:
        super().__init__(
            f"mass {mass}: at {at / MM:.3g} mm, requested {requested / MM:.3g} mm; "
            f"its travel is {low / MM:.3g} to {high / MM:.3g} mm; nothing was moved"
        )
        self.mass = mass
        self.requested = requested


class DriveRefused(EquipoiseError):
    """A device was asked for more than it may give; nothing was driven."""

    def __init__(self, device: str, requested: float, limit: float, unit: str) -> None:
        super().__init__(
            f"device {device}: requested {requested:.4g} {unit}; its limit is {limit:.4g} {unit}; "
            f"nothing was driven"
        )
        self.device = device
        self.requested = requested


class BenchStopped(EquipoiseError):
    """Every motor of a real bench was stopped, or may not be moved; the text says why.

    ``cause`` says it for programs, where an interlock is the cause.
    """

    def __init__(self, text: str, cause: Reason | None = None) -> None:
        super().__init__(text)
        self.cause = cause


class Implausible(EquipoiseError):
    """A record or a testbed that cannot be what it says it is; nothing was fitted.

    ``reasons`` say it for programs, each with what mends it.
    """

    def __init__(self, source: str, reasons: Sequence[Reason]) -> None:
        said = " ".join(reason.sentence for reason in reasons)
        super().__init__(f"{source}: nothing was fitted: {said} --force fits it anyway.")
        self.reasons = tuple(reasons)


def nearest(name: str, known: Sequence[str]) -> str:
    """Say which known name is meant, or list them: the whole of a 'wanted' text."""
    close = get_close_matches(name, known, n=1)
    return f"{MEANT} '{close[0]}'?" if close else "one of " + ", ".join(known)
