"""A run's entry for the logbook, and the files that belong to it."""

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from equipoise.app.report.run_record import Account
from equipoise.io.columns.native_columns import native_columns
from equipoise.io.documents.run_file import text_of_run
from equipoise.io.documents.run_folder import TESTBED
from equipoise.io.formats.csv_table import csv_text
from equipoise.io.testbed.testbed_file import text_of_testbed
from equipoise.model.estimate import COM, Parameter
from equipoise.model.logged_run import RUN, Kind, LoggedRun, Outcome
from equipoise.model.recording import Recording
from equipoise.model.verdict import Verdict, outcome_of

RECORDING = "recording.csv"


@dataclass(frozen=True, slots=True, eq=False)
class Kept:
    """What a logbook is told beside the report."""

    kind: Kind
    method: str
    bench: str
    recording: Recording | None  # what was read
    is_file: bool = False  # it came from a file, which stays where it is


def files_of(kept: Kept, account: Account, name: str) -> dict[str, str | bytes]:
    """Return testbed, recording and entry of a run; the entry comes last."""
    testbed = text_of_testbed(account.testbed)
    files: dict[str, str | bytes] = {TESTBED: testbed}
    if kept.recording is not None and not kept.is_file:
        files[RECORDING] = csv_text(native_columns(kept.recording))
    return files | {RUN: text_of_run(entry(kept, account, name, testbed))}


def hashes(files: Mapping[str, str | bytes]) -> dict[str, str]:
    """Return what tells testbed and recording from any other, for the report."""
    return {f"sha256 of {name}": sha256(files[name]) for name in (TESTBED, RECORDING)
            if name in files}  # fmt: skip


def sha256(text: str | bytes) -> str:
    """Return the hash of a file, hexadecimal."""
    return hashlib.sha256(text.encode() if isinstance(text, str) else text).hexdigest()


def entry(kept: Kept, account: Account, name: str, testbed: str) -> LoggedRun:
    """Return the entry."""
    estimate = account.estimate
    return LoggedRun(
        name=name,
        kind=kept.kind,
        made_at=account.origin["made at"],
        platform=account.testbed.name,
        configuration=sha256(testbed),
        method=kept.method,
        bench=kept.bench,
        outcome=outcome(account),
        sentence=sentence(account),
        parameters=() if estimate is None else estimate.parameters,
        standing=() if account.verdict is None else standing(account.verdict),
        temperature=temperature(kept.recording),
        provenance=dict(account.origin),
    )


def outcome(account: Account) -> Outcome:
    """Return in a word how a run ended."""
    verdict, estimate = account.verdict, account.estimate
    if verdict is None:
        return "usable" if estimate is not None and estimate.outcome.usable else "not usable"
    return outcome_of(verdict)


def sentence(account: Account) -> str:
    """Return in a sentence how a run ended."""
    if account.verdict is not None:
        return account.verdict.sentence
    return "" if account.estimate is None else account.estimate.outcome.sentence


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
