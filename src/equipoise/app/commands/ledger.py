"""`equipoise ledger`: the disturbance torque of each cause, second by second."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from cyclopts import Parameter

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
from equipoise.app.console.terminal import announced, busy, show_paths
from equipoise.model.errors import InputError

if TYPE_CHECKING:
    from equipoise.app.runs.recordings.torque_attribution import AttributedTorque


@Parameter(name="*")
@dataclass(frozen=True, slots=True)
class Beside:
    """What a ledger begins with, and what it writes beside its folder.

    Attributes
    ----------
    estimate
        Run or JSON document of an identification to use, of this recording or of another one of the
        platform. If omitted: the platform is identified.
    record
        Recording to write with the torque of each cause as columns: .csv, .parquet, .mcap or .mat.
    """

    estimate: str | None = None
    record: Path | None = None


NOTHING_BESIDE = Beside()


def ledger(
    file: str,
    /,
    *,
    testbed: str,
    force: Flag = False,
    seeking: Seeking = NOTHING_STATED,
    searching: Searching = USUAL,
    reading: Reading = WHOLE,
    beside: Beside = NOTHING_BESIDE,
    json: Json = False,
    out: Path | None = None,
) -> int:
    """Divide the disturbance torque on a platform among its causes, second by second.

    Causes are gravity, elastic sag, drift, warmth, moves, air and contacts, with 95 % bands.
    The terms of the identification decide which causes are distinguished. Subtract the total from
    your own record. Exit code 1: the estimate is not usable, or the causes do not close
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
    check_beside(beside, seeking)
    recording = fitting_recording_of(file, reading, bed)
    with busy("identifying", announce=False):
        from equipoise.app.logbook.output import hand_over
        from equipoise.app.runs.recordings.plausible_record import Gate
        from equipoise.app.runs.recordings.torque_attribution import run, run_with
        from equipoise.app.runs.terminal_waiting import AT_TERMINAL, budget_at_terminal
        from equipoise.app.views.torque_views import output_of
        from equipoise.io.exchange.estimate_file import read_estimate
        from equipoise.procedure.identification.identify import IdentifyOptions

    if beside.estimate is not None:
        done = run_with(recording, bed, read_estimate(beside.estimate), AT_TERMINAL, Gate(force))
    else:
        budget = budget_at_terminal(searching)
        options = IdentifyOptions(
            "trajectory", of_fit.terms, of_fit.hold, of_fit.use_prior, budget=budget
        )
        done = run(recording, bed, options, AT_TERMINAL, Gate(force))
    hand_over(output_of(done), json, out)
    if beside.record is not None:
        write_with_torque(done, beside.record)
        show_paths([beside.record], json)
    return 0 if done.is_good else 1


def check_beside(beside: Beside, seeking: Seeking) -> None:
    """Raise InputError for a file that cannot be written, and for two sources of the terms."""
    from equipoise.io.files.atomic_file import check_writable
    from equipoise.io.recording.format_registry import format_to_write

    if beside.estimate is not None and seeking != NOTHING_STATED:
        found = "--hold, --term or --prior, which an identification takes"
        raise InputError("--estimate", found, "one of both: the estimate has its terms")
    if beside.record is not None:
        format_to_write(beside.record)
        check_writable(beside.record)


def write_with_torque(done: "AttributedTorque", path: Path) -> None:
    """Write the recording with the torque of each cause as columns."""
    from equipoise.io.recording.recording_file import write_recording
    from equipoise.model.torque_by_cause import with_torque

    write_recording(with_torque(done.recording, done.torque), path)
