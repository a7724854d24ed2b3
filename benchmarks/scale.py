"""``python -m benchmarks.scale``: what many runs cost by each engine, and that none is lost.

Exit code 1 where two workers do less than ``WANTED`` of twice the work of one, or where ten
thousand runs that were killed and resumed are not what they are undisturbed.

Other programs on the machine take from two workers more than from one, so each rate is the median
of several rounds, one and two workers by turns; the processor time of a run stands beside it.
"""

import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from statistics import median
from typing import Any

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
from equipoise.study.method_run import MethodRun, MethodTask, method_runs
from tests.support.killed_run import compared_with_undisturbed

ENGINES = {"this process": ("local", 1), "2 processes": ("local", 2), "Dask, 2": ("dask-local", 2)}
HOUR = 60 * MINUTE
WANTED = 0.85  # of twice the runs of one worker
ROUNDS, RUNS = 5, 40  # chosen: a round takes some seconds
TINY, KEPT, MILLION = 100_000, 10_000, 1_000_000
SCENE = Scene(read_preset("sputnix"), 30.0, [(15.0, {"z1": -0.05})], Options())
console = Console(width=110)


def tasks(seeds: Sequence[int]) -> list[MethodTask]:
    """Return simulated records, each to be identified by the trajectory fit."""
    return [MethodTask(SCENE, ("trajectory",), seed, metered, weighed=False) for seed in seeds]


def timed_runs(task: MethodTask) -> tuple[list[MethodRun], float]:
    """Return a run, and the processor time (s) of all of it."""
    began = time.process_time()
    found = method_runs(task)
    return found, time.process_time() - began


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


def rounds(pools: dict[str, Pool]) -> dict[str, tuple[float, float]]:
    """Return runs a second and processor seconds a run, medians of rounds by turns."""
    rates, processor = {k: list[float]() for k in pools}, {k: list[float]() for k in pools}
    for k in range(-1, ROUNDS):  # in the first one kernels are loaded
        for name, pool in pools.items():
            began = time.perf_counter()
            found = list(spread_over(pool)(timed_runs, tasks(range(1, RUNS + 1))))
            if k >= 0:
                rates[name].append(RUNS / (time.perf_counter() - began))
                processor[name].append(sum(cost for _, cost in found) / RUNS)
    return {name: (median(rates[name]), median(processor[name])) for name in pools}


def show_runs() -> bool:
    """Print runs a second by one and two workers; say whether two are worth as much as wanted."""
    with (
        engine_of("local", 2)() as two,
        engine_of("dask-local", 2)() as dask,
        worker_processes(1) as one,
    ):
        pools = {"1 process": one, "2 processes": two, "Dask, 2": dask}
        found = rounds(pools)
    title = f"Records of {SCENE.duration:g} s simulated and identified (trajectory)"
    table = Table(title=title)
    for column in ("workers", "runs/s", "processor s a run", "hours for 10^6", "of twice one"):
        table.add_column(column, justify="left" if column == "workers" else "right")
    base = {"2 processes": "1 process", "Dask, 2": "1 process"}
    shares = {name: found[name][0] / (2 * found[other][0]) for name, other in base.items()}
    for name, (rate, cost) in found.items():
        share = f"{shares[name]:.0%}" if name in shares else ""
        hours = f"{MILLION / rate / HOUR:.0f}"
        table.add_row(name, f"{rate:.2f}", f"{cost:.3f}", hours, share)
    console.print(table)
    share = shares["2 processes"]
    console.print(f"Two processes: {share:.0%} of twice one (wanted: {WANTED:.0%}).")
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
