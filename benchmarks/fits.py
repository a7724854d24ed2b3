"""One record, one start, every fitter, in one run of one process."""

from dataclasses import dataclass

import numpy as np

from benchmarks import ours, peers_casadi, peers_jax, peers_mujoco, peers_scipy
from benchmarks.problem import PeerFit, Point, Problem, make_problem, offset_of

WANTED_SCIPY, WANTED_MUJOCO, WANTED_PEER = 2000.0, 5000.0, 10.0  # times ours


@dataclass(frozen=True, slots=True)
class Row:
    """One line of the table."""

    name: str
    seconds: float
    setup: float
    evaluations: int
    separation: float  # greatest distance from our optimum, in sd


def distance(problem: Problem, a: Point, b: Point, sd_x: np.ndarray) -> float:
    """Return the greatest difference of two optima in standard deviations."""
    return float(np.max(np.abs(offset_of(problem.start, a) - offset_of(problem.start, b)) / sd_x))


def peers(problem: Problem, quick: bool) -> tuple[list[PeerFit], list[str]]:
    """Return the peers' fits, and a sentence for each that could not run."""
    calls = [peers_scipy.fit(problem)]
    if not quick:
        calls.append(peers_scipy.fit(problem, "RK45", 1e-10, 1e-12))
    calls += [peers_jax.fit(problem), peers_casadi.fit(problem)]
    if not quick:
        calls.append(peers_mujoco.fit(problem))  # a minute
    return [fit for fit, _ in calls if fit], [text for fit, text in calls if fit is None]


def table(seed: int = 1, quick: bool = False) -> tuple[list[Row], list[str]]:
    """Return the rows, ours first, and what could not be run."""
    problem = make_problem(seed)
    mine, seconds, _ = ours.fit(problem, given_start=True)
    alone, alone_seconds, _ = ours.fit(problem, given_start=False)
    point = ours.point_of(problem, mine)
    others, missing = peers(problem, quick)
    sd = np.sqrt(np.diag(others[0].covariance))
    rows = [
        Row("Equipoise, from the peers' start", seconds, 0.0, mine.evaluations, 0.0),
        Row("Equipoise, from no start", alone_seconds, 0.0, alone.evaluations,
            distance(problem, point, ours.point_of(problem, alone), sd)),
    ]  # fmt: skip
    names = {"SciPy DOP853": "SciPy DOP853, rtol 1e-8", "SciPy RK45": "SciPy RK45, rtol 1e-10"}
    rows += [
        Row(names.get(fit.name, fit.name), fit.seconds, fit.setup_seconds, fit.iterations,
            distance(problem, point, fit.point, sd))
        for fit in others
    ]  # fmt: skip
    return rows, missing
