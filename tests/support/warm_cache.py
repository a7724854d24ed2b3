"""Compiles the heaviest kernels once, on two cores, before two test workers would each do it.

`make test` runs this first; with a cache that is warm it takes some seconds.
"""

import multiprocessing
from collections.abc import Callable

from equipoise.app.dashboard.runner.live_estimate import LiveEstimate, grown
from equipoise.io.testbed.presets import read_preset
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


def main() -> None:
    """Compile both at once."""
    tasks: tuple[Callable[[], None], ...] = (fit, track)
    workers = [multiprocessing.get_context("spawn").Process(target=task) for task in tasks]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()


if __name__ == "__main__":
    main()
