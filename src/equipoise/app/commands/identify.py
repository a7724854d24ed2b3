"""`equipoise identify`: mass properties from a recording."""

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from equipoise.app.arguments.options import (
    ALONE,
    NOTHING_STATED,
    USUAL,
    WHOLE,
    Flag,
    Json,
    Reading,
    Searching,
    Seeking,
    Spreading,
)
from equipoise.app.console.terminal import busy
from equipoise.model.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from equipoise.app.engine.pool import Engine
    from equipoise.app.runs.recordings.plausible_record import Gate
    from equipoise.model.manoeuvre import Plan
    from equipoise.model.recording import Recording
    from equipoise.model.testbed import Testbed
    from equipoise.procedure.identification.identify import IdentifyOptions


def identify(
    file: str,
    /,
    *more: str,
    testbed: str,
    method: str = "auto",
    robust: Flag = False,
    force: Flag = False,
    plan: Path | None = None,
    spreading: Spreading = ALONE,
    seeking: Seeking = NOTHING_STATED,
    searching: Searching = USUAL,
    reading: Reading = WHOLE,
    json: Json = False,
    out: Path | None = None,
) -> int:
    """Estimate centre of mass and inertia from recordings, with confidence intervals.

    Several recordings of one platform are fitted jointly: inertia and centre of mass are common,
    starts, biases and moves are individual. A test states whether the runs agree. Exit code 1: the
    estimate is not usable, the runs do not agree, or the record is implausible; the sentences below
    the tables give the reason.

    Parameters
    ----------
    file
        Recording of a free swing.
    more
        Further recordings of the same platform, fitted jointly with the first.
    testbed
        Testbed file, or a preset's name.
    method
        auto, or a method of `equipoise methods`; several recordings: trajectory.
    robust
        Down-weight outliers (Huber loss).
    force
        Fit an implausible record, such as one with a gyro in another unit.
    plan
        Plan file of the recording; its predicted sd are compared with the result. One recording
        only.
    out
        Folder for report, figures and estimate.json. If omitted: a folder of its own in
        equipoise-runs.
    """
    from equipoise.app.arguments.checks import check_outputs, one_of
    from equipoise.app.arguments.inputs import (
        fitting_recording_of,
        options_of,
        plan_from,
        testbed_from,
    )
    from equipoise.app.arguments.many_runs import check_one_piece, engine_from

    bed, of_fit = testbed_from(testbed), options_of(seeking)
    check_outputs(out)
    if more and plan is not None:
        raise InputError("--plan", "several recordings", "the recording that was made by the plan")
    engine = engine_from(spreading)
    if not more:
        check_one_piece(spreading, "several recordings")
    recordings = [fitting_recording_of(each, reading, bed) for each in (file, *more)]
    planned = None if plan is None else plan_from(plan, bed)
    with busy("identifying", announce=False):
        from equipoise.app.runs.recordings.plausible_record import Gate
        from equipoise.app.runs.terminal_waiting import budget_at_terminal
        from equipoise.estimation.methods.registry import METHODS
        from equipoise.procedure.identification.identify import IdentifyOptions

    one_of("--method", method, ["auto", *METHODS])
    budget = budget_at_terminal(searching)
    options = IdentifyOptions(method, of_fit.terms, of_fit.hold, of_fit.use_prior, robust, budget)
    if more:
        gate = Gate(force)
        return _jointly(recordings, bed, options, engine, gate, json=json, out=out)
    return _from_one(recordings[0], bed, options, planned, force=force, json=json, out=out)


def _from_one(
    recording: "Recording",
    bed: "Testbed",
    options: "IdentifyOptions",
    planned: "Plan | None",
    *,
    force: bool,
    json: bool,
    out: Path | None,
) -> int:
    """Identify from one recording."""
    with busy("identifying", announce=False):
        from equipoise.app.logbook.output import hand_over_run
        from equipoise.app.runs.recordings.identification import run
        from equipoise.app.runs.recordings.plausible_record import Gate
        from equipoise.app.runs.terminal_waiting import AT_TERMINAL
        from equipoise.app.views.identify_views import output_of

    done = run(recording, bed, options, AT_TERMINAL, Gate(force))
    done = replace(done, plan=planned)
    hand_over_run(output_of(done), json, out, bed.name)
    return 0 if done.estimate.outcome.usable else 1


def _jointly(
    recordings: "Sequence[Recording]",
    bed: "Testbed",
    options: "IdentifyOptions",
    engine: "Engine",
    gate: "Gate",
    *,
    json: bool,
    out: Path | None,
) -> int:
    """Identify from several recordings of one platform."""
    with busy("identifying", announce=False):
        from equipoise.app.logbook.output import hand_over_run
        from equipoise.app.runs.recordings.joint_identification import run
        from equipoise.app.runs.terminal_waiting import at_terminal_by
        from equipoise.app.views.identify_runs_views import output_of

    with at_terminal_by(engine) as waiting:
        done = run(recordings, bed, options, waiting, gate)
    hand_over_run(output_of(done), json, out, bed.name)
    return 0 if done.estimate.outcome.usable and done.verdict.passed else 1
