"""What verbs and commands take, resolved: testbeds, recordings, plans, options of a fit, moves."""

import math
import re
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from equipoise.actuators.stored_momentum import with_known_inputs
from equipoise.app.arguments.checks import one_of, positive, share
from equipoise.estimation.method_contract import Options
from equipoise.estimation.search_budget import UNLIMITED, Budget
from equipoise.io.columns.column_map import ColumnMap
from equipoise.io.columns.read_options import ReadOptions
from equipoise.io.files.source_file import read_text
from equipoise.io.recording.frame_check import check_frame
from equipoise.io.recording.recording_file import check_names, read_recording
from equipoise.io.testbed.presets import preset_names, preset_text, read_preset
from equipoise.io.testbed.testbed_file import read_testbed
from equipoise.io.toml.plausible import implausible
from equipoise.model.errors import InputError, nearest
from equipoise.model.estimate import COM, INERTIA
from equipoise.model.manoeuvre import Plan
from equipoise.model.recording import Recording, arranged, arranged_devices, window
from equipoise.model.testbed import Testbed
from equipoise.model.torque_terms import expand
from equipoise.model.units import MEGABYTE, MM

if TYPE_CHECKING:
    from equipoise.app.arguments.options import Reading, Seeking

AnyTestbed = Testbed | str | Path  # a path goes before a preset's name
AnyRecording = Recording | str | Path
AnyPlan = Plan | str | Path
TILT = math.radians(20.0)  # that torques are judged within, unless another is requested
FEWEST = 3  # rows of a sensor that a window must leave, as when a file is read
WANTED_MOVE = "'seconds: mass=mm mass=mm', such as '60: x1=-10 z1=-50'"


def budget_from(budget_s: float) -> Budget:
    """Return the budget of searches that may take so many seconds of processor time each."""
    from equipoise.app.arguments.search_time import budget_of

    return budget_of(positive("budget_s", budget_s))


def testbed_from(testbed: AnyTestbed) -> Testbed:
    """Return the testbed itself, of a file, or of a preset when there is no such file."""
    if isinstance(testbed, Testbed):
        return testbed
    path, name = Path(testbed), str(testbed)
    if not path.exists() and name in preset_names():
        return read_preset(name)
    if not path.exists() and path.name == name and not path.suffix:
        found = f"'{name}', which is neither a testbed file nor a preset"
        raise InputError("testbed", found, nearest(name, list(preset_names())))
    return read_testbed(path)


def testbed_text_of(name: str) -> str:
    """Return the text of a testbed that ``testbed_from`` has read."""
    return read_text(name, "a testbed file") if Path(name).exists() else preset_text(name)


def testbed_with_masses(testbed: AnyTestbed) -> Testbed:
    """Return a testbed; InputError if it has no masses or no sensor."""
    bed = testbed_from(testbed)
    if not bed.masses:
        raise InputError(bed.source, "no sliding masses", "a [[sliding_mass]] at least")
    if bed.attitude is None and bed.gyro is None:
        raise InputError(bed.source, "no sensor", "[sensor.attitude] or [sensor.gyro]")
    return bed


def recording_from(recording: AnyRecording, testbed: Testbed) -> Recording:
    """Return a recording, or that of a file, from where the platform was let go, fitted."""
    if not isinstance(recording, Recording):
        recording = read_recording(recording)
    return part_of(fitted(recording, testbed), None, None)


def check_of_recording(reading: "Reading", file: object | None, wanted: str) -> None:
    """Raise InputError if options of a recording are given without the recording."""
    from equipoise.app.arguments.options import WHOLE

    if file is None and reading != WHOLE:
        raise InputError("options of a recording", "no recording", wanted)


def recording_of(file: str, reading: "Reading") -> Recording:
    """Return a recording as it is, or the part that is asked for."""
    recording = read_recording(file, read_options(reading, "--"))
    whole = reading.from_s is None and reading.to_s is None
    return recording if whole else part_of(recording, reading.from_s, reading.to_s)


def fitting_recording_of(file: str | Path, reading: "Reading", testbed: Testbed) -> Recording:
    """Return the part asked for of a recording that fits a testbed."""
    recording = fitted(read_recording(file, read_options(reading, "--")), testbed)
    return part_of(recording, reading.from_s, reading.to_s)


def read_options(reading: "Reading", dashes: str = "") -> ReadOptions:
    """Return how a file is read; ``dashes`` stand before the options' names in an error."""
    if reading.dialect is not None and reading.columns is not None:
        raise InputError(f"{dashes}dialect and {dashes}columns", "both", "one of them")
    share(f"{dashes}bad{'-' if dashes else '_'}rows", reading.bad_rows)
    columns = None if reading.columns is None else column_map_in(reading.columns)
    return ReadOptions(reading.dialect, columns, reading.topic, reading.body, reading.instance,
                       reading.bad_rows, memory_of(reading, dashes))  # fmt: skip


def column_map_in(path: str) -> ColumnMap:
    """Return the column map of a file."""
    from equipoise.io.columns.column_map_file import read_column_map

    return read_column_map(path)


def memory_of(reading: "Reading", dashes: str = "") -> int | None:
    """Return how many bytes reading may take, if that is stated."""
    option = f"{dashes}max{'-' if dashes else '_'}memory{'-' if dashes else '_'}mb"
    stated = positive(option, reading.max_memory_mb)
    return None if stated is None else int(stated * MEGABYTE)


def fitted(recording: Recording, testbed: Testbed) -> Recording:
    """Return a recording that fits a testbed: masses and devices are its, gravity points down.

    Fitted again it stays as it is.
    """
    check_names(recording, testbed)
    check_frame(recording, testbed)
    recording = arranged(recording, testbed.mass_names)
    return with_known_inputs(arranged_devices(recording, testbed.devices), testbed)


def part_of(recording: Recording, start: float | None, end: float | None) -> Recording:
    """Return the part between two times (s); one that is left out stands for the end there is.

    A bench's own record begins where the platform was let go, unless another time is given.
    What lies outside of the sensors' rows is left out, such as a move after the last one.
    """
    first, last = recording.span
    start = recording.free_from if start is None else start
    part = window(recording, first if start is None else start, last if end is None else end)
    if max(len(c) for c in (part.attitude, part.rate, ()) if c is not None) < FEWEST:
        found = f"fewer than {FEWEST} rows between --from-s and --to-s"
        raise InputError(recording.source, found, f"times within {first:g} to {last:g} s")
    return part


def plan_from(plan: AnyPlan, testbed: Testbed) -> Plan:
    """Return a plan, or that of a file; InputError for what the testbed cannot do."""
    if isinstance(plan, Plan):
        return plan
    from equipoise.io.documents.plan_file import read_plan

    return read_plan(plan, testbed)


def options_from(
    terms: Sequence[str],
    hold: Sequence[str],
    use_prior: bool = False,
    robust: bool = False,
    named: tuple[str, str] = ("terms", "hold"),
) -> Options:
    """Return the options of a fit, composed terms spelt out; unknown names are refused."""
    of_terms, of_hold = named
    for name in hold:
        one_of(of_hold, name, [*COM, *INERTIA])
    return Options(expand(tuple(terms), of_terms), tuple(hold), use_prior, robust)


def options_of(seeking: "Seeking", budget: Budget = UNLIMITED) -> Options:
    """Return the options of a fit, as a command's options have them."""
    named = ("--term", "--hold")
    options = options_from(seeking.term, seeking.hold, seeking.prior, named=named)
    return replace(options, budget=budget)


def move_of(text: str, testbed: Testbed) -> tuple[float, dict[str, float]]:
    """Return time (s) and displacements from home (m) of a move such as '60: x1=-10 z1=-50'."""
    start, _, goals = map(str.strip, text.partition(":"))
    pairs = [goal.partition("=")[::2] for goal in re.split(r"[\s,]+", goals)]
    if len(start.split()) != 1 or not all(name and mm for name, mm in pairs):
        raise InputError("--move", f"'{text}'", WANTED_MOVE)
    known = [mass.name for mass in testbed.masses]
    for name, _ in pairs:
        if name not in known:
            wanted = nearest(name, known) if known else "no move: the testbed has no masses"
            raise InputError(f"--move '{text}'", f"mass '{name}'", wanted)
    time = _number("time_s", start, text)
    return time, {name: _number("place_mm", mm, text) * MM for name, mm in pairs}


def _number(key: str, word: str, text: str) -> float:
    """Return a number of a move; ``key`` ends with its unit."""
    where, found = f"--move '{text}'", f"'{word}'"
    try:
        number = float(word)
    except ValueError as error:
        raise InputError(where, found, "a number") from error
    wanted = "a finite number" if not math.isfinite(number) else implausible(key, number)
    if wanted is not None:
        raise InputError(where, found, wanted)
    return number
