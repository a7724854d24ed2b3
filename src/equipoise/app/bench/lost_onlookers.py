"""What a person at the terminal reads of an onlooker that failed."""

from contextlib import suppress

from equipoise.app.console.terminal import complain
from equipoise.hardware.bench.onlookers import why_lost


def complain_of(name: str, error: Exception) -> None:
    """Report an onlooker that failed, where the terminal can still take it."""
    with suppress(OSError):
        complain(why_lost(name, error))
