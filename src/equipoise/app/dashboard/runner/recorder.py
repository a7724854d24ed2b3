"""A recording that a person begins and ends while the bench goes on."""

from pathlib import Path
from time import time_ns

from equipoise.app.dashboard.protocol.data_folder import new_recording
from equipoise.hardware.bench.real_bench import RealBench
from equipoise.io.files.atomic_file import WRITABLE
from equipoise.io.formats.clock_units import nanoseconds
from equipoise.io.mcap.live_recording import LiveRecording, Opening
from equipoise.io.testbed.testbed_file import text_of_testbed
from equipoise.model.bench import Bench
from equipoise.model.errors import InputError
from equipoise.model.recording import Recording


class Recorder:
    """Writes rows while it is on."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._file: LiveRecording | None = None
        self.name: str | None = None  # in the folder; None: nothing is recorded

    def begin(self, bench: Bench) -> None:
        """Begin a new file; EquipoiseError where that cannot be."""
        if self._file is None:
            path, bed = self._path(bench), bench.testbed
            opening = Opening(_begun_ns(bench), text_of_testbed(bed), bed)
            self._file = LiveRecording(path, opening)
            self.name = path.relative_to(self._folder).as_posix()

    def rows(self, t: float, rows: Recording) -> None:
        """Write rows, if it is on."""
        if self._file is not None:
            self._file.rows(rows)
            self._file.turn(t)

    def event(self, t: float, kind: str, sentence: str) -> None:
        """Write what happened at bench time t (s), if it is on."""
        if self._file is not None:
            self._file.event(t, kind, sentence, {})

    def end(self) -> None:
        """End the file, if it is on."""
        file, self._file, self.name = self._file, None, None
        if file is not None:
            file.close()

    def _path(self, bench: Bench) -> Path:
        try:
            return new_recording(self._folder, bench.testbed.name)
        except OSError as error:
            raise InputError(str(self._folder), error.strerror or str(error), WRITABLE) from error


def _begun_ns(bench: Bench) -> int:
    """Return UTC at bench time zero, ns: a real bench's own; of any other, as if it is now."""
    if isinstance(bench, RealBench):
        return bench.begun_ns
    return time_ns() - nanoseconds(bench.time)
