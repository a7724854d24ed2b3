"""A recording written to MCAP as it arrives, so that a crash or a power cut leaves all rows so far.

The file is a row of chunks, each with its own checksum; what follows the last whole chunk is lost
and nothing before it. A chunk is ended, and given to the disk, every half second and with every
event. When the file is closed, its index is written (``mcap_writer``). A file that was never
closed has neither index nor summary, and readers go through it; a summary without index would
tell them that there is nothing to read. Messages are those of ``log_messages``. In front stand the
testbed file as it was (attachment ``testbed.toml``) and the metadata ``equipoise``: versions, the
drivers, the start.

Format: MCAP, public specification (mcap.dev/spec), chunks compressed by Zstandard.
"""

import contextlib
import platform
from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

from equipoise.io.files.append_file import DurableFile
from equipoise.io.formats.optional_libraries import log_library
from equipoise.io.mcap.log_messages import STREAMS, Topics
from equipoise.io.mcap.mcap_writer import McapWriter
from equipoise.model.errors import EquipoiseError
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed
from equipoise.model.version import __version__

EVERY = 0.5  # s, chosen: half of the second that a crash may cost; the rest is for a slow system
METADATA, TESTBED_FILE, ZERO_KEY = "equipoise", "testbed.toml", "zero_ns"
DRIVER_KEY = "driver "  # in front of a driver's name


class RecordingStopped(EquipoiseError):
    """The file cannot take more; what was written before is whole and can be read."""

    def __init__(self, path: str, why: str, kept: float | None = None) -> None:
        """Say up to which bench time (s) rows are in the file; None: none are."""
        until = "no row is kept" if kept is None else f"what had come by {kept:.2f} s is kept"
        super().__init__(
            f"{path}: recording stopped ({why}); {until}; make room on the disk and begin a new "
            "recording"
        )


@dataclass(frozen=True, slots=True)
class Opening:
    """What a recording begins with."""

    zero_ns: int  # UTC at bench time zero, ns since 1970
    testbed: str = ""  # text of the testbed's file
    platform: Testbed | None = None  # what it tells of topics and of the scene
    drivers: Mapping[str, str] = field(default_factory=dict[str, str])  # a device: its driver


class LiveRecording(contextlib.AbstractContextManager["LiveRecording"]):
    """A recording that grows; every method raises RecordingStopped once the file takes no more."""

    def __init__(self, path: str | Path, opening: Opening) -> None:
        """Begin the file; InputError if it cannot be, or holds something already."""
        self._path = str(path)
        self._file = DurableFile(path)
        self._flushed: float | None = None
        self._kept: float | None = None  # s, up to which the system has the rows
        try:
            self._writer, self._topics = self._guarded(lambda: self._begun(opening))
        except EquipoiseError:
            self._file.close()
            raise

    def rows(self, recording: Recording) -> None:
        """Append the rows of every channel."""
        self._guarded(lambda: self._topics.rows(recording))

    def event(self, t: float, kind: str, sentence: str, data: Mapping[str, Any]) -> None:
        """Append what happened at a time (s); flush at once, but for what comes in a stream."""
        self._guarded(lambda: self._topics.event(t, kind, sentence, data))
        if kind in STREAMS:
            self.turn(t)
        else:
            self._flush(t)

    def turn(self, t: float) -> None:
        """Flush if it is time (s) to; asked many times a second."""
        if self._flushed is None or not 0 <= t - self._flushed < EVERY:
            self._flush(t)

    def close(self) -> None:
        """End the file, with its index."""
        if not self._file.closed:
            with contextlib.suppress(RecordingStopped):
                self._guarded(lambda: self._writer.finish(self._path))
            self._file.close()
        self._guarded(lambda: None)  # says what failed, the last wait for the disk included

    def __exit__(self, *raised: object) -> None:
        """Close; an error that is on its way is not hidden by another."""
        with contextlib.suppress(*[RecordingStopped] * any(raised)):
            self.close()

    def _begun(self, opening: Opening) -> tuple[McapWriter, Topics]:
        """Write what stands in front of the first row."""
        from importlib.metadata import version  # takes as long as all else that a reader loads

        log_library("foxglove", self._path)  # before its version is sought
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
        writer = McapWriter(self._file.write, self._path)
        writer.metadata(METADATA, message)
        if opening.testbed:
            text = opening.testbed.encode()
            writer.attach(TESTBED_FILE, "application/toml", opening.zero_ns, text)
        topics = Topics(writer.channel, opening.zero_ns, self._path, opening.platform)
        self._file.flush()
        return writer, topics

    def _flush(self, t: float) -> None:
        self._flushed = t
        self._guarded(self._writer.flush)
        self._kept = t
        self._file.flush()

    def _guarded(self, work: Any) -> Any:
        """Return what the work gives; a file that failed, then or before, stops the recording."""
        done = None
        if self._file.failure is None:
            try:
                done = work()
            except OSError:
                if self._file.failure is None:
                    raise
        if self._file.failure is not None:
            why = self._file.failure.strerror or str(self._file.failure)
            raise RecordingStopped(self._path, why, self._kept) from self._file.failure
        return done
