"""Whole commands as a person types them: processor time and memory of fresh processes.

Each is the child of a small process of its own: the system counts as a child's memory what its
parent held when it began.
"""

import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from statistics import median
from typing import NamedTuple

REPEATS = 5
KIB = 1024.0
STARTED = """
import json, os, subprocess, sys
child = subprocess.Popen(sys.argv[1:], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
_, status, used = os.wait4(child.pid, 0)
code = os.waitstatus_to_exitcode(status)
print(json.dumps([code, used.ru_utime + used.ru_stime, used.ru_maxrss]))
"""
ENDED = (0, 1)  # exit codes of a command that has answered, also where the answer is no
MOVE = "30: x1=-10 y1=-10 z1=-50"
RECORDS = (
    ("simulate", "sputnix", "--out", "run.csv", "--move", MOVE, "--duration-s", "60"),
    ("simulate", "sputnix", "--out", "long.csv", "--move", MOVE, "--duration-s", "600"),
)
OF_A_RECORD = ("run.csv", "--testbed", "sputnix")


class Command(NamedTuple):
    """A command line, and the seconds of processor time that it should take at most."""

    what: str
    words: tuple[str, ...]
    wanted: float


class Cost(NamedTuple):
    """What processes took: medians."""

    processor: float  # s
    memory: float  # MiB, peak


WARM = (
    Command("--help", ("--help",), 0.2),
    Command("simulate", RECORDS[0], 0.6),
    Command("inspect", ("inspect", *OF_A_RECORD), 0.9),
    Command("identify, 601 rows", ("identify", *OF_A_RECORD), 1.0),
    Command("the same with report", ("identify", *OF_A_RECORD, "--out", "identified"), 2.0),
    Command("identify, 6001 rows", ("identify", "long.csv", "--testbed", "sputnix"), 3.0),
    Command("balance", ("balance", "sputnix"), 1.5),
    Command("the same with report", ("balance", "sputnix", "--out", "balanced"), 2.5),
    Command("assess", ("assess", *OF_A_RECORD), 1.5),
    Command("observe", ("observe", *OF_A_RECORD), 1.0),
    Command("design", ("design", "sputnix"), 1.0),
    Command("demo", ("demo",), 4.0),
)
COLD = Command("identify, every kernel compiled first", ("identify", *OF_A_RECORD), 15.0)


def table() -> Iterator[tuple[Command, Cost]]:
    """Yield what commands cost: each after one run that compiles; the last one compiles itself."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for words in RECORDS:
            cost_of(words, folder)
        for command in WARM:
            cost_of(command.words, folder)
            costs = [cost_of(command.words, folder) for _ in range(REPEATS)]
            yield command, Cost(*map(median, zip(*costs, strict=True)))
        yield COLD, cost_of(COLD.words, folder, NUMBA_CACHE_DIR=str(folder / "empty"))


def cost_of(words: tuple[str, ...], folder: Path, **variables: str) -> Cost:
    """Return what one run of a command took."""
    own = {"EQUIPOISE_RUNS": ""} | variables
    line = [sys.executable, "-c", STARTED, sys.executable, "-m", "equipoise", *words]
    ended = subprocess.run(
        line, cwd=folder, env=os.environ | own, check=True, capture_output=True, encoding="utf-8"
    )
    code, processor, memory = json.loads(ended.stdout)
    if code not in ENDED:
        raise RuntimeError(f"{' '.join(words)} failed")
    return Cost(processor, memory / KIB)
