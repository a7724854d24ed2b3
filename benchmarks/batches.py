"""Fits a second of many records that share their times, from no start: in one call, and one by one.

Every number is of the processor's time, which others on the machine do not change much; that of two
cores is of the clock.
"""

import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import NamedTuple

from benchmarks import ours
from benchmarks.others import noisy_copies
from benchmarks.problem import make_problem
from equipoise.estimation.output_error import trajectory
from equipoise.estimation.output_error.kernels.many_records import settle_each
from equipoise.estimation.output_error.monte_carlo.many_fits import (
    ManyFits,
    blind_of,
    fit_each,
    room_for,
    stacked_rows,
)
from equipoise.estimation.output_error.monte_carlo.many_starts import first_points
from equipoise.estimation.output_error.problem import posed
from equipoise.model.recording import Recording

RECORDS, ALONE, REPEATS = 2000, 100, 3
WANTED = 2000.0  # fits a second on two cores
NEAR = 1.0  # rad: every start is descended from


class Batch(NamedTuple):
    """Fits a second, and where the time of a batch goes."""

    alone: float  # one by one
    together: float  # in one call, one thread
    on_two: float  # two threads, by the clock
    of_each: float  # fits a second of processor time, both threads at work
    shares: dict[str, float]  # ms a fit


def least(call: Callable[[], object], clock: Callable[[], float] = time.process_time) -> float:
    """Return the least seconds of several calls."""
    spent: list[float] = []
    for _ in range(REPEATS):
        began = clock()
        call()
        spent.append(clock() - began)
    return min(spent)


def table(count: int = RECORDS) -> Batch:
    """Return what so many fits cost, covariance included."""
    testbed, records = ours.testbed_of(make_problem(1)), noisy_copies(count)
    halves = [records[: count // 2], records[count // 2 :]]

    def one_by_one() -> None:
        for record in records[:ALONE]:
            trajectory.fit(record, testbed, trajectory.Params())

    def settled(half: list[Recording]) -> ManyFits:
        return fit_each(half, testbed)

    def on_two() -> None:
        with ThreadPoolExecutor(2) as pool:
            list(pool.map(settled, halves))

    fit_each(records[:2], testbed)
    one_by_one()
    return Batch(
        min(ALONE, count) / least(one_by_one),
        count / least(lambda: fit_each(records, testbed)),
        count / least(on_two, time.perf_counter),
        count / least(on_two),
        shares(records[:ALONE], testbed),
    )


def shares(records: list[Recording], testbed: ours.Testbed) -> dict[str, float]:
    """Return what starts, the choice between them, passes and steps of a batch take, ms a fit."""
    problem = trajectory.problem_of(records[0], testbed, trajectory.Params())
    rows = stacked_rows(records, "attitude", 4), stacked_rows(records, "rate", 3)
    points, out = first_points(problem, *rows), room_for(problem, len(records))
    given = (posed(problem), blind_of(problem), *rows, points)

    def descents(near: float, most: int) -> float:
        return 1e3 * least(lambda: settle_each(*given, near, most, out)) / len(records)

    starts = 1e3 * least(lambda: first_points(problem, *rows)) / len(records)
    chosen, once, settled = descents(-1.0, 1), descents(NEAR, 1), descents(NEAR, 300)
    passes = float(out.evaluations.mean())
    return {
        "the linear start": starts,
        "two passes without sensitivities, to choose between starts": chosen,
        f"{passes:.1f} passes of {once - chosen:.3f}": passes * (once - chosen),
        "steps between passes": settled - chosen - passes * (once - chosen),
    }
