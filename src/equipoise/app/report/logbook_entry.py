"""A run's entry for the logbook, and the files that belong to it."""

import hashlib
from collections.abc import Mapping

import numpy as np

from equipoise.app.report.run_record import Logged, RunRecord
from equipoise.app.text.escaping import for_json
from equipoise.io.columns.native_columns import native_columns
from equipoise.io.documents.run_file import text_of_run
from equipoise.io.documents.run_folder import RECORDING, TESTBED
from equipoise.io.formats.csv_table import csv_text
from equipoise.io.testbed.testbed_file import text_of_testbed
from equipoise.model.estimate import COM, Parameter
from equipoise.model.logged_run import RUN, Ending, LoggedRun, Usability
from equipoise.model.recording import Recording
from equipoise.model.verdict import Verdict


def files_of(logged: Logged, record: RunRecord, name: str) -> dict[str, str | bytes]:
    """Return testbed, recording and entry of a run; the entry comes last."""
    testbed = text_of_testbed(record.testbed)
    files: dict[str, str | bytes] = {TESTBED: testbed}
    if logged.recording is not None and not logged.is_file:
        files[RECORDING] = csv_text(native_columns(logged.recording))
    return files | {RUN: for_json(text_of_run(entry(logged, record, name, testbed)))}


def hashes(files: Mapping[str, str | bytes]) -> dict[str, str]:
    """Return what identifies testbed and recording, for the report."""
    return {f"sha256 of {name}": sha256(files[name]) for name in (TESTBED, RECORDING)
            if name in files}  # fmt: skip


def sha256(text: str | bytes) -> str:
    """Return the hash of a file, hexadecimal."""
    return hashlib.sha256(text.encode() if isinstance(text, str) else text).hexdigest()


def entry(logged: Logged, record: RunRecord, name: str, testbed: str) -> LoggedRun:
    """Return the entry."""
    estimate, verdict = logged.estimate, logged.verdict
    return LoggedRun(
        name=name,
        kind=logged.kind,
        made_at=record.origin["made at"],
        platform=record.testbed.name,
        configuration=sha256(testbed),
        method=logged.method,
        bench=logged.bench,
        outcome=outcome(logged),
        sentence=sentence(logged),
        parameters=() if estimate is None else estimate.parameters,
        standing=() if verdict is None else standing(verdict),
        temperature=temperature(logged.recording),
        provenance=dict(record.origin),
    )


def outcome(logged: Logged) -> Ending:
    """Return how a run ended."""
    verdict, estimate = logged.verdict, logged.estimate
    if verdict is None:
        usable = estimate is not None and estimate.outcome.usable
        return Usability.USABLE if usable else Usability.NOT_USABLE
    return verdict.outcome


def sentence(logged: Logged) -> str:
    """Return in a sentence how a run ended."""
    if logged.verdict is not None:
        return logged.verdict.sentence
    return "" if logged.estimate is None else logged.estimate.outcome.sentence


def standing(verdict: Verdict) -> tuple[Parameter, ...]:
    """Return the centre of mass that a verdict is about, masses as they stand."""
    if verdict.com is None:
        return ()
    sd = np.full(3, np.nan) if verdict.sd is None else verdict.sd
    numbers = zip(COM, verdict.com, sd, strict=True)
    return tuple(Parameter(name, "m", float(value), float(s)) for name, value, s in numbers)


def temperature(recording: Recording | None) -> float | None:
    """Return the mean of what was recorded, degC."""
    rows = None if recording is None else recording.temperature
    return None if rows is None or not len(rows) else float(np.mean(rows.values))
