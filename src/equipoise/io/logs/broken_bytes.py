"""The last catch at a reader's door: a parser of broken bytes raises anything."""

from collections.abc import Generator
from contextlib import contextmanager

from equipoise.model.errors import EquipoiseError, InputError

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
        said = str(error)[:SHOWN] or type(error).__name__
        raise InputError(source, f"a broken {kind} ({said})", wanted) from error
