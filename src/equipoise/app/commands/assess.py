"""`equipoise assess`: what a recording proves about a platform."""

from pathlib import Path

from equipoise.app.arguments.options import (
    NOTHING_STATED,
    USUAL,
    WHOLE,
    Json,
    Reading,
    Searching,
    Seeking,
    Triple,
)
from equipoise.app.console.terminal import busy


def assess(
    file: str,
    /,
    *,
    testbed: str,
    before: str | None = None,
    tilt_deg: float = 20.0,
    target_um: Triple = (0.0, 0.0, 0.0),
    require_torque: float | None = None,
    require_offset_um: float | None = None,
    windows_s: float | None = None,
    seeking: Seeking = NOTHING_STATED,
    searching: Searching = USUAL,
    reading: Reading = WHOLE,
    json: Json = False,
    out: Path | None = None,
) -> int:
    """Quantify the residual gravity torque of a platform with confidence bounds.

    Exit code 1: the platform does not meet the requirement, or the recording cannot decide it;
    without a requirement, the estimate is not trustworthy.

    Parameters
    ----------
    file
        Recording of a free swing.
    testbed
        Testbed file, or a preset's name. Its inertia counts as known to its sd.
    before
        Recording from before balancing, for comparison.
    tilt_deg
        Evaluate torque over all directions within this angle of level.
    target_um
        Target of the centre of mass, from the centre of rotation, body axes.
    require_torque
        Maximum permitted gravity torque, rms over these directions, N m.
    require_offset_um
        Maximum permitted distance of the centre of mass from its target.
    windows_s
        Also assess windows of this length along the recording: drift, random walk and Allan
        deviation of the centre of mass.
    out
        Folder for figures, report.html and assess.json.
    """
    from equipoise.app.arguments.checks import between, check_outputs, positive, vector
    from equipoise.app.arguments.inputs import fitting_recording_of, options_of, testbed_from
    from equipoise.model.units import DEG, UM, in_si

    bed, of_fit = testbed_from(testbed), options_of(seeking)
    torque = positive("--require-torque", require_torque)
    offset = positive("--require-offset-um", require_offset_um)
    offset = None if offset is None else in_si(offset, UM)
    windows = positive("--windows-s", windows_s)
    tilt = in_si(between("--tilt-deg", tilt_deg, 0.0, 90.0), DEG)
    goal = vector("--target-um", target_um, UM)
    check_outputs(out)
    recording = fitting_recording_of(file, reading, bed)
    earlier = None if before is None else fitting_recording_of(before, reading.whole, bed)
    with busy("assessing", announce=False):
        from equipoise.app.logbook.output import hand_over
        from equipoise.app.runs.recordings.assessment import Recordings, run
        from equipoise.app.runs.terminal_waiting import AT_TERMINAL, budget_at_terminal
        from equipoise.app.views.assess_views import output_of
        from equipoise.procedure.identification.assess import AssessOptions

        budget = budget_at_terminal(searching)
        options = AssessOptions(goal, tilt, torque, offset, of_fit.terms, of_fit.hold, budget)
    done = run(Recordings(recording, earlier, windows), bed, options, AT_TERMINAL)
    hand_over(output_of(done), json, out)
    verdict = done.verdict
    good = not done.estimate.outcome.warns if verdict is None else verdict.passed
    return 0 if good else 1
