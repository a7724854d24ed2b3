"""Ten thousand pieces of work, killed in the middle (kill -9), resumed, and compared."""

import os
import signal
import subprocess
import sys
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

from equipoise.app.engine.spread import spread_over
from equipoise.app.engine.worker_processes import worker_processes
from tests.support.dask_cluster import is_alive, until
from tests.support.many_pieces import MANY, kept_in, noted, pair, pieces_in

BEGUN = 3  # files of results, chosen: the run is under way


@dataclass(frozen=True)
class Resumed:
    """What became of the pieces."""

    count: int
    kept: int  # by the run that was killed
    lost: int  # neither kept nor computed again
    doubled: int  # kept, and computed again all the same, or computed twice
    equal: bool  # to the undisturbed run, to the last bit


def children_of(process: int) -> list[int]:
    return [int(each) for task in Path(f"/proc/{process}/task").iterdir()
            for each in (task / "children").read_text().split()]  # fmt: skip


def killed(folder: Path) -> None:
    """Begin the work, kill the program as soon as results are kept; its workers end with it."""
    words = [sys.executable, "-m", "tests.support.many_pieces", str(folder)]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    program = subprocess.Popen(words, env=environment, stderr=subprocess.DEVNULL)
    until(lambda: len(list((folder / "kept").glob("results-*.parquet"))) >= BEGUN)
    workers = children_of(program.pid)
    program.send_signal(signal.SIGKILL)
    assert program.wait() == -signal.SIGKILL
    assert len(workers) >= 2
    until(lambda: not any(is_alive(each) for each in workers))


def computed(folder: Path, name: str) -> Counter[int]:
    """Return how often each piece was computed, as its line in a file says."""
    return Counter(int(line) for line in (folder / name).read_text().split())


def compared_with_undisturbed(folder: Path) -> Resumed:
    """Return what became of a run that was killed and resumed."""
    killed(folder)
    kept = set(kept_in(folder).found(pieces_in(folder, "second.txt")))
    with worker_processes(2) as pool:
        spread = spread_over(pool, kept=kept_in(folder))
        found = list(spread(noted, pieces_in(folder, "second.txt")))
    again = computed(folder, "second.txt")
    return Resumed(
        count=MANY,
        kept=len(kept),
        lost=len(set(range(MANY)) - kept - set(again)),
        doubled=len(kept & set(again)) + sum(times - 1 for times in again.values()),
        equal=found == [pair(k) for k in range(MANY)],
    )
