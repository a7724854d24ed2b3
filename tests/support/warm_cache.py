"""Compiles the heaviest kernels once, on two cores, before two test workers would each do it.

`make test` runs this first; where nothing that is compiled has changed it does nothing.
"""

import multiprocessing
import sys
from collections.abc import Callable
from hashlib import sha256
from pathlib import Path

from equipoise.app.live.live_estimate import LiveEstimate, grown
from equipoise.io.testbed.presets import read_preset
from equipoise.maths.kernels.kernel_cache import PACKAGE, kernels_folder, stamp
from equipoise.procedure.identification.identify import IdentifyOptions, identify
from equipoise.simulation.bench import SimulatedBench

SECONDS = 20.0  # s of a record


def fit() -> None:
    """What the trajectory fit and the filters need."""
    bench = SimulatedBench(read_preset("sputnix"), 1)
    list(identify(bench.read(SECONDS), bench.testbed, IdentifyOptions("trajectory")))
    bed = read_preset("nanosat")
    list(identify(SimulatedBench(bed, 1).read(SECONDS), bed, IdentifyOptions("kf_simplified")))


def track() -> None:
    """What simulation with devices, the tracker, the smoother and tables of rows need."""
    bed = read_preset("nanosat")
    rows = SimulatedBench(bed, 1).read(SECONDS)
    grown(LiveEstimate(bed), rows)
    SimulatedBench(read_preset("reference-table"), 1).read(SECONDS)
    others = "torque_kalman", "torque_tracking", "td_td_rls"
    for name in ("tracker", "momentum_possible", "smoother", *others):
        list(identify(rows, bed, IdentifyOptions(name)))


def mark() -> Path:
    """Return a file that is there when all kernels of these sources have been compiled."""
    sources = [path for path in PACKAGE.rglob("*.py") if b"compiled import" in path.read_bytes()]
    digest = sha256("".join(map(stamp, sorted(sources))).encode())
    return kernels_folder() / f"warm-{sys.version_info.minor}-{digest.hexdigest()[:20]}"


def main() -> None:
    """Compile both at once."""
    if mark().exists():
        return
    tasks: tuple[Callable[[], None], ...] = (fit, track)
    workers = [multiprocessing.get_context("spawn").Process(target=task) for task in tasks]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    if all(worker.exitcode == 0 for worker in workers):
        mark().touch()


if __name__ == "__main__":
    main()
