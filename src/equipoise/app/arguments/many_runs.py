"""Where many runs are carried out, as options have it."""

from equipoise.app.arguments.checks import positive
from equipoise.app.engine.choice import LOCAL, engine_of
from equipoise.app.engine.pool import Engine
from equipoise.model.errors import InputError


def engine_from(on: str, workers: int) -> Engine:
    """Return the engine of ``--on`` and ``--workers``; InputError for one that is unknown."""
    return engine_of(on, int(positive("--workers", workers)))


def check_one_piece(on: str, workers: int, wanted: str) -> None:
    """Raise InputError for an engine where there is nothing to spread over it."""
    if (on, workers) != (LOCAL, 1):
        option = "--workers" if on == LOCAL else "--on"
        raise InputError(option, "one piece of work", wanted)
