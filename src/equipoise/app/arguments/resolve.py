"""From what a person types to objects: a testbed, a recording, moves."""

import re
from dataclasses import replace
from pathlib import Path

from equipoise.actuators.stored_momentum import with_known_inputs
from equipoise.app.arguments.checks import one_of
from equipoise.app.arguments.estimated_terms import Seeking
from equipoise.app.arguments.recording_window import Reading
from equipoise.io.columns.column_map import ColumnMap
from equipoise.io.columns.column_map_file import read_column_map
from equipoise.io.recording.frame_check import check_frame
from equipoise.io.recording.recording_file import read_recording
from equipoise.io.testbed.presets import preset_names, preset_text, read_preset
from equipoise.io.testbed.testbed_file import read_testbed
from equipoise.model.errors import InputError, nearest
from equipoise.model.estimate import COM, INERTIA
from equipoise.model.recording import Recording, arranged, arranged_devices, window
from equipoise.model.testbed import Testbed
from equipoise.model.torque_terms import expand

MOVE = re.compile(r"\s*(?P<time>[^:\s]+)\s*:\s*(?P<goals>\S+=\S+(?:[\s,]+\S+=\S+)*)\s*")
WANTED_MOVE = "'seconds: mass=mm mass=mm', such as '60: x1=-10 z1=-50'"
FEWEST = 3  # rows of a sensor that a window must leave, as when a file is read


def testbed_of(name: str) -> Testbed:
    """Return the testbed of a file, or of a preset when there is no such file."""
    if not Path(name).exists() and name in preset_names():
        return read_preset(name)
    if not Path(name).exists() and Path(name).name == name and not Path(name).suffix:
        wanted = f"a testbed file, or a preset ({nearest(name, list(preset_names()))})"
        raise InputError("testbed", f"'{name}', which is no file", wanted)
    return read_testbed(name)


def testbed_text_of(name: str) -> str:
    """Return the text of a testbed that ``testbed_of`` has read."""
    return Path(name).read_text(encoding="utf-8") if Path(name).exists() else preset_text(name)


def testbed_with_masses(name: str) -> Testbed:
    """Return the testbed of a file or preset; InputError if it has no masses or nothing sees it."""
    testbed = testbed_of(name)
    if not testbed.masses:
        raise InputError(testbed.source, "no sliding masses", "a [[sliding_mass]] at least")
    if testbed.attitude is None and testbed.gyro is None:
        raise InputError(testbed.source, "no sensor", "[sensor.attitude] or [sensor.gyro]")
    return testbed


def recording_of(file: str, reading: Reading) -> Recording:
    """Return a recording as it is, or the part that is asked for."""
    recording = read_recording(file, _columns(reading))
    whole = reading.from_s is None and reading.to_s is None
    return recording if whole else part_of(recording, reading)


def fitting_recording_of(file: str, reading: Reading, testbed: Testbed) -> Recording:
    """Return a recording that fits a testbed: masses and devices are its, gravity points down.

    What is known of times that no sensor saw is left out: a move behind the last row, say.
    """
    recording = read_recording(file, _columns(reading), testbed)
    check_frame(recording, testbed)
    recording = arranged(recording, testbed.mass_names)
    recording = with_known_inputs(arranged_devices(recording, testbed.devices), testbed)
    return part_of(recording, reading)


def spelt_out(seeking: Seeking) -> Seeking:
    """Return what is sought with its composed terms spelt out; unknown names are refused."""
    for name in seeking.hold:
        one_of("--hold", name, [*COM, *INERTIA])
    return replace(seeking, term=expand(seeking.term, "--term"))


def _columns(reading: Reading) -> str | ColumnMap | None:
    if reading.dialect is not None and reading.columns is not None:
        raise InputError("--dialect and --columns", "both", "one of them")
    return reading.dialect if reading.columns is None else read_column_map(reading.columns)


def part_of(recording: Recording, reading: Reading) -> Recording:
    """Return the part between two times; one that is left out stands for the end there is.

    A bench's own record begins where the platform was let go, unless another time is asked for.
    """
    (first, last), start, end = recording.span, reading.from_s, reading.to_s
    start = recording.free_from if start is None else start
    part = window(recording, first if start is None else start, last if end is None else end)
    if max(len(c) for c in (part.attitude, part.rate, ()) if c is not None) < FEWEST:
        found = f"fewer than {FEWEST} rows between --from-s and --to-s"
        raise InputError(recording.source, found, f"times within {first:g} to {last:g} s")
    return part


def move_of(text: str, testbed: Testbed) -> tuple[float, dict[str, float]]:
    """Return time (s) and displacements from home (m) of a move such as '60: x1=-10 z1=-50'."""
    read = MOVE.fullmatch(text)
    if read is None:
        raise InputError("--move", f"'{text}'", WANTED_MOVE)
    pairs = [goal.split("=", 1) for goal in re.split(r"[\s,]+", read["goals"])]
    known = [mass.name for mass in testbed.masses]
    for name, _ in pairs:
        if name not in known:
            wanted = nearest(name, known) if known else "no move: the testbed has no masses"
            raise InputError(f"--move '{text}'", f"mass '{name}'", wanted)
    return _number(read["time"], text), {n: _number(mm, text) * 1e-3 for n, mm in pairs}


def _number(word: str, text: str) -> float:
    try:
        return float(word)
    except ValueError as error:
        raise InputError(f"--move '{text}'", f"'{word}'", "a number") from error
