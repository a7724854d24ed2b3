"""``python -m benchmarks.scale``: what many runs cost by each engine, and that none is lost.

Exit code 1 where two workers are worth less than ``WANTED`` of twice one, or where ten thousand
runs that were killed and resumed are not what they are undisturbed.

    worth = busy times p1 / p2

``busy`` is the share of the time in which workers have a run in hands, p the processor time of a
run by one and by two workers: the seam costs the first, workers that are in each other's way the
second. Neither changes much with what else the machine does, as rates do: ``of twice one``, the
ratio of rates, says the same only on a machine that does nothing else. All are medians of rounds,
one and two workers by turns.
"""

import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from statistics import median
from typing import Any, NamedTuple

import numpy as np
from rich.console import Console
from rich.table import Table

from equipoise.app.engine.choice import engine_of
from equipoise.app.engine.kept_results import KeptResults
from equipoise.app.engine.pool import Pool
from equipoise.app.engine.record_text import text_of
from equipoise.app.engine.spread import spread_over
from equipoise.app.engine.worker_processes import worker_processes
from equipoise.app.runs.comparison import metered
from equipoise.estimation.method_contract import Options
from equipoise.io.testbed.presets import read_preset
from equipoise.model.units import MINUTE
from equipoise.study.method_record import Scene
from equipoise.study.method_run import MethodTask, method_runs
from tests.support.killed_run import compared_with_undisturbed
from verification.compared import hanging

ENGINES = {"this process": ("local", 1), "2 processes": ("local", 2), "Dask, 2": ("dask-local", 2)}
HOUR = 60 * MINUTE
WANTED = 0.85  # of twice the runs of one worker
ROUNDS, RUNS = 3, 40  # chosen: a round takes some seconds
TINY, KEPT, MILLION = 100_000, 10_000, 1_000_000
# Platforms within the stop: no method models it, and a search there takes seconds.
SCENE = Scene(hanging(read_preset("sputnix")), 30.0, [(15.0, {"z1": -0.05})], Options())
console = Console(width=110)


def tasks(seeds: Sequence[int]) -> list[MethodTask]:
    """Return simulated records, each to be identified by the trajectory fit."""
    return [MethodTask(SCENE, ("trajectory",), seed, metered, weighed=False) for seed in seeds]


class Spent(NamedTuple):
    """The time (s) of a run on the clock and on the processor, all of it."""

    clock: float
    processor: float


def spent(task: MethodTask) -> Spent:
    """Do a run, and return the time that it took."""
    began = time.perf_counter(), time.process_time()
    method_runs(task)
    return Spent(time.perf_counter() - began[0], time.process_time() - began[1])


def seconds_of(pool: Pool, work: Callable[[Any], Any], pieces: Sequence[Any]) -> float:
    """Return the time (s) that pieces take."""
    began = time.perf_counter()
    for _ in spread_over(pool)(work, pieces):
        pass
    return time.perf_counter() - began


def show_overhead() -> None:
    """Print what an engine takes to begin, and for a piece that takes nothing."""
    table = Table(title=f"{TINY:,} pieces that take no time")
    for title in ("engine", "to begin, s", "us a piece", "s for 10^6"):
        table.add_column(title, justify="left" if title == "engine" else "right")
    for name, engine in ENGINES.items():
        began = time.perf_counter()
        with engine_of(*engine)() as pool:
            seconds_of(pool, abs, range(4))
            begun = time.perf_counter() - began
            each = seconds_of(pool, abs, range(TINY)) / TINY
        table.add_row(name, f"{begun:.1f}", f"{each * 1e6:.1f}", f"{each * MILLION:.0f}")
    console.print(table)


class Rate(NamedTuple):
    """Runs a second, the share of the time in which workers are busy, processor s a run."""

    rate: float
    busy: float
    processor: float


def one_round(pool: Pool, workers: int) -> Rate:
    """Return what some runs come to."""
    began = time.perf_counter()
    each = list(spread_over(pool)(spent, tasks(range(1, RUNS + 1))))
    clock = time.perf_counter() - began
    busy = sum(run.clock for run in each) / (workers * clock)
    return Rate(RUNS / clock, busy, sum(run.processor for run in each) / RUNS)


def medians(pools: dict[str, tuple[Pool, int]]) -> dict[str, Rate]:
    """Return the medians of rounds by turns; in one before them kernels are loaded."""
    found = [{name: one_round(*pool) for name, pool in pools.items()} for _ in range(ROUNDS + 1)]
    return {
        name: Rate(*map(median, zip(*(each[name] for each in found[1:]), strict=True)))
        for name in pools
    }


def show_runs() -> bool:
    """Print runs a second by one and two workers; say whether two are worth as much as wanted."""
    with (
        worker_processes(1) as one,
        worker_processes(2) as two,
        engine_of("dask-local", 2)() as dask,
    ):
        found = medians({"1 process": (one, 1), "2 processes": (two, 2), "Dask, 2": (dask, 2)})
    table = Table(title=f"Records of {SCENE.duration:g} s simulated and identified (trajectory)")
    for column in ("workers", "runs/s", "processor s a run", "busy", "worth", "of twice one",
                   "processor hours for 10^6"):  # fmt: skip
        table.add_column(column, justify="left" if column == "workers" else "right")
    first, worth = found["1 process"], dict[str, float]()
    for name, (rate, busy, processor) in found.items():
        worth[name] = busy * first.processor / processor
        twice = "" if name == "1 process" else f"{rate / (2 * first.rate):.0%}"
        hours = f"{MILLION * processor / HOUR:.0f}"
        table.add_row(name, f"{rate:.2f}", f"{processor:.3f}", f"{busy:.0%}",
                      f"{worth[name]:.0%}", twice, hours)  # fmt: skip
    console.print(table)
    share = worth["2 processes"]
    console.print(f"Two processes are worth {share:.0%} of twice one (wanted: {WANTED:.0%}).")
    return share >= WANTED


def show_kept() -> None:
    """Print what a result takes in a file, and how long it takes to write and to read it."""
    (run,), rng = method_runs(tasks([1])[0]), np.random.default_rng(1)
    runs = [
        [replace(run, seed=k, error=e, sd=s, bound=b)]
        for k, (e, s, b) in enumerate(rng.normal(size=(KEPT, 3, 9)))
    ]
    pieces = list(enumerate(runs))
    with tempfile.TemporaryDirectory() as folder:
        kept = KeptResults(Path(folder), {}, lambda piece: f"seed {piece[0]}", console.print)
        began = time.perf_counter()
        with kept.keeping() as keep:
            for piece in pieces:
                keep(piece, piece[1])
        written = time.perf_counter() - began
        files = list(Path(folder).glob("*.parquet"))
        began = time.perf_counter()
        assert len(kept.found(pieces)) == len(pieces)
        read = time.perf_counter() - began
        size = sum(file.stat().st_size for file in files)
    console.print(
        f"Kept results: {len(text_of(runs[0]))} bytes of text, {size / len(pieces):.0f} bytes in a "
        f"file; {written / len(pieces) * 1e3:.2f} ms to write one, {read / len(pieces) * 1e3:.2f} "
        f"ms to read it; {len(files)} files."
    )


def show_resumed() -> bool:
    """Print what became of ten thousand runs that were killed and resumed."""
    with tempfile.TemporaryDirectory() as folder:
        found = compared_with_undisturbed(Path(folder))
    console.print(
        f"Killed (kill -9) with {found.kept} of {found.count} kept; {found.lost} lost, "
        f"{found.doubled} computed again; equal to the undisturbed run: {found.equal}."
    )
    return found.lost == found.doubled == 0 and found.equal


def main() -> int:
    """Print everything; 1 where something is not as wanted."""
    show_overhead()
    show_kept()
    good = [show_resumed(), show_runs()]
    return 0 if all(good) else 1


if __name__ == "__main__":
    sys.exit(main())
