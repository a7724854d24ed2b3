"""Output that outlasts its terminal: an SSH session that drops must not cost the report.

What is written to a terminal that is gone fails with EIO, in whichever line happens to write next.
"""

import errno
import io
from typing import Any, TextIO

from equipoise.hardware.bench.stop_signals import HANG_UP


class LastingFile(io.FileIO):
    """A terminal; once it is gone, what is written there goes nowhere."""

    def write(self, data: Any, /) -> int:
        """Return how many bytes nobody has to write again."""
        try:
            return super().write(data)
        except OSError as error:
            if error.errno != errno.EIO:
                raise
            return memoryview(data).nbytes


def lasting(stream: TextIO) -> TextIO:
    """Return a stream to the same terminal; the same stream where it is to none that hangs up."""
    if HANG_UP is None or not stream.isatty():
        return stream
    terminal = io.BufferedWriter(LastingFile(stream.fileno(), "w", closefd=False))
    return io.TextIOWrapper(
        terminal, encoding=stream.encoding, errors=stream.errors, line_buffering=True
    )
