"""What a person gets who gives a file to `inspect` and `import`, judged against what is right."""

import re
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from equipoise.io.columns.read_options import ReadOptions
from equipoise.io.recording.recording_file import read_recording
from equipoise.model.arrays import Matrix3, Series1
from equipoise.model.recording import Recording, Samples
from tests.support.recordings.recorded_motion import Motion
from tests.support.recordings.same_motion import EYE, LEVEL, axes_of, departure, turn_between
from tests.support.recordings.variant import Reads, Refused, Variant


@dataclass(frozen=True, slots=True)
class Printed:
    """What a command left."""

    code: int
    out: str
    err: str


Command = Callable[..., Printed]
OUT = "imported.csv"


@dataclass(frozen=True, slots=True)
class Desk:
    """Where a person works."""

    motion: Motion
    folder: Path
    equipoise: Command
    whole: bool = True  # what was imported is inspected too

    def imported(self, path: Path, *options: str) -> Printed:
        """Return what `import` prints for a testbed whose z is up."""
        out = ("--testbed", "nanosat", "--out", self.folder / OUT)
        return self.equipoise("import", path, *out, *options)


def fault_of(variant: Variant, desk: Desk) -> str:
    """Return what is wrong with the program's answer, '' if it is right."""
    path, answer = variant.write(desk.motion, desk.folder), variant.answer
    if isinstance(answer, Refused):
        return _not_refused(answer, path, desk)
    if answer.by == "inspect":
        return _not_inspected(answer, path, desk) or _not_imported(answer, path, desk)
    inspected = desk.equipoise("inspect", path, *answer.options)
    if not _says(answer.inspected, inspected):
        return f"inspect does not say {answer.inspected!r}: {inspected}"
    return _not_imported(answer, path, desk)


def _not_inspected(answer: Reads, path: Path, desk: Desk) -> str:
    inspected = desk.equipoise("inspect", path, *answer.options)
    if inspected.code:
        return f"inspect: {inspected}"
    read = read_recording(path, _options(answer))
    return _unsaid(answer.said, inspected) or differs(read, desk.motion, answer)


def _not_imported(answer: Reads, path: Path, desk: Desk) -> str:
    """Return what is wrong with what `import` writes, and with how `inspect` finds that."""
    printed = desk.imported(path, *answer.options)
    if printed.code:
        return f"import: {printed}"
    recording = read_recording(desk.folder / OUT)
    fault = _unsaid(answer.said, printed) or differs(recording, desk.motion, answer)
    if fault:
        return f"import: {fault}; {printed}"
    inspected = desk.equipoise("inspect", desk.folder / OUT) if desk.whole else printed
    return "" if not inspected.code else f"inspect of what was imported: {inspected}"


def _not_refused(answer: Refused, path: Path, desk: Desk) -> str:
    for command in answer.by:
        run = desk.imported if command == "import" else partial(desk.equipoise, command)
        printed = run(path, *answer.options)
        words = _plain(printed)
        missing = [p for p in (answer.cause, answer.remedy) if not re.search(p, words)]
        if not printed.code or missing or (desk.folder / OUT).exists():
            return f"{command} ends with {printed.code} and does not say {missing}: {words}"
    return ""


def differs(recording: Recording, motion: Motion, answer: Reads) -> str:
    """Return in what a recording is not the motion, '' if it is."""
    attitude, rate = recording.attitude, recording.rate
    present = tuple(
        name for name, each in (("attitude", attitude), ("rate", rate)) if each is not None
    )
    if present != answer.sensors:
        return f"sensors {present}"
    axes, fault = [EYE], ""
    if attitude is not None:
        axes, fault = _axes(attitude, motion, answer)
    return fault or ("" if rate is None else _other_rates(rate, motion, answer, axes))


def _axes(attitude: Samples, motion: Motion, answer: Reads) -> tuple[list[Matrix3], str]:
    """Return the names of axes under which the attitude is the motion's, or what is wrong."""
    rows = np.delete(np.arange(len(motion.t)), answer.lost)
    if fault := _other_rows(attitude, motion.t[rows], answer.time):
        return [], f"attitude: {fault}"
    allowed = LEVEL if answer.renamed else [EYE]
    found = axes_of(attitude.values, motion.q[rows], answer.turn, allowed)
    turns = turn_between(attitude.values, motion.q[rows], EYE)
    other = f"other attitudes, by {departure(turns):.3g} rad; L {turns[0].round(3).tolist()}"
    return [S for S, _ in found], "" if found else other


def _other_rates(rate: Samples, motion: Motion, answer: Reads, axes: list[Matrix3]) -> str:
    lost = answer.lost if answer.rate_lost is None else answer.rate_lost
    rows = np.delete(np.arange(len(motion.t)), lost)
    if fault := _other_rows(rate, motion.t[rows], answer.time):
        return f"rate: {fault}"
    off = min(float(np.abs(rate.values @ S - motion.w[rows]).max()) for S in axes)
    return "" if off <= answer.rate else f"other rates, by {off:.3g} rad/s"


def _other_rows(channel: Samples, t: Series1, within: float) -> str:
    if len(channel) != len(t):
        return f"{len(channel)} rows, not {len(t)}"
    off = np.abs(channel.t - channel.t[0] - (t - t[0])).max()
    return "" if off <= within else f"other times, by {off:.3g} s"


def _options(answer: Reads) -> ReadOptions:
    stated = dict(zip(answer.options[::2], answer.options[1::2], strict=True))
    share = {"bad_rows": float(stated["--bad-rows"])} if "--bad-rows" in stated else {}
    return ReadOptions(body=stated.get("--body"), **share)


def _plain(printed: Printed) -> str:
    return " ".join(f"{printed.out} {printed.err}".split())


def _says(pattern: str, printed: Printed) -> bool:
    return re.search(pattern, _plain(printed)) is not None


def _unsaid(pattern: str, printed: Printed) -> str:
    return "" if _says(pattern, printed) else f"not said: {pattern!r} in {_plain(printed)}"
