"""Around a library's parser: of broken bytes it raises anything, and that is no fault of ours.

A library's calls stand within, with as little else as can be: what our own code raises unforeseen
is to reach the reader's door as such (``model.errors.declared``), where it is a fault to be mended
and no broken file.
"""

from collections.abc import Generator, Iterable, Iterator
from contextlib import contextmanager
from typing import TypeVar

from equipoise.model.errors import EquipoiseError, InputError

T = TypeVar("T")
SHOWN = 200  # letters of what a parser says (chosen)


@contextmanager
def as_broken(source: str, kind: str, wanted: str) -> Generator[None]:
    """Turn whatever a parser raises into InputError; what is declared passes.

    ``kind``: what the file is; ``wanted``: what to do.
    """
    try:
        yield
    except EquipoiseError:
        raise
    except Exception as error:
        raise unreadable(source, kind, wanted, error) from error


@contextmanager
def as_value_error() -> Generator[None]:
    """Turn whatever a parser raises of one piece of a file into ValueError: it is left out."""
    try:
        yield
    except EquipoiseError:
        raise
    except Exception as error:
        raise ValueError(said_by(error)) from error


def each_unbroken(items: Iterable[T], source: str, kind: str, wanted: str) -> Iterator[T]:
    """Yield what a parser finds one by one; what is done with it stands outside of its guard."""
    iterator = iter(items)
    while True:
        with as_broken(source, kind, wanted):
            try:
                item = next(iterator)
            except StopIteration:
                return
        yield item


def unreadable(source: str, kind: str, wanted: str, error: Exception) -> InputError:
    """Return the sentence on a file that its parser cannot read."""
    return InputError(source, f"a {kind} that cannot be read ({said_by(error)})", wanted)


def said_by(error: Exception) -> str:
    """Return what an error says, shortened; its kind where it says nothing."""
    return str(error)[:SHOWN] or type(error).__name__
