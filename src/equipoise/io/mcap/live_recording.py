"""A recording written to MCAP as it arrives, so that a crash or a power cut leaves all rows so far.

The file is a row of chunks, each with its own checksum; what follows the last whole chunk is lost
and nothing before it. A chunk is ended, and given to the disk, every half second and with every
event. An index of the chunks would have to be kept in memory until the end (0.3 kB a chunk, 10 % of
a process in 8 h), so there is none: readers go through the file, or ``equipoise repair`` writes one
that has it. Messages are those of ``log_messages``. In front stand the testbed file as it was
(attachment ``testbed.toml``) and the metadata ``equipoise``: versions, the drivers, the start.

Format: MCAP, public specification (mcap.dev/spec), chunks compressed by Zstandard.
"""

import contextlib
import platform
from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import UTC, datetime, timedelta
from importlib.metadata import version
from pathlib import Path
from typing import Any

from equipoise.io.files.append_file import DurableFile
from equipoise.io.formats.optional_libraries import log_library
from equipoise.io.mcap.log_messages import Topics
from equipoise.model.errors import EquipoiseError
from equipoise.model.recording import Recording
from equipoise.model.version import __version__

EVERY = 0.5  # s, chosen: half of the second that a crash may cost; the rest is for a slow system
METADATA, TESTBED_FILE, ZERO_KEY = "equipoise", "testbed.toml", "zero_ns"
DRIVER_KEY = "driver "  # in front of a driver's name


class RecordingStopped(EquipoiseError):
    """The file cannot take more; what was written before is whole and can be read."""

    def __init__(self, path: str, why: str) -> None:
        super().__init__(
            f"{path}: recording stopped ({why}); what was written before is kept; make room on "
            "the disk and begin a new recording"
        )


@dataclass(frozen=True, slots=True)
class Opening:
    """What a recording begins with."""

    zero_ns: int  # UTC at bench time zero, ns since 1970
    testbed: str = ""  # text of the testbed's file
    drivers: Mapping[str, str] = field(default_factory=dict[str, str])  # a device: its driver


class LiveRecording(contextlib.AbstractContextManager["LiveRecording"]):
    """A recording that grows; every method raises RecordingStopped once the file takes no more."""

    def __init__(self, path: str | Path, opening: Opening, indexed: bool = False) -> None:
        """Begin the file; InputError if it cannot be, or holds something already.

        ``indexed``: with an index, for a file that is written in one go.
        """
        self._path = str(path)
        foxglove = log_library("foxglove", self._path)
        mcap = log_library("foxglove.mcap", self._path)
        context = foxglove.Context()
        # A chunk is kept in memory and written in one go: no half-filled header in the file.
        options = mcap.MCAPWriteOptions(
            disable_seeking=True, compression_threads=0,
            emit_message_indexes=indexed, emit_chunk_indexes=indexed,
        )  # fmt: skip
        self._topics = Topics(context, opening.zero_ns, self._path)
        self._file = DurableFile(path)
        self._flushed: float | None = None
        self._writer: Any = None
        try:
            self._writer = self._guarded(
                lambda: foxglove.open_mcap(self._file, context=context, writer_options=options)
            )
            self._guarded(lambda: self._open(opening))
        except RecordingStopped:
            self._end()
            raise

    def rows(self, recording: Recording) -> None:
        """Append the rows of every channel."""
        self._guarded(lambda: self._topics.rows(recording))

    def event(self, t: float, kind: str, sentence: str, data: Mapping[str, Any]) -> None:
        """Append what happened at a time (s) and flush at once: a command, an interlock, a note."""
        self._guarded(lambda: self._topics.event(t, kind, sentence, data))
        self._flush(t)

    def turn(self, t: float) -> None:
        """Flush if it is time (s) to; asked many times a second."""
        if self._flushed is None or not 0 <= t - self._flushed < EVERY:
            self._flush(t)

    def close(self) -> None:
        """End the file, with its index if it has one."""
        self._end()
        self._guarded(lambda: None)  # says what failed, the last wait for the disk included

    def __exit__(self, *raised: object) -> None:
        """Close; an error that is on its way is not hidden by another."""
        with contextlib.suppress(*[RecordingStopped] * any(raised)):
            self.close()

    def _open(self, opening: Opening) -> None:
        start = datetime(1970, 1, 1, tzinfo=UTC) + timedelta(microseconds=opening.zero_ns // 1000)
        message = {
            "equipoise": __version__,
            "python": platform.python_version(),
            "system": platform.platform(),
            "foxglove-sdk": version("foxglove-sdk"),
            "start_utc": start.isoformat(),
            ZERO_KEY: str(opening.zero_ns),
            **{f"{DRIVER_KEY}{name}": driver for name, driver in opening.drivers.items()},
        }
        self._writer.write_metadata(METADATA, message)
        if opening.testbed:
            self._writer.attach(
                log_time=opening.zero_ns, create_time=opening.zero_ns, name=TESTBED_FILE,
                media_type="application/toml", data=opening.testbed.encode(),
            )  # fmt: skip
        self._writer.flush()

    def _end(self) -> None:
        """Close the file, whether it failed or not."""
        if self._writer is not None:
            with contextlib.suppress(RuntimeError):  # what failed is known to the file
                self._writer.close()
        self._file.close()

    def _flush(self, t: float) -> None:
        self._flushed = t
        self._guarded(self._writer.flush)

    def _guarded(self, work: Any) -> Any:
        """Return what the work gives; a file that failed, then or before, stops the recording.

        The library reports a failed write as an error without a cause, or only on stderr.
        """
        done = None
        if self._file.failure is None:
            try:
                done = work()
            except RuntimeError:
                if self._file.failure is None:
                    raise
        if self._file.failure is not None:
            why = self._file.failure.strerror or str(self._file.failure)
            raise RecordingStopped(self._path, why) from self._file.failure
        return done
