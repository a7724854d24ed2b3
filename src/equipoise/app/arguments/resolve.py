"""From what a person types to objects: a testbed, a recording, moves."""

import re
from dataclasses import replace
from pathlib import Path

from equipoise.app.arguments import inputs
from equipoise.app.arguments.checks import one_of
from equipoise.app.arguments.estimated_terms import Seeking
from equipoise.app.arguments.recording_window import Reading
from equipoise.io.columns.column_map import ColumnMap
from equipoise.io.columns.column_map_file import read_column_map
from equipoise.io.recording.recording_file import read_recording
from equipoise.io.testbed.presets import preset_text
from equipoise.model.errors import InputError, nearest
from equipoise.model.estimate import COM, INERTIA
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed
from equipoise.model.torque_terms import expand
from equipoise.model.units import MM

MOVE = re.compile(r"\s*(?P<time>[^:\s]+)\s*:\s*(?P<goals>\S+=\S+(?:[\s,]+\S+=\S+)*)\s*")
WANTED_MOVE = "'seconds: mass=mm mass=mm', such as '60: x1=-10 z1=-50'"


def testbed_of(name: str) -> Testbed:
    """Return the testbed of a file, or of a preset when there is no such file."""
    return inputs.testbed_from(name)


def testbed_text_of(name: str) -> str:
    """Return the text of a testbed that ``testbed_of`` has read."""
    return Path(name).read_text(encoding="utf-8") if Path(name).exists() else preset_text(name)


def recording_of(file: str, reading: Reading) -> Recording:
    """Return a recording as it is, or the part that is asked for."""
    recording = read_recording(file, _columns(reading))
    whole = reading.from_s is None and reading.to_s is None
    return recording if whole else inputs.part_of(recording, reading.from_s, reading.to_s)


def fitting_recording_of(file: str, reading: Reading, testbed: Testbed) -> Recording:
    """Return the part asked for of a recording that fits a testbed."""
    recording = read_recording(file, _columns(reading), testbed)
    return inputs.part_of(inputs.fitted(recording, testbed), reading.from_s, reading.to_s)


def spelt_out(seeking: Seeking) -> Seeking:
    """Return what is sought with its composed terms spelt out; unknown names are refused."""
    for name in seeking.hold:
        one_of("--hold", name, [*COM, *INERTIA])
    return replace(seeking, term=expand(seeking.term, "--term"))


def _columns(reading: Reading) -> str | ColumnMap | None:
    if reading.dialect is not None and reading.columns is not None:
        raise InputError("--dialect and --columns", "both", "one of them")
    return reading.dialect if reading.columns is None else read_column_map(reading.columns)


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
    return _number(read["time"], text), {n: _number(mm, text) * MM for n, mm in pairs}


def _number(word: str, text: str) -> float:
    try:
        return float(word)
    except ValueError as error:
        raise InputError(f"--move '{text}'", f"'{word}'", "a number") from error
