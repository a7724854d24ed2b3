"""Where many runs are carried out, as options have it."""

from equipoise.app.arguments.checks import positive
from equipoise.app.arguments.options import ALONE, Spreading
from equipoise.app.engine.choice import LOCAL, engine_of
from equipoise.app.engine.pool import Engine
from equipoise.model.errors import InputError


def engine_from(spreading: Spreading) -> Engine:
    """Return the engine of ``--on`` and ``--workers``; InputError for one that is unknown."""
    return engine_of(spreading.on, int(positive("--workers", spreading.workers)))


def check_one_piece(spreading: Spreading, wanted: str) -> None:
    """Raise InputError for an engine where there is nothing to spread over it."""
    if spreading != ALONE:
        option = "--workers" if spreading.on == LOCAL else "--on"
        raise InputError(option, "one piece of work", wanted)
