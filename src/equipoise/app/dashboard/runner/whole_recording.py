"""A recording as the viewer gets it: all its rows, estimates and steps, before the page opens."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from equipoise.app.arguments.recorded_run import RecordedRun
from equipoise.app.dashboard.runner.benches import replayed
from equipoise.app.dashboard.runner.display import Display
from equipoise.app.dashboard.runner.documents import (
    Document,
    about,
    line_document,
    state_document,
)
from equipoise.app.dashboard.runner.outbox import Post
from equipoise.app.dashboard.runner.recorder import Recorder
from equipoise.model.errors import InputError
from equipoise.model.recorded_step import RecordedStep
from equipoise.model.recording import Recording, rows_between
from equipoise.model.units import MEGABYTE

SLICE = 1.0  # s, chosen: the covariance behind the bands of torque and energy is one for each
MOST = 400 * MEGABYTE  # of rows, chosen: what a browser's page holds; some hours at 100 Hz


@dataclass(frozen=True, slots=True, eq=False)
class WholeRecording:
    """What the page draws from: a document, and the rows of all series as one message."""

    title: str
    document: Document  # "about", "steps" and "state", each as the live page gets it
    rows: bytes


def whole_recording(run: RecordedRun) -> WholeRecording:
    """Return all that is shown of a recorded run.

    Raises InputError where that is more than a page can hold.
    """
    rows, notes = list[bytes](), list[str]()
    post = Post(lambda _kind, what: rows.append(what))
    display = Display(run.testbed, post, Recorder(Path()), notes.append)
    for t, part in _slices(run.recording):
        display.shown_only(t, part)
    post.flush()
    _check_size(run, sum(map(len, rows)))
    _, last = run.recording.span
    noted = (RecordedStep("note", last, note) for note in (*run.recording.notes, *notes))
    steps = sorted((*run.steps, *noted), key=lambda step: step.time)
    station = replayed(run.testbed, run.recording, run.title)
    document: dict[str, Any] = {
        "about": about(station, 1, "replay"),
        "steps": [_line(i, step) for i, step in enumerate(steps)],
        "state": state_document(station, None, None, phase="replay"),
    }
    return WholeRecording(run.title, document, b"".join(rows))


def _line(index: int, step: RecordedStep) -> Document:
    return line_document(index, step.kind, step.time, step.sentence, step.outcome)


def _slices(recording: Recording) -> Iterator[tuple[float, Recording]]:
    """Yield the recording part by part, each with the time of its end (s)."""
    first, last = recording.span
    since = -np.inf
    for until in (*np.arange(first + SLICE, last, SLICE).tolist(), np.inf):
        yield min(until, last), rows_between(recording, since, until)
        since = until


def _check_size(run: RecordedRun, size: int) -> None:
    if size > MOST:
        found = f"{size / MEGABYTE:.0f} MB of rows"
        wanted = f"at most {MOST / MEGABYTE:.0f} MB: a part of it, by --from-s and --to-s"
        raise InputError(run.title, found, wanted)
