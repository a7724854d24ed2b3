"""How near the kernels are to the limit of one core: operations, time, share of the peak.

Operations are counted by running the Python of a kernel with numbers that count
(``counted_numbers``); the time is that of the same call, compiled. The peak is that of fused
multiply-adds in registers, measured beside them: polynomials by Horner's rule, DEGREE of them for
each number loaded, over numbers that stay in the first cache.
"""

import time
from collections.abc import Callable
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from benchmarks import ours
from benchmarks.counted_numbers import kernels_called, operations
from benchmarks.problem import make_problem
from equipoise.estimation.output_error import trajectory
from equipoise.estimation.output_error.solution import evaluate
from equipoise.estimation.tracker import tracker
from equipoise.estimation.tracker.filter_kernel import run_filter
from equipoise.estimation.tracker.kernel_records import Carried, Place, Walk, Written
from equipoise.estimation.tracker.measurements import rows_of
from equipoise.estimation.tracker.mixture import EVENT
from equipoise.estimation.tracker.relinearisation import first_memory
from equipoise.estimation.tracker.stored_covariance import SIZE
from equipoise.io.testbed.presets import read_preset
from equipoise.maths.kernels.compiled import Kernel, kernel, part
from equipoise.model.arrays import Floats
from equipoise.model.recording import window
from equipoise.simulation.bench import SimulatedBench

FIT_ROWS, ROWS, LENGTH = 400, 100, 10.0  # rows; s of simulated time
REPEATS = 60  # of each time, of which the least counts: others use the machine, too
DEGREE, RESIDENT = 16, 1024  # of the polynomials; numbers, 8 KiB


class Share(NamedTuple):
    """What a row or a step of a kernel costs."""

    what: str
    operations: float
    seconds: float
    peak: float  # operations a second

    @property
    def of_peak(self) -> float:
        """Return the share of the peak."""
        return self.operations / self.seconds / self.peak


@part
def eight_times(v: float, a: float, b: float) -> float:
    """Return v a + b, eight times over."""
    v = v * a + b
    v = v * a + b
    v = v * a + b
    v = v * a + b
    v = v * a + b
    v = v * a + b
    v = v * a + b
    return v * a + b


@kernel
def polynomials(x: Floats, a: float, b: float, times: int) -> float:
    """Evaluate polynomials of degree DEGREE in ``a`` at many beginnings, many times."""
    for _ in range(times):
        for j in range(x.shape[0]):
            x[j] = eight_times(eight_times(x[j], a, b), a, b)
    return x[0]


def peak() -> float:
    """Return the operations a second of one core: two for each fused multiply-add."""
    x, times = np.linspace(0.1, 0.9, RESIDENT), 20
    seconds = seconds_within(lambda: polynomials(x, 0.5, 0.25, times), "polynomials")
    return 2.0 * DEGREE * RESIDENT * times / seconds


def seconds_within(run: Callable[[], Any], name: str) -> float:
    """Return the least seconds that a kernel takes within ``run``, Python left out."""
    spent: list[float] = []

    def call(called: Kernel, *arguments: Any) -> Any:
        began = time.perf_counter()
        found = called.compiled(*arguments)
        if called.py_func.__name__ == name:
            spent.append(time.perf_counter() - began)
        return found

    with kernels_called(call):
        for _ in range(REPEATS):
            run()
    return min(spent)


def fit_pass(rows: int) -> Callable[[], Any]:
    """Return a pass of the fit over so many rows of the peers' record."""
    problem = make_problem(1)
    testbed = ours.testbed_of(problem)
    record = window(ours.recording_of(problem), 0.0, (rows - 0.5) / 5.0)
    posed = trajectory.problem_of(record, testbed, trajectory.Params())
    point = ours.unknowns_of(problem, problem.start)
    point = replace(point, error=np.zeros(len(posed.layout.errors)))
    return lambda: evaluate(posed, point)


def tracker_rows(rows: int, again: bool) -> Callable[[], Any]:
    """Return a walk of the tracker's kernel along so many rows, ``again`` or for the first time."""
    problem = make_problem(1)
    recording, testbed = ours.recording_of(problem), ours.testbed_of(problem)
    state = tracker.first_state(0.0, problem.q_meas[0], testbed)
    model = tracker.model_of(recording, testbed, tracker.Params(), state)
    parts = (state.q, state.rate, state.com, tracker.pack_symmetric(state.inertia_P), state.bias)
    place = Place(np.concatenate(parts), state.covariance)
    taken = rows_of(recording, testbed, True, 0.0, 0.0)
    out = np.zeros((rows, 2 + len(place.posterior) + SIZE))

    def walk() -> None:
        memory = first_memory(place, taken)
        written = Written(out, np.zeros((1, EVENT)), np.zeros(3, np.int64))
        carried = Carried(place.copy(), memory.levels, memory.watch)
        way = Walk(0, rows, rows, False, again, not again)
        run_filter(model, taken, way, memory.point, carried, written)

    return walk


def simulated(length: float) -> Callable[[], Any]:
    """Return a reading of the simulated platform, so many seconds long."""
    bench = SimulatedBench(read_preset("sputnix"), 3)
    return lambda: bench.read(length)


def share_of(what: str, run: Callable[[], Any], name: str, unit: str | int, peak: float) -> Share:
    """Return what a kernel costs for each of so many rows, or for each call of a function."""
    counted, calls = operations(run, name)
    units = calls[unit] if isinstance(unit, str) else unit
    return Share(what, counted / units, seconds_within(run, name) / units, peak)


def table() -> tuple[float, list[Share]]:
    """Return the peak of a core (operations a second), and what is reached of it."""
    most = peak()
    return most, [
        share_of("fit, a row of a pass", fit_pass(FIT_ROWS), "descend", FIT_ROWS, most),
        share_of("tracker, a row", tracker_rows(ROWS, False), "run_filter", ROWS, most),
        share_of("tracker, a row passed again", tracker_rows(ROWS, True), "run_filter", ROWS, most),
        share_of("simulator, a step", simulated(LENGTH), "_run", "step", most),
    ]
