"""Something happens to a command at a random moment: what does it leave, and is what it says true?

A disk that is full, a pipe that nobody reads, `kill -9` of any of its processes, SIGTERM, SIGHUP,
a wall clock that is set by an hour. Half of the moments are drawn by the clock, half by the
operations on files, so that each step of a writing is met. What is left is read by others: masses
by the board itself, recordings and runs by new processes.
"""

import json
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np

from equipoise.io.documents.logbook import open_logbook
from equipoise.io.documents.run_file import text_of_run
from equipoise.io.files.atomic_file import write_whole
from equipoise.io.files.file_content import Content
from equipoise.io.mcap.mcap_recording import time_zero
from equipoise.io.mcap.mcap_salvage import salvaged
from equipoise.io.testbed.presets import preset_text
from equipoise.io.testbed.testbed_file import read_testbed
from equipoise.model.logged_run import LoggedRun, Usability
from verification.emulated_board import TESTBED, answers_of, emulating, goes_on
from verification.result import Result, Row, Spread, at_least, at_most, in_turn
from verification.struck_page import struck_page
from verification.struck_program import (
    DISK_FULL,
    FAULTS,
    FILES,
    FULL_PIPE,
    KILL,
    SIGNALS,
    Moment,
    Struck,
)

LOSS = 1.0  # s, what a kill or a full disk may cost
RUNS = 12  # that are kept, or taken into a logbook
RECORD, OUT = "run.mcap", "written"
MOTION = ("/attitude", "/rate")
BY_HAND = 130


@dataclass(frozen=True, slots=True)
class Ending:
    """How a command ended, and what is wrong with what it left."""

    seed: int
    action: str
    fault: str
    struck: bool  # before it had finished
    wrong: tuple[str, ...]
    lost: float = 0.0  # s of a recording before the fault


@dataclass(frozen=True, slots=True)
class Left:
    """What is there afterwards."""

    folder: Path
    program: Struck
    code: int
    struck: bool
    recorded: int  # bytes of the record when it happened


@dataclass(frozen=True, slots=True)
class Action:
    """A command, what it begins with, moments that are drawn, and what is looked at afterwards."""

    words: tuple[str, ...]
    longest: float  # s, chosen: most of the work
    operations: int  # on files, about as many as there are; 0: the clock draws all moments
    prepare: Callable[[Path], None]
    judge: Callable[[Left], tuple[list[str], float]]
    on_bench: bool = False


def nothing(_folder: Path) -> None:
    """Prepare nothing."""


@cache
def calibration() -> dict[str, str]:
    """Return the files of a calibration: a testbed and a record of moves."""
    drive = '[[truth.drive]]\nmass = "x1"\ngain = 1.05\naxis = [1.0, 0.0, 0.0]\n\n[assumed]'
    with tempfile.TemporaryDirectory() as place:
        bed, record = Path(place) / "my.toml", Path(place) / "run.csv"
        bed.write_text(preset_text("sputnix").replace("[assumed]", drive), encoding="utf-8")
        words = [sys.executable, "-m", "equipoise.app.cli", "simulate", str(bed), "--out",
                 str(record), "--duration-s", "140", "--seed", "8"]  # fmt: skip
        for k, goal in enumerate((10, 20, 0, -20, -10, 0), 1):
            words += ["--move", f"{20 * k}: x1={goal}"]
        subprocess.run(words, check=True, capture_output=True)
        return {path.name: path.read_text(encoding="utf-8") for path in (bed, record)}


def to_calibrate(folder: Path) -> None:
    """Lay down a testbed and a record of moves."""
    for name, text in calibration().items():
        (folder / name).write_text(text, encoding="utf-8")


def to_index(folder: Path) -> None:
    """Lay down runs that no logbook has yet."""
    for k in range(RUNS):
        made = f"2026-01-{k + 1:02d}T09:00:00+00:00"
        run = LoggedRun(f"run-{k}", "identify", made, "plate", "0" * 64, "trajectory", "recording",
                        Usability.USABLE, "Usable.")  # fmt: skip
        (folder / "runs" / run.name).mkdir(parents=True)
        (folder / "runs" / run.name / "run.json").write_text(text_of_run(run))


def of_record(left: Left) -> tuple[list[str], float]:
    """Return what is wrong with the record: it cannot be read, or older rows are lost."""
    path, fault = left.folder / RECORD, left.program.fault
    if not left.recorded:
        return [], 0.0
    found = salvaged(Content.of(path.read_bytes(), str(path)), str(path))
    ids = {each.id for each in found.channels.values() if each.topic in MOTION}
    stamps = np.array([each.log_time for each in found.messages if each.channel_id in ids]) * 1e-9
    wrong = ["less than there was"] * (path.stat().st_size < left.recorded)
    if not len(stamps):  # it was begun within the last second, or all of it is lost
        begun = time_zero(found)
        return wrong, 0.0 if begun is None else max(left.program.at - begun * 1e-9, 0.0)
    if np.ptp(stamps) > left.program.moment.seconds + 120.0:
        wrong.append(f"a span of {np.ptp(stamps):.0f} s")
    # A record that was ended as it should be has lost nothing: what comes after is the report.
    costs = left.struck and fault in (KILL, DISK_FULL) and not found.whole
    return wrong, max(left.program.at - float(stamps.max()), 0.0) if costs else 0.0


def of_bench(left: Left) -> tuple[list[str], float]:
    """Return what is wrong with masses, record and report."""
    wrong, lost = of_record(left)
    answers = answers_of(left.folder)
    if goes_on(answers):
        wrong.append("masses go on: " + "; ".join(answers))
    if (left.folder / OUT).exists():
        try:
            json.loads((left.folder / OUT / "balance.json").read_text())
        except (OSError, ValueError) as error:
            wrong.append(f"a report that is not whole: {error}")
    return wrong, lost


def of_calibration(left: Left) -> tuple[list[str], float]:
    """Return what is wrong with the testbed file: it is the old one, or the new one, whole."""
    text = (left.folder / "my.toml").read_text(encoding="utf-8")
    changed = text != calibration()["my.toml"]
    gain = read_testbed(left.folder / "my.toml").masses[0].gain
    wrong = ["a testbed that is neither old nor new"] * (changed != (gain != 1.0))
    return wrong + ["done, it says, and is not"] * (left.code == 0 and not changed), 0.0


def of_runs(left: Left) -> tuple[list[str], float]:
    """Return what is wrong with kept runs: each is whole or not there, and no more are reported."""
    wrong: list[str] = []
    runs = left.folder / "runs"
    kept = [p for p in runs.glob("*/*") if not p.name.startswith(".")]
    for run in kept:
        whole = {f"{n}.txt": f"{n} " * 3000 for n in range(FILES)}
        if {p.name: p.read_text() if p.is_file() else "" for p in run.iterdir()} != whole:
            wrong.append(f"{run.name} is not whole")
    said = left.program.said.count("kept ")
    return wrong + [f"{said} kept, it says; there are {len(kept)}"] * (said > len(kept)), 0.0


def of_logbook(left: Left) -> tuple[list[str], float]:
    """Return what is wrong with a logbook that is opened again: it has every run."""
    with open_logbook(left.folder / "runs") as book:
        wrong = [f"{book.count()} of {RUNS} runs"] * (book.count() != RUNS)
        return wrong + book.unread, 0.0


ON_BENCH = {
    "record": Action(
        ("record", TESTBED, "--out", RECORD, "--duration-s", "12"),
        12.0, 0, nothing, of_bench, True,
    ),
    "balance --bench": Action(
        ("balance", TESTBED, "--bench", "--yes", "--record", RECORD, "--out", OUT),
        30.0, 60, nothing, of_bench, True,
    ),
}  # fmt: skip
IN_FOLDER = {
    "calibrate --write": Action(
        ("calibrate", "run.csv", "--testbed", "my.toml", "--hold", "inertia_P_zz", "--write",
         "my.toml"), 8.0, 12, to_calibrate, of_calibration,
    ),
    "archive": Action(("archive", str(RUNS)), 0.8, 800, nothing, of_runs),
    "logbook": Action(("logbook", "runs", "--export", "runs.csv"), 1.5, 9, to_index, of_logbook),
}  # fmt: skip
ACTIONS = ON_BENCH | IN_FOLDER
PAGE = "page that records"
NAMES = (*ACTIONS, PAGE)


def struck(seed: int) -> Ending:
    """Begin the command of a seed, let its fault happen, and look at what is left."""
    name, fault = NAMES[seed % len(NAMES)], FAULTS[seed // len(NAMES) % len(FAULTS)]
    rng = np.random.default_rng(seed)
    with tempfile.TemporaryDirectory() as place, ExitStack() as held:
        folder = Path(place)
        if name == PAGE:
            return Ending(seed, name, fault, True, *struck_page(folder, fault, rng))
        action = ACTIONS[name]
        if action.on_bench:
            held.enter_context(emulating(folder, seed))
        action.prepare(folder)
        return _ended(folder, seed, (name, fault), rng)


def _ended(folder: Path, seed: int, kind: tuple[str, str], rng: np.random.Generator) -> Ending:
    name, fault = kind
    action = ACTIONS[name]
    moment = Moment(rng.uniform(0.0, action.longest))
    if action.operations and fault != FULL_PIPE and rng.uniform() < 0.5:
        moment = Moment(operation=int(rng.integers(1, action.operations)))
    program = Struck(folder, action.words, fault, moment)
    program.strike(rng)
    early = program.process.poll() is not None and not moment.operation
    record = folder / RECORD
    recorded = record.stat().st_size if record.exists() else 0
    ended = program.end()
    struck_ = not early and (not moment.operation or "struck" in program.said)
    left = Left(folder, program, program.process.returncode, struck_, recorded)
    wrong = [*([] if ended else ["it has not ended"]), *_said(left)]
    more, lost = action.judge(left)
    return Ending(seed, name, fault, struck_, (*wrong, *more, *_hidden(folder)), lost)


def _said(left: Left) -> list[str]:
    """Return what is wrong with how it ended, and what it said."""
    number = SIGNALS.get(left.program.fault)
    known = {0, 1, 2} | (set() if number is None else {-number, 128 + number})
    wrong = [f"code {left.code}"] * (left.code not in known)
    wrong += ["a traceback: " + left.program.said[-600:]] * ("Traceback" in left.program.said)
    full = left.struck and left.program.fault == DISK_FULL and left.code == 2
    return wrong + ["not a word"] * (full and "equipoise:" not in left.program.said)


def _hidden(folder: Path) -> list[str]:
    """Return what is still hidden once others have written there."""
    wrong: list[str] = []
    for place in (folder, folder / "runs", *folder.glob("runs/[0-9]*"), folder / OUT):
        if place.is_dir():
            write_whole(place / "after.txt", "written by the next one")
            wrong += [f"left: {p.name}" for p in place.glob(".*")]
    return wrong


def measure(seeds: Sequence[int], spread: Spread = in_turn) -> Result:
    """Let as many faults happen as there are seeds."""
    runs = spread(struck, seeds)
    claim = (
        f"{', '.join(NAMES)}: at {len(runs)} random moments one of these happens: "
        f"{', '.join(FAULTS)}. Every mass stands, at most {LOSS:g} s of a recording is lost, each "
        "file is whole or not there, and what command and page say is so."
    )
    wrong, late = ([r for r in runs if r.wrong], [r for r in runs if r.lost > LOSS])
    rows: tuple[Row, ...] = (
        at_most("endings with anything wrong", len(wrong), 0, "d"),
        at_most("greatest loss of a recording, s", max(run.lost for run in runs), LOSS),
        at_least("struck before they had finished", sum(run.struck for run in runs),
                 len(runs) // 2, "d"),
    )  # fmt: skip
    counts = Counter(run.action for run in runs if run.struck)
    shares = ", ".join(f"{name} {number}" for name, number in counts.items())
    notes = [f"Seed {r.seed}, {r.action}, {r.fault}: {'; '.join(r.wrong)}" for r in wrong]
    notes += [f"Seed {r.seed}, {r.action}, {r.fault}: {r.lost:.1f} s lost" for r in late]
    return Result("sudden_faults", claim, rows, (f"Struck: {shares}.", *notes))
