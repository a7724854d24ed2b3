"""A program whose children write runs into a logbook until they are killed, one after the other.

Prints for each: how many runs were whole, and whether the index agreed and was sound.
"""

import os
import random
import signal
import sqlite3
import sys
import time
from pathlib import Path

from equipoise.io.documents.logbook import INDEX, open_logbook
from equipoise.io.documents.run_file import text_of_run
from equipoise.io.documents.run_folder import TESTBED
from equipoise.io.files.atomic_file import write_folder
from equipoise.model.estimate import Parameter
from equipoise.model.logged_run import RUN, LoggedRun
from equipoise.model.verdict import VerdictOutcome


def run(made_at="2026-03-01T12:00:00+01:00", **more) -> LoggedRun:
    """Return a run with numbers, one of them unobservable."""
    home = (
        Parameter("com_x", "m", 1.25e-6, 1e-7),
        Parameter("com_z", "m", -1e-4, float("inf"), observable=False),
    )
    known = {
        "name": "", "kind": "balance", "platform": "Mock-up", "configuration": "c1",
        "method": "measure_and_move", "bench": "simulated",
        "outcome": VerdictOutcome.PASSED,
        "sentence": "Good.",
        "parameters": home, "standing": home[:1], "provenance": {"seed": "1"},
    }  # fmt: skip
    return LoggedRun(made_at=made_at, **(known | more))


def put(folder: Path, name: str, entry: LoggedRun, testbed: str = "name = 'Mock-up'\n") -> None:
    """Write a run's folder, its entry last."""
    write_folder(folder / name, {TESTBED: testbed, "a.txt": "x", RUN: text_of_run(entry)})


def write_for_ever(folder: Path, child: int, said: int) -> None:
    for k in range(10**9):
        put(folder, f"run{child:03d}-{k:05d}", run())
        with open_logbook(folder):
            pass
        if k == 0:
            os.write(said, b"!")


def trial(folder: Path, child: int, delay: float) -> str:
    """Kill one that writes, at a moment after its first run: a slow disk writes that one too."""
    received, said = os.pipe()
    pid = os.fork()
    if pid == 0:
        os.close(received)
        write_for_ever(folder, child, said)
    os.close(said)
    assert os.read(received, 1) == b"!"
    os.close(received)
    time.sleep(delay)
    os.kill(pid, signal.SIGKILL)
    os.waitpid(pid, 0)
    index = sqlite3.connect(folder / INDEX)
    sound = index.execute("PRAGMA integrity_check").fetchone()[0]
    numbers = "(SELECT total(length(data)) FROM numbers WHERE run = runs.id)"  # 3 with their sd
    halves = index.execute(f"SELECT count(*) FROM runs WHERE {numbers} <> 48").fetchone()[0]
    index.close()
    whole = {path.parent.name for path in folder.glob(f"*/{RUN}")}
    with open_logbook(folder) as book:
        listed = {entry.name for entry in book.runs()}
        unread = len(book.unread)
    return f"{len(whole)} {listed == whole and not unread} {sound == 'ok' and halves == 0}"


if __name__ == "__main__":
    there = Path(sys.argv[1])
    with open_logbook(there):
        pass
    draw = random.Random(1)
    for child in range(int(sys.argv[2])):
        print(trial(there, child, draw.uniform(0.0, 0.05)), flush=True)  # noqa: T201
