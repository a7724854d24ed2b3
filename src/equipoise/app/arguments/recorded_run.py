"""A recording, or the folder of a run, resolved to what is shown of it."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from equipoise.app.arguments.inputs import fitted, read_options, recording_of, testbed_from
from equipoise.io.documents.run_file import read_run
from equipoise.io.documents.run_folder import RECORDING, TESTBED
from equipoise.io.documents.run_steps import read_steps
from equipoise.io.recording.recording_events import read_events
from equipoise.model.errors import InputError
from equipoise.model.logged_run import RUN
from equipoise.model.recorded_step import RecordedStep
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed

if TYPE_CHECKING:
    from equipoise.app.arguments.options import Reading


@dataclass(frozen=True, slots=True, eq=False)
class RecordedRun:
    """What was recorded of a platform, and what was done meanwhile."""

    testbed: Testbed
    recording: Recording
    title: str
    steps: tuple[RecordedStep, ...]


def is_recorded(path: Path) -> bool:
    """Say whether a path is the folder of a run, or a file that is no testbed."""
    return path.is_dir() or (path.is_file() and path.suffix.lower() != ".toml")


def files_shown(shown: str, testbed: str | None) -> tuple[str, str]:
    """Return the recording and the testbed that a recording or the folder of a run stands for.

    Raises InputError for a recording without a testbed, and for a run that read a file of another
    folder.
    """
    folder = Path(shown)
    if not is_run(folder):
        if testbed is None:
            raise InputError("--testbed", "none", f"the testbed of which {shown} is a recording")
        return shown, testbed
    if not (folder / RECORDING).is_file():
        found = f"no {RECORDING}: the run has read a file that stands elsewhere"
        raise InputError(shown, found, f"that file, with --testbed {folder / TESTBED}")
    return str(folder / RECORDING), testbed or str(folder / TESTBED)


def is_run(path: Path) -> bool:
    """Say whether a path is the folder of a run; a bag of ROS 2 is a folder, too."""
    return (path / RUN).is_file() or (path / TESTBED).is_file()


def recorded_run(shown: str, testbed: str | None, reading: "Reading") -> RecordedRun:
    """Return a recording with its testbed and steps: the whole, or the part that is asked for."""
    file, bed_file = files_shown(shown, testbed)
    bed = testbed_from(bed_file)
    recording = fitted(recording_of(file, reading), bed)
    steps = _steps_of(Path(shown), recording.span[1])
    title = f"{Path(shown).absolute().name}, {bed.name}"
    return RecordedRun(bed, recording, title, steps or read_events(file, read_options(reading)))


def _steps_of(folder: Path, end: float) -> tuple[RecordedStep, ...]:
    """Return the steps of a run; of an identification, its result at the recording's end (s)."""
    if not (folder / RUN).is_file():
        return ()
    run = read_run(folder)
    return read_steps(folder) or (RecordedStep(run.kind, end, run.sentence),)
