"""Tracker, simulator, cost against length, throughput on all cores."""

import os
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from typing import Any

import numpy as np

from benchmarks import ours
from benchmarks.counted_numbers import kernels_called
from benchmarks.problem import make_problem
from equipoise.estimation.output_error import trajectory
from equipoise.estimation.output_error.segment_jumps import walk
from equipoise.estimation.output_error.solution import evaluate
from equipoise.estimation.tracker import tracker
from equipoise.io.testbed.presets import read_preset
from equipoise.maths.attitude import exponential, multiply
from equipoise.maths.kernels.compiled import Kernel
from equipoise.model.estimate import RATE
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import AttitudeSensor
from equipoise.simulation.bench import SimulatedBench
from tests.support.peak_memory import forget_peak, peak_mb


def tracker_step() -> tuple[float, float]:
    """Return the median microseconds of a row of a 601-row record, and how often each is passed.

    The inertia is known to 20 % only: the tracker passes rows again where its estimate moves.
    """
    problem = make_problem(1)
    recording, testbed = ours.recording_of(problem), ours.testbed_of(problem)
    state, rows = tracker.first_state(0.0, problem.q_meas[0], testbed), len(problem.t) - 1
    walked = 0

    def call(called: Kernel, *arguments: Any) -> Any:
        nonlocal walked
        found = called.compiled(*arguments)
        if called.py_func.__name__ == "run_filter":
            walked += found - arguments[2].first
        return found

    def track() -> tracker.Track:
        return tracker.track(recording, testbed, tracker.Params(), state)

    with kernels_called(call):
        track()
    _, seconds = ours.timed(track, 30)
    return 1e6 * seconds / rows, walked / rows


def simulator(length: float) -> float:
    """Return how many times faster than real time the preset runs, camera rows included."""
    bench = SimulatedBench(read_preset("sputnix"), 3)
    bench.move({"x1": 0.01, "z1": -0.02})
    bench.read(length)
    best = min(_seconds(lambda: bench.read(length)) for _ in range(9))
    return length / best


def _seconds(call) -> float:
    began = time.perf_counter()
    call()
    return time.perf_counter() - began


def record_of(rows: int) -> tuple[Recording, ours.Testbed]:
    """Return a camera record of that many rows at 100 Hz, masses moved half-way."""
    bench = replace(read_preset("sputnix"), attitude=AttitudeSensor(100.0, np.radians(0.05)))
    seconds = (rows - 1) / 100.0
    simulated = SimulatedBench(bench, 3)
    first = simulated.read(seconds / 2)
    simulated.move({"x1": -0.01, "y1": -0.01, "z1": -0.05})
    from equipoise.model.recording import join

    return join(first, simulated.read(seconds / 2)), bench


def length_row(rows: int, separation: float | None = None) -> tuple[int, float, float]:
    """Return rows, seconds of one pass (residuals and normal equations), and what it held (MB).

    ``separation``: time between cuts at which the rate may jump, s; None: an uncut trajectory.
    """
    forget_peak()
    recording, testbed = record_of(rows)
    cuts = (
        np.zeros(0)
        if separation is None
        else np.arange(separation, recording.span[1] - separation, separation)
    )
    params = trajectory.Params(jumps=walk(cuts, RATE, np.full(3, 1e-5)))
    problem = trajectory.problem_of(recording, testbed, params)
    assert recording.attitude is not None
    point = ours.unknowns_of(make_problem(1), make_problem(1).start)
    point = replace(point, error=np.zeros(len(problem.layout.errors)))
    evaluate(problem, point)
    seconds = min(_seconds(lambda: evaluate(problem, point)) for _ in range(3))
    return rows, seconds, peak_mb()


def noisy_copies(count: int) -> list[Recording]:
    """Return the bench's record with fresh noise, many times over."""
    recording = ours.recording_of(make_problem(1))
    assert recording.attitude is not None
    rng = np.random.default_rng(7)
    q = recording.attitude.values
    return [
        replace(recording, attitude=Samples(
            recording.attitude.t,
            multiply(q, exponential(rng.normal(0, 1e-3, (len(q), 3))))))
        for _ in range(count)
    ]  # fmt: skip


def throughput(given_start: bool, count: int = 200) -> tuple[float, float]:
    """Return fits per second in one thread and on all cores, the better of three times."""
    problem = make_problem(1)
    testbed, copies = ours.testbed_of(problem), noisy_copies(count)
    guess = ours.unknowns_of(problem, problem.start) if given_start else None

    def one(recording: Recording) -> float:
        return trajectory.fit(recording, testbed, trajectory.Params(), guess).at.cost

    one(copies[0])
    alone = min(_seconds(lambda: [one(r) for r in copies]) for _ in range(3))
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        together = min(_seconds(lambda: list(pool.map(one, copies))) for _ in range(3))
    return count / alone, count / together
