"""`equipoise ledger`: the disturbance torque of each cause, second by second."""

from pathlib import Path

from equipoise.app.arguments.options import (
    NOTHING_STATED,
    USUAL,
    WHOLE,
    Flag,
    Json,
    Reading,
    Searching,
    Seeking,
)
from equipoise.app.console.terminal import announced, busy


def ledger(
    file: str,
    /,
    *,
    testbed: str,
    force: Flag = False,
    seeking: Seeking = NOTHING_STATED,
    searching: Searching = USUAL,
    reading: Reading = WHOLE,
    json: Json = False,
    out: Path | None = None,
) -> int:
    """Divide the disturbance torque on a platform among its causes, second by second.

    Causes are gravity, elastic sag, drift, warmth, moves, air and contacts, with 95 % bands.
    The platform is identified first; its terms decide which causes are distinguished. Subtract the
    total from your own record. Exit code 1: the estimate is not usable, or the causes do not close
    the momentum balance.

    Parameters
    ----------
    file
        Recording of a platform that moves freely.
    testbed
        Testbed file, or a preset's name.
    force
        Fit an implausible record, such as one with a gyro in another unit.
    out
        Folder for ledger.csv, figures, report and ledger.json.
    """
    from equipoise.app.arguments.checks import check_outputs
    from equipoise.app.arguments.inputs import fitting_recording_of, options_of, testbed_from

    bed, of_fit = announced(testbed_from(testbed)), options_of(seeking)
    check_outputs(out)
    recording = fitting_recording_of(file, reading, bed)
    with busy("identifying", announce=False):
        from equipoise.app.logbook.output import hand_over
        from equipoise.app.runs.recordings.plausible_record import Gate
        from equipoise.app.runs.recordings.torque_attribution import run
        from equipoise.app.runs.terminal_waiting import AT_TERMINAL, budget_at_terminal
        from equipoise.app.views.torque_views import output_of
        from equipoise.procedure.identification.identify import IdentifyOptions

    budget = budget_at_terminal(searching)
    options = IdentifyOptions(
        "trajectory", of_fit.terms, of_fit.hold, of_fit.use_prior, budget=budget
    )
    done = run(recording, bed, options, AT_TERMINAL, Gate(force))
    hand_over(output_of(done), json, out)
    return 0 if done.is_good else 1
