"""What reading a file takes: a process of its own reads it, and says how large it became."""

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
