"""A program that records is killed (SIGKILL) at a random moment; what does its file hold?

The program says on a pipe what it has seen; what it said last is compared with the file.
"""

import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from equipoise.io.recording.recording_file import read_recording
from equipoise.model.recording import Samples
from tests.support.recorded_events import events_of
from verification.recording_child import RATE, rates, turns
from verification.result import Result, Row, Spread, at_most, in_turn

ROOT = Path(__file__).parents[1]
SHORTEST, LONGEST = 0.7, 4.0  # s of recording before the kill; chosen: some chunks, and some not
LOSS = 1.0  # s, what a crash may cost


@dataclass(frozen=True, slots=True)
class Killed:
    """What became of one recording."""

    lost: float  # s, from the last row in the file to the last that the program had
    missing: int  # rows missing before the last one in the file, or with other numbers
    events_lost: int
    rows: int


def killed(seed: int, folder: str | None = None) -> Killed:
    """Let a program record, kill it, and read what it left."""
    with tempfile.TemporaryDirectory(dir=folder) as place:
        path = Path(place) / "run.mcap"
        words = [sys.executable, "-m", "verification.recording_child", str(path), str(seed)]
        with subprocess.Popen(words, stdout=subprocess.PIPE, text=True, cwd=ROOT) as child:
            assert child.stdout is not None
            child.stdout.readline()  # it has begun
            time.sleep(np.random.default_rng(seed).uniform(SHORTEST, LONGEST))
            child.kill()
            said = child.stdout.read().split("\n")[:-1]  # the last line may be half
        return _left(path, said)


def _left(path: Path, said: Sequence[str]) -> Killed:
    last = max(int(line.split()[1]) for line in said if line.startswith("row"))
    reported = [int(line.split()[1]) for line in said if line.startswith("event")]
    recording = read_recording(path)
    kept = [event.data["row"] for event in events_of(path)]
    attitude, rate = recording.attitude, recording.rate
    assert attitude is not None
    assert rate is not None
    missing = _missing(attitude, turns(attitude.t)) + _missing(rate, rates(rate.t))
    end = min(attitude.t[-1], rate.t[-1])
    return Killed(
        lost=last / RATE - float(end),
        missing=missing,
        events_lost=sum(event not in kept for event in reported),
        rows=len(rate),
    )


def _missing(channel: Samples, wanted: np.ndarray) -> int:
    """Return how many rows are not there, up to the last that is, or are not as they were."""
    absent = round(channel.t[-1] * RATE) + 1 - len(channel)
    return absent + int((channel.values != wanted).any(axis=1).sum())


def measure(seeds: Sequence[int], spread: Spread = in_turn) -> Result:
    """Kill as many programs as there are seeds."""
    runs = spread(killed, seeds)
    n = len(runs)
    claim = (
        f"A program that records 200 Hz to MCAP is killed at a random moment, {n} times: nothing "
        "older than one second is lost, no earlier row is missing or changed, and every event "
        "that was told is in the file."
    )
    rows: tuple[Row, ...] = (
        at_most(f"greatest loss of {n} kills, s", max(run.lost for run in runs), LOSS),
        at_most("rows missing or changed before the loss", sum(r.missing for r in runs), 0, "d"),
        at_most("events lost", sum(run.events_lost for run in runs), 0, "d"),
    )
    note = f"{sum(run.rows for run in runs)} rows of each sensor were in the files."
    return Result("killed_recordings", claim, rows, (note,))
