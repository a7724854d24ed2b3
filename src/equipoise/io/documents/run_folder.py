"""What the folder of a run holds, by the names of its files."""

import contextlib
import os
from pathlib import Path

from equipoise.io.files.source_file import read_text
from equipoise.model.errors import InputError

TESTBED = "testbed.toml"
RECORDING = "recording.csv"  # where the run made it; one of a file stays where it is
A_RUN = "the folder of a run"  # what is wanted where a file of one is missing


def read_configuration(folder: Path) -> str:
    """Return the text of the testbed that a run was made with; empty if there is none."""
    try:
        return read_text(folder / TESTBED, A_RUN)
    except InputError:
        return ""


def announce(folder: Path) -> None:
    """Set the time of the folder around a run's, by which a logbook notices a run written anew."""
    with contextlib.suppress(OSError):  # who may not do so has no logbook there
        os.utime(folder.absolute().parent)
