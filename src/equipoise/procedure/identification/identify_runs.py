"""Identify from several recordings of one platform: each by itself, then all together, as Steps.

The last step has the joint estimate, and the verdict on whether the runs agree. A run that is not
usable by itself is left out, which the estimate says. The method is the trajectory fit.
"""

from collections import Counter
from collections.abc import Callable, Generator, Iterable, Sequence
from dataclasses import replace
from functools import partial

from equipoise.assessment.plausibility.estimated_body import with_plausibility
from equipoise.estimation.events.record_model import RecordModel
from equipoise.estimation.joint.joint_estimate import Run, estimate_jointly
from equipoise.estimation.methods.trajectory import params_of
from equipoise.estimation.model_selection.reference_fit import modelled
from equipoise.estimation.output_error.trajectory import METHOD, Params
from equipoise.model.errors import InputError
from equipoise.model.estimate import Estimate
from equipoise.model.joint_estimate import JointEstimate
from equipoise.model.reasons.reason import Reason
from equipoise.model.reasons.step_reasons import StepReason
from equipoise.model.recording import Recording
from equipoise.model.step import Step
from equipoise.model.testbed import Testbed
from equipoise.procedure.identification.identify import IdentifyOptions
from equipoise.procedure.steps.clean_record import sound

Alone = tuple[RecordModel | None, Estimate]  # a recording's model and estimate, by itself
Spread = Callable[[Callable[[Recording], Alone], Sequence[Recording]], Iterable[Alone]]


def identify_runs(
    recordings: Sequence[Recording],
    testbed: Testbed,
    options: IdentifyOptions,
    spread: Spread = map,
) -> Generator[Step, None, JointEstimate]:
    """Yield an estimate of each run, then that of all together with the verdict.

    ``spread`` estimates the runs, none of which rests on another. Raises InputError for another
    method, and for a recording that is given twice.
    """
    check_method(options.method)
    check_distinct(recordings)
    params, runs = params_of(testbed, options.requested), list[Run]()
    found = spread(partial(estimated, testbed, params), recordings)
    for name, recording, (model, estimate) in zip(
        names_of(recordings), recordings, found, strict=True
    ):
        runs.append(Run(name, recording.sha256, model, estimate))
        reasons = (Reason(StepReason.RUN_ESTIMATED, (name,)), *estimate.outcome.reasons)
        yield Step("estimate", recording.span[1], reasons, recording, estimate)
    joint = estimate_jointly(runs, testbed, params.budget.renewed())
    end = sum(recording.span[1] - recording.span[0] for recording in recordings)
    reasons, kind = joint.verdict.reasons, "verify" if joint.verdict.passed else "stop"
    yield Step(kind, end, reasons, estimate=joint.estimate, verdict=joint.verdict)
    return joint


def estimated(testbed: Testbed, params: Params, recording: Recording) -> Alone:
    """Return the model of one recording and its estimate."""
    of_this = replace(params, budget=params.budget.renewed())
    rows, platform = sound(recording, testbed)
    model, found = modelled(rows, platform, of_this)
    return model, with_plausibility(found, rows, platform)


def check_method(name: str) -> None:
    """Raise InputError for a method that takes one recording."""
    if name not in ("auto", METHOD):
        wanted = f"{METHOD}, which fits several recordings jointly, or one recording"
        raise InputError("method", f"'{name}' with several recordings", wanted)


def check_distinct(recordings: Sequence[Recording]) -> None:
    """Raise InputError for a recording that is given twice: it would count double."""
    first = dict[str, str]()
    for recording in recordings:
        if recording.sha256 and recording.sha256 in first:
            found = f"the same rows as {first[recording.sha256]}"
            raise InputError(recording.source, found, "each recording once: twice it counts double")
        first[recording.sha256] = recording.source


def names_of(recordings: Sequence[Recording]) -> tuple[str, ...]:
    """Return what the runs are called: by their sources, numbered where these are alike."""
    count, known = Counter(recording.source for recording in recordings), Counter[str]()
    names: list[str] = []
    for source in (recording.source for recording in recordings):
        known[source] += 1
        names.append(source if count[source] == 1 else f"{source} {known[source]}".strip())
    return tuple(names)
