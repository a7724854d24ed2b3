"""`equipoise import`: what the columns of an unknown table mean, by what its numbers say."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from equipoise.app.arguments.options import WHOLE, Json, Reading, Whole
from equipoise.app.console.terminal import announced, busy, show_paths
from equipoise.model.errors import InputError

if TYPE_CHECKING:
    from equipoise.app.runs.recordings.importing import Imported
    from equipoise.app.views.import_views import TableRead
    from equipoise.assessment.hypotheses.inertial_unit import InertialUnit
    from equipoise.assessment.hypotheses.ranking import TableReading
    from equipoise.model.recording import Recording
    from equipoise.model.testbed import Testbed

BY_FIT = "motion: a platform's is explained by this direction of the attitude alone."


def import_(
    file: str,
    /,
    *,
    testbed: str | None = None,
    choose: Whole | None = None,
    write_map: Path | None = None,
    out: Path | None = None,
    reading: Reading = WHOLE,
    json: Json = False,
) -> int:
    """Determine what the columns of an unknown table are, and read it.

    Complete interpretations are compared by unit length, gravity and gyro: clock and its unit,
    order and direction of the quaternion, axes, signs and unit of the gyro, vertical axis. The best
    is shown with its evidence and the runner-up. Exit code 1: several fit equally; choose one.

    Parameters
    ----------
    file
        Table or log: CSV, Excel, Parquet, MAT, or any format that `convert` reads.
    testbed
        Testbed file, or a preset's name: defines the vertical body axis and checks that the
        platform stands upright.
    choose
        Interpretation to use, by its number.
    write_map
        Column map to write (TOML); every command that reads a recording accepts it with --columns.
    out
        Recording to write: .csv, .parquet, .mcap or .mat.
    """
    from equipoise.app.arguments.inputs import read_options, testbed_from
    from equipoise.app.runs.recordings.importing import imported
    from equipoise.io.files.atomic_file import check_writable
    from equipoise.io.recording.format_registry import format_to_write

    if out is not None:
        format_to_write(out)
    for path in filter(None, (out, write_map)):
        check_writable(path)
    bed = None if testbed is None else announced(testbed_from(testbed))
    options = read_options(reading, "--")
    with busy("comparing readings", announce=False):
        found = imported(file, options)
    return _read(found, choose, bed, Wanted(out, write_map, options.bad_rows, json))


@dataclass(frozen=True, slots=True)
class Wanted:
    """What is written of a reading, and how it is printed."""

    out: Path | None
    column_map: Path | None
    bad_rows: float
    json: bool

    def show(self, found: "TableRead") -> None:
        """Print what was found."""
        from equipoise.app.logbook.output import print_result
        from equipoise.app.views.import_views import import_blocks, import_json

        print_result(import_json(found), import_blocks(found), self.json)


def _read(found: "Imported", choose: int | None, bed: "Testbed | None", wanted: Wanted) -> int:
    """Show the readings, and read the table by the one that is taken."""
    from equipoise.app.runs.recordings.importing import axis_up, by_motion, check_vertical
    from equipoise.app.views.import_views import TableRead, unchecked
    from equipoise.assessment.plausibility.unread_inputs import unread_findings
    from equipoise.io.recording.frame_check import check_frame
    from equipoise.io.recording.recording_file import recording_from

    chosen = found.chosen(choose)
    by_fit: tuple[str, ...] = ()
    if chosen is None and bed is not None:
        with busy("comparing motions", announce=False):
            chosen = by_motion(found, bed, wanted.bad_rows)
        by_fit = (BY_FIT,) if chosen is not None else ()
    header = found.known is not None and not found.ranked.alike
    if chosen is None and not header:
        return _left_open(found, wanted)
    columns = found.known if chosen is None else found.columns(chosen, axis_up(bed))
    assert columns is not None  # one of the two is there
    recording = recording_from(found.table, columns, wanted.bad_rows)
    driven = (each.sentence for each in unread_findings(recording.unread))
    beside = (*unchecked(chosen, recording, bed), *driven)
    notes = (*by_fit, *recording.notes, *recording.gaps, *beside)
    left = found.left_aside(columns)
    wanted.show(TableRead(found.source, found.ranked, chosen, header, notes, left))
    if chosen is not None:
        check_vertical(chosen, found.source)
    if bed is not None:
        check_frame(recording, bed)
    _write(found, chosen, recording, wanted, axis_up(bed))
    return 0


def _left_open(found: "Imported", wanted: Wanted) -> int:
    """Show readings between which a person has to choose, or a map to start from."""
    from equipoise.app.runs.recordings.importing import map_to_start_from
    from equipoise.app.views.import_views import TableRead
    from equipoise.io.files.atomic_file import write_whole

    wanted.show(TableRead(found.source, found.ranked, None))
    if wanted.column_map is not None and not found.ranked.alike:
        write_whole(wanted.column_map, map_to_start_from(found.table.names))
        show_paths([wanted.column_map], wanted.json)
    return 1


def _write(
    found: "Imported",
    chosen: "TableReading | InertialUnit | None",
    recording: "Recording",
    wanted: Wanted,
    up: str,
) -> None:
    from equipoise.io.files.atomic_file import write_whole
    from equipoise.io.recording.recording_file import write_recording
    from equipoise.io.toml.write_toml import toml_text

    if wanted.column_map is not None and chosen is not None:
        write_whole(wanted.column_map, toml_text(found.map_keys(chosen, up)))
    elif wanted.column_map is not None:
        found_as = "a self-describing file"
        raise InputError("--write-map", found_as, "no map: none is needed")
    if wanted.out is not None:
        write_recording(recording, wanted.out)
    if paths := [path for path in (wanted.column_map, wanted.out) if path is not None]:
        show_paths(paths, wanted.json)
