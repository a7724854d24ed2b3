"""`equipoise convert`: a recording from one format, or a sensor's saved bytes, into another."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from equipoise.app.arguments.options import WHOLE, Reading
from equipoise.app.console.terminal import counted, show_paths

if TYPE_CHECKING:
    from equipoise.model.hardware import Setting
    from equipoise.model.recording import Recording


@Parameter(name="*")
@dataclass(frozen=True, slots=True)
class Captured:
    """How bytes of a sensor are read, as they came over its wire.

    Attributes
    ----------
    driver
        The file holds raw bytes of a sensor: lines, vectornav, mavlink or natnet. For lines,
        --columns lists the column names, separated by commas.
    testbed
        Testbed file whose sensor with this driver has the settings and the alignment; the options
        below take precedence.
    form
        Lines: csv or json.
    laboratory
        Frame of the attitude: ned, z_up or y_up. If omitted: the driver's usual one.
    rate_hz
        Sample rate, where neither rows nor file have a time.
    """

    driver: Annotated[str | None, Parameter(name="--as")] = None
    testbed: str | None = None
    form: Annotated[str | None, Parameter(name="--format")] = None
    laboratory: str | None = None
    rate_hz: float | None = None


NOT_CAPTURED = Captured()


def convert(
    file: str, out: Path, /, *, reading: Reading = WHOLE, captured: Captured = NOT_CAPTURED
) -> int:
    """Convert a recording, or the saved bytes of a sensor, to another format.

    Lines marked '~' state corrections and omissions. Events remain in the file that has them.

    Parameters
    ----------
    file
        Recording: CSV, Excel, Parquet, MCAP, MAT, a bag of ROS 1 or 2, a log of PX4 (ULog),
        ArduPilot (.bin) or MAVLink (.tlog), or a VectorNav terminal log with a time stamp on each
        line; also in .gz, .zst or .zip. With --as: any terminal log, a .tlog, or captured network
        traffic (.pcap, .pcapng).
    out
        File to write: .csv, .parquet, .mcap or .mat.
    """
    from equipoise.app.arguments.inputs import recording_of
    from equipoise.app.console.rich_blocks import show
    from equipoise.app.text.blocks import items
    from equipoise.assessment.plausibility.unread_inputs import unread_findings
    from equipoise.io.files.atomic_file import check_writable
    from equipoise.io.recording.format_registry import format_to_write
    from equipoise.io.recording.long_conversion import is_long
    from equipoise.model.errors import InputError

    format_to_write(out)  # refuses a suffix before anything is read
    check_writable(out)
    if captured.driver is not None:
        recording = _written(_replayed(file, captured.driver, captured, reading), out)
    elif captured != NOT_CAPTURED:
        raise InputError("--as", "nothing", "the driver of the sensor whose bytes the file holds")
    elif reading.from_s is None and reading.to_s is None and is_long(Path(file), out):
        recording = _in_pieces(file, out, reading)
    else:
        recording = _written(recording_of(file, reading), out)
    driven = (each.sentence for each in unread_findings(recording.unread))
    show(items((*recording.notes, *recording.gaps, *driven), "quiet"))
    show_paths([out])
    return 0


def _written(recording: "Recording", out: Path) -> "Recording":
    from equipoise.io.recording.recording_file import write_recording

    write_recording(recording, out)
    return recording


def _in_pieces(file: str, out: Path, reading: Reading) -> "Recording":
    """Write a long table piece by piece, and return what is said of it, without rows."""
    from equipoise.app.arguments.inputs import read_options
    from equipoise.io.recording.long_conversion import convert_in_pieces

    with counted("converting") as on_progress:
        return convert_in_pieces(Path(file), out, read_options(reading, "--"), on_progress)


def _replayed(file: str, driver: str, captured: Captured, reading: Reading) -> "Recording":
    """Return the rows that a driver reads in a file, or the part that is asked for."""
    from equipoise.app.arguments.checks import positive
    from equipoise.app.arguments.inputs import memory_of, part_of, testbed_from
    from equipoise.app.runs.captures.captured_bytes import recording_of_capture
    from equipoise.app.runs.captures.captured_sensor import Stated, unit_of
    from equipoise.io.files.reading_budget import ReadingBudget
    from equipoise.model.errors import InputError

    if reading.dialect is not None:
        raise InputError("--dialect and --as", "both", "one of them")
    rate = positive("--rate-hz", captured.rate_hz)
    bed = None if captured.testbed is None else testbed_from(captured.testbed)
    stated = Stated(captured.laboratory, _settings(captured, reading))
    unit, budget = unit_of(driver, bed, stated), ReadingBudget(memory_of(reading, "--"))
    with counted("reading") as on_progress:
        recording = recording_of_capture(file, unit, rate, on_progress, budget)
    whole = reading.from_s is None and reading.to_s is None
    return recording if whole else part_of(recording, reading.from_s, reading.to_s)


def _settings(captured: Captured, reading: Reading) -> "dict[str, Setting]":
    """Return the driver's settings that were given as options."""
    found: dict[str, Setting] = {}
    if reading.columns is not None:
        found["columns"] = tuple(reading.columns.replace(",", " ").split())
    if captured.form is not None:
        found["format"] = captured.form
    if reading.body is not None:
        found["body"] = float(reading.body) if reading.body.isdecimal() else reading.body
    return found
