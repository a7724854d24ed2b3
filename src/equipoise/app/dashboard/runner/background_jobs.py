"""Fits and reports take seconds: each is made in a process of its own, and the view goes on."""

from collections.abc import Iterator
from dataclasses import dataclass
from multiprocessing import get_context
from multiprocessing.connection import Connection as Pipe
from pathlib import Path
from typing import Any

from equipoise.app.logbook.run_folder import own_folder
from equipoise.app.report.logbook_entry import Kept
from equipoise.app.report.run_record import Account
from equipoise.app.report.write import write_run
from equipoise.app.runs.balancing import Balancing
from equipoise.app.runs.identification import Identification
from equipoise.app.text.json_document import View
from equipoise.app.views import balance_views, identify_views
from equipoise.assessment.findings.record_findings import findings
from equipoise.model.errors import EquipoiseError
from equipoise.model.recording import Recording
from equipoise.model.step import Step
from equipoise.model.testbed import Testbed
from equipoise.procedure.identification.identify import IdentifyOptions, identify
from equipoise.procedure.identification.record_courses import (
    balancing_courses,
    identification_courses,
)


@dataclass(frozen=True, slots=True, eq=False)
class Keep:
    """Write the report of a balancing into a folder of its own."""

    done: Balancing
    law: str
    seed: int


@dataclass(frozen=True, slots=True, eq=False)
class Fit:
    """Identify from a recording, and write the report."""

    recording: Recording
    testbed: Testbed
    method: str


Task = Keep | Fit
News = tuple[str, Any]  # "step": Step; "kept": name of the run's folder; "failed": a sentence


class Job:
    """A task in its process."""

    def __init__(self, task: Task) -> None:
        context = get_context("spawn")
        self._pipe, outlying = context.Pipe(duplex=False)
        self._process = context.Process(target=carry_out, args=(outlying, task), daemon=True)
        self._process.start()
        outlying.close()
        self.over = False

    def news(self) -> Iterator[News]:
        """Yield what has been told since this was last asked."""
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
    """Carry out a task and tell of it; the process's whole life."""
    try:
        kept = _keep(task) if isinstance(task, Keep) else _fit(task, pipe)
        pipe.send(("kept", kept))
    except EquipoiseError as error:
        pipe.send(("failed", str(error)))
    except Exception as error:
        pipe.send(("failed", f"{type(error).__name__}: {error}"))


def _keep(task: Keep) -> str | None:
    done = task.done
    courses = balancing_courses(done.recording, done.testbed, done.estimate, done.steps)
    account = balance_views.account_of(done, task.seed, courses)
    document = balance_views.document_of(done, task.seed)
    return _written(account, document, "balance", balance_views.kept_of(done, task.law))


def _fit(task: Fit, pipe: Pipe) -> str | None:
    steps: list[Step] = []
    options = IdentifyOptions(task.method)
    for step in identify(task.recording, task.testbed, options):
        pipe.send(("step", step))
        steps.append(step)
    found = findings(task.recording, task.testbed)
    done = Identification(task.testbed, task.recording, found, steps)
    # What was seen live is in no file yet: it is kept with the run.
    kept = Kept("identify", done.estimate.method, "recording", task.recording)
    courses = identification_courses(done.recording, done.testbed, done.steps)
    account, document = identify_views.account_of(done, courses), identify_views.document_of(done)
    return _written(account, document, "estimate", kept)


def _written(account: Account, document: View, name: str, kept: Kept) -> str | None:
    """Write a run into a folder of its own, and return its name; None where none is kept."""
    folder: Path | None = own_folder(kept.kind, account.testbed.name)
    if folder is None:
        return None
    write_run(account, document, name, kept, folder)
    return folder.name
