"""`equipoise calibrate`: what masses really do for their commands, and how sensors stand."""

from pathlib import Path
from shlex import quote
from typing import TYPE_CHECKING

from equipoise.app.arguments.options import (
    NOTHING_STATED,
    USUAL,
    WHOLE,
    Flag,
    Json,
    Names,
    Reading,
    Searching,
    Seeking,
)
from equipoise.app.console.terminal import announced, busy, print_whole, show_paths
from equipoise.model.errors import InputError
from equipoise.model.units import MM

if TYPE_CHECKING:
    from equipoise.app.views.calibration_views import Calibrated
    from equipoise.estimation.calibration.calibration import CalibrateOptions
    from equipoise.model.testbed import Testbed


def calibrate(
    file: str | None = None,
    /,
    *,
    testbed: str,
    moves: Flag = False,
    reference: Names = (),
    seeking: Seeking = NOTHING_STATED,
    searching: Searching = USUAL,
    reading: Reading = WHOLE,
    write: Path | None = None,
    json: Json = False,
    out: Path | None = None,
) -> int:
    """Calibrate masses and sensors from a recording of commanded moves.

    Exit code 1: the calibration is not usable; then nothing is written.

    Parameters
    ----------
    file
        Recording of commanded moves. Left out with --moves.
    testbed
        Testbed file, or a preset's name.
    moves
        Print the moves to command for such a recording; calibrate nothing.
    reference
        Mass whose weight and steps you trust; it fixes the scale. May be repeated.
    write
        Testbed file to write with the result; comments are kept.
    out
        Folder for report and calibrate.json.
    """
    from equipoise.app.arguments.checks import check_outputs
    from equipoise.app.arguments.inputs import options_of, testbed_from
    from equipoise.estimation.calibration.calibration import CalibrateOptions

    bed = announced(testbed_from(testbed))
    if moves:
        return _report_moves(bed, testbed)
    if file is None:
        raise InputError(
            "calibrate", "no recording", "a file, or --moves to list the moves to record"
        )
    check_outputs(out, write)
    from equipoise.app.logbook.output import hand_over
    from equipoise.app.runs.terminal_waiting import budget_at_terminal
    from equipoise.app.views.calibration_views import output_of

    of_fit = options_of(seeking)
    budget = budget_at_terminal(searching)
    options = CalibrateOptions(reference, of_fit.terms, of_fit.hold, of_fit.use_prior, budget)
    found = _carried_out(file, bed, reading, options)
    hand_over(output_of(found), json, out)
    if not found.estimate.outcome.usable:
        return 1
    if write is not None:
        _write(found, testbed, write, quiet=json)
    return 0


def _carried_out(
    file: str, bed: "Testbed", reading: Reading, options: "CalibrateOptions"
) -> "Calibrated":
    """Return the calibration."""
    from equipoise.app.arguments.inputs import fitting_recording_of

    recording = fitting_recording_of(file, reading, bed)
    with busy("calibrating"):
        from equipoise.app.views.calibration_views import Calibrated
        from equipoise.procedure.identification.calibrate import calibrate as procedure

        return Calibrated(bed, recording, procedure(recording, bed, options))


def _write(found: "Calibrated", name: str, path: Path, quiet: bool) -> None:
    """Write the calibrated testbed."""
    from equipoise.app.arguments.inputs import testbed_text_of
    from equipoise.app.views.calibration_views import remarks_of
    from equipoise.estimation.calibration.calibration import calibrated
    from equipoise.io.files.atomic_file import write_whole
    from equipoise.io.testbed.testbed_file import with_drives

    text, drives = testbed_text_of(name), calibrated(found.testbed, found.estimate)
    write_whole(path, with_drives(text, drives, remarks_of(found), name))
    if not quiet:
        show_paths([path])


def _report_moves(bed: "Testbed", name: str) -> int:
    """Print the moves that show most, as a command for the simulated bench."""
    from equipoise.procedure.identification.calibrate import calibration_moves

    plan, duration = calibration_moves(bed)
    lines = [f"equipoise simulate {quote(name)} --out run.csv --duration-s {duration:g}"]
    lines += [
        f'--move "{t:g}: ' + " ".join(f"{m}={d / MM:.4g}" for m, d in goals.items()) + '"'
        for t, goals in plan
    ]
    print_whole(" \\\n  ".join(lines))
    return 0
