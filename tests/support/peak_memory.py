"""What reading a file takes: how large a process became, this one or one of its own."""

import json
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

# The high-water mark of the program itself: ``ru_maxrss`` begins with that of whoever started it.
PROGRAM = """
import json, pathlib, sys
from equipoise.io.columns.read_options import ReadOptions
from equipoise.io.recording.recording_file import read_recording
from equipoise.model.errors import EquipoiseError
try:
    read_recording(sys.argv[1])
    said = ""
except EquipoiseError as error:
    said = str(error)
(peak,) = (line.split()[1] for line in open("/proc/self/status") if line.startswith("VmHWM"))
print(json.dumps([said, int(peak) / 1000]))
"""


class Reading(NamedTuple):
    """How a file was read."""

    said: str  # the error; nothing if there was none
    peak_mb: float


def reading_of(path: Path) -> Reading:
    """Return how a process of its own reads a file."""
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM, str(path)], capture_output=True, text=True, check=True
    )
    return Reading(*json.loads(done.stdout))


def forget_peak() -> None:
    """Let the high-water mark of this process begin at what it has now."""
    Path("/proc/self/clear_refs").write_text("5", encoding="ascii")


def peak_mb() -> float:
    """Return how large this process has been since then."""
    lines = Path("/proc/self/status").read_text(encoding="ascii").splitlines()
    (peak,) = (line.split()[1] for line in lines if line.startswith("VmHWM"))
    return int(peak) / 1000
