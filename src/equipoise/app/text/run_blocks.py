"""What a recording holds and what a procedure did, as blocks."""

from collections.abc import Sequence

from equipoise.app.text.blocks import Blocks, Claim, Item, Items, Moment, Paragraph, Tone
from equipoise.app.text.estimate_text import noise_floor_line
from equipoise.app.text.numbers import fixed
from equipoise.model.finding import Finding
from equipoise.model.step import Step
from equipoise.model.verdict import Verdict

TONES: dict[str, Tone] = {
    "content": "plain",
    "motion": "plain",
    "problem": "caution",  # an estimate will suffer from it
    "mended": "quiet",  # it was set right
}


def finding_items(findings: Sequence[Finding]) -> Blocks:
    """Return what a recording holds and what is wrong with it."""
    if not findings:
        return ()
    return (Items(tuple(Item(f.sentence, TONES[f.kind]) for f in findings)),)


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
    tone: Tone = "good" if verdict.passed else "bad"
    return Claim(verdict.sentence, tone if verdict.sure else "caution")
