"""Every command that computes, once, on a short record: then all kernels are compiled.

Each runs as a process of its own, several at once; a kernel that two of them need is compiled by
one while the other waits (``maths.kernels.kernel_lock``).
"""

import shlex
import subprocess
import sys
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path

from equipoise.model.errors import InputError

RECORDS = (
    'simulate sputnix --out driven.csv --duration-s 20 --move "10: x1=-10 y1=-10 z1=-50"',
    "simulate nanosat --out free.csv --duration-s 20",
    "simulate reference-table --out wheels.csv --duration-s 5",
)
COMMANDS = (
    "identify driven.csv --testbed sputnix",  # compiles longest: it begins first
    "identify free.csv --testbed nanosat --method tracker",
    "identify free.csv --testbed nanosat --method kf_simplified",
    "identify free.csv --testbed nanosat --method torque_kalman",
    "identify free.csv --testbed nanosat --method torque_tracking",
    "identify free.csv --testbed nanosat --method td_td_rls",
    "identify free.csv --testbed nanosat --method momentum_possible",
    "identify free.csv --testbed nanosat --method smoother",
    "identify wheels.csv --testbed reference-table",
    "inspect driven.csv --testbed sputnix",
    "balance sputnix --seed 1",
    "plan sputnix --prior-record driven.csv",
    "design sputnix --record-s 20",
)
MOST = 900.0  # s, chosen: a command that takes longer hangs
SPOKE = (0, 1)  # exit codes: done; done, with a verdict that did not pass


def rehearsed(folder: Path, workers: int) -> Iterator[str]:
    """Yield the commands as they end, run in a folder that may be emptied afterwards."""
    with ThreadPoolExecutor(workers) as pool:
        for lines in (RECORDS, COMMANDS):
            yield from pool.map(partial(_run, folder), lines)


def _run(folder: Path, line: str) -> str:
    words = [sys.executable, "-m", "equipoise", *shlex.split(line)]
    ended = subprocess.run(
        words, cwd=folder, capture_output=True, text=True, timeout=MOST, check=False
    )
    if ended.returncode not in SPOKE:
        found = f"exit code {ended.returncode}: {ended.stderr[-300:]}"
        raise InputError(f"equipoise {line}", found, "0 or 1")
    return line
