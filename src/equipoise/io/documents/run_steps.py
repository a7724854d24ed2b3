"""The steps of a balancing, read back from the document in the folder of its run."""

from dataclasses import dataclass
from pathlib import Path

from pydantic import TypeAdapter

from equipoise.io.documents.json_document import read_document
from equipoise.io.documents.run_folder import A_RUN
from equipoise.model.criterion import VerdictOutcome
from equipoise.model.recorded_step import RecordedStep

BALANCE = "balance.json"  # in the folder of a balancing


@dataclass(frozen=True, slots=True)
class _Verdict:
    outcome: VerdictOutcome


@dataclass(frozen=True, slots=True)
class _Step:
    kind: str
    time_s: float
    sentence: str
    verdict: _Verdict | None = None


@dataclass(frozen=True, slots=True)
class _Document:
    """Of the document the parts that are shown again; the others are passed over."""

    steps: tuple[_Step, ...]


_DOCUMENT = TypeAdapter(_Document)


def read_steps(folder: Path) -> tuple[RecordedStep, ...]:
    """Return the steps of a run in their order; none where the run was no balancing.

    Raises InputError if the document is not one that a balancing writes.
    """
    path = folder / BALANCE
    if not path.is_file():
        return ()
    document = read_document(_DOCUMENT.validate_json, path, A_RUN, "the document of a balancing")
    return tuple(map(_recorded, document.steps))


def _recorded(step: _Step) -> RecordedStep:
    outcome = None if step.verdict is None else step.verdict.outcome.value
    return RecordedStep(step.kind, step.time_s, step.sentence, outcome)
