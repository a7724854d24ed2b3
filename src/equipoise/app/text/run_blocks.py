"""What a recording holds and what a procedure did, as blocks."""

from collections.abc import Iterable, Sequence

from equipoise.app.text.blocks import (
    Blocks,
    Claim,
    Heading,
    Item,
    Items,
    Moment,
    Paragraph,
    Tone,
    items,
)
from equipoise.app.text.estimate_text import noise_floor_line
from equipoise.app.text.numbers import fixed
from equipoise.model.finding import Finding
from equipoise.model.reasons.reason import Reason
from equipoise.model.step import Step
from equipoise.model.verdict import Verdict, VerdictOutcome

RECORDING = "Content of the recording"
TONES: dict[str, Tone] = {
    "content": "plain",
    "motion": "plain",
    "problem": "caution",  # an estimate will suffer from it
    "wrong": "bad",  # nothing is fitted
    "mended": "quiet",  # it was set right
}

VERDICT_TONES: dict[VerdictOutcome, Tone] = {
    VerdictOutcome.PASSED: "good",
    VerdictOutcome.UNDECIDED: "caution",
    VerdictOutcome.FAILED: "bad",
    VerdictOutcome.HALTED: "bad",
}


def finding_items(findings: Sequence[Finding]) -> Blocks:
    """Return what a recording holds and what is wrong with it."""
    if not findings:
        return ()
    return (Items(tuple(Item(f.sentence, TONES[f.kind]) for f in findings)),)


def recording_blocks(findings: Sequence[Finding]) -> Blocks:
    """Return the findings under their heading, for below the result; nothing if there are none."""
    return (Heading(RECORDING), *finding_items(findings)) if findings else ()


def reason_items(reasons: Iterable[Reason], tone: Tone = "caution") -> Blocks:
    """Return the sentences of reasons as a list; nothing where there are none."""
    return items((reason.sentence for reason in reasons), tone)


def moment_of(step: Step) -> Moment:
    """Return a step: when, what, and what came of it."""
    return Moment(f"{fixed(step.time, 1)} s", step.kind, step.sentence)


def moments(steps: Sequence[Step]) -> Blocks:
    """Return steps in their order."""
    return tuple(map(moment_of, steps))


def verdict_blocks(verdict: Verdict) -> Blocks:
    """Return a verdict, and which offsets its record cannot distinguish from none."""
    claim, floor = verdict_claim(verdict), noise_floor_line(verdict)
    return (claim, Paragraph(floor, "quiet")) if floor else (claim,)


def verdict_claim(verdict: Verdict) -> Claim:
    """Return the sentence of a verdict; one that is not sure is neither good news nor bad."""
    return Claim(verdict.sentence, VERDICT_TONES[verdict.outcome])
