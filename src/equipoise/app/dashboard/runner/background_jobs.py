"""Fits and reports take seconds: each is made in a process of its own, and the view goes on."""

import signal
from collections.abc import Iterator
from dataclasses import dataclass, replace
from multiprocessing import get_context
from multiprocessing.connection import Connection as Pipe
from pathlib import Path
from typing import Any

from equipoise.app.console.crash_file import crash_of
from equipoise.app.logbook.run_folder import name_of, own_folder
from equipoise.app.report.run_record import Output
from equipoise.app.report.write import write_output
from equipoise.app.runs.balancing import Balancing
from equipoise.app.runs.recordings.identification import run
from equipoise.app.runs.waiting import passing_on
from equipoise.app.views import identify_views
from equipoise.app.views.balancing import balance_views
from equipoise.model.errors import EquipoiseError
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed
from equipoise.procedure.identification.identify import IdentifyOptions


@dataclass(frozen=True, slots=True, eq=False)
class Keep:
    """Write the report of a balancing into a folder of its own."""

    done: Balancing


@dataclass(frozen=True, slots=True, eq=False)
class Fit:
    """Identify from a recording, and write the report."""

    recording: Recording
    testbed: Testbed
    method: str


COMMAND = ("dashboard",)  # whose processes these are, for a crash file
Task = Keep | Fit
News = tuple[str, Any]  # "step": Step; "kept": name of the run's folder; "failed": a sentence


class Job:
    """A task in its process."""

    def __init__(self, task: Task) -> None:
        context = get_context("spawn")
        self._pipe, remote = context.Pipe(duplex=False)
        self._process = context.Process(target=carry_out, args=(remote, task), daemon=True)
        self._process.start()
        remote.close()
        self.over = False

    def news(self) -> Iterator[News]:
        """Yield what it has reported since the last call."""
        try:
            while not self.over and self._pipe.poll():
                yield self._pipe.recv()
        except (EOFError, OSError):
            self.end()

    def end(self) -> None:
        """End it, whatever it is doing."""
        self.over = True
        self._process.kill()
        self._process.join()
        self._pipe.close()


def carry_out(pipe: Pipe, task: Task) -> None:
    """Carry out a task and report on it; the process's whole life.

    The runner ignores signals to stop; a task has nothing to put right and must not outlive it.
    """
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    try:
        kept = _keep(task) if isinstance(task, Keep) else _fit(task, pipe)
        pipe.send(("kept", kept))
    except EquipoiseError as error:
        pipe.send(("failed", str(error)))
    except Exception as error:
        pipe.send(("failed", crash_of(error, COMMAND).sentence))


def _keep(task: Keep) -> str | None:
    return _written(balance_views.output_of(task.done), task.done.testbed)


def _fit(task: Fit, pipe: Pipe) -> str | None:
    each = passing_on(lambda step: pipe.send(("step", step)))
    done = run(task.recording, task.testbed, IdentifyOptions(task.method), each)
    # The live rows are in no file yet: they are kept with the run.
    logged = identify_views.logged_of(done, is_file=False)
    return _written(replace(identify_views.output_of(done), logged=logged), task.testbed)


def _written(output: Output, testbed: Testbed) -> str | None:
    """Write a run into a folder of its own, and return its name; None where none is kept."""
    assert output.logged is not None
    folder: Path | None = own_folder(output.logged.kind, testbed.name)
    if folder is None:
        return None
    write_output(output, folder)
    return name_of(folder)
