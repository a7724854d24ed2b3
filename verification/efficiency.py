"""The trajectory fit beside the Cramer-Rao bound, and its intervals beside the truth."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from equipoise.estimation import trajectory
from equipoise.estimation.conclusion import conclude
from equipoise.estimation.unknowns import JP, RATE, TURN, R, physical
from equipoise.maths.attitude import difference
from equipoise.model.estimate import NORMAL_95
from verification import paper_runs
from verification.chance import FULL, nees_band, ratio_limits, share_band
from verification.result import Result, Row, Spread, at_most, between, in_turn

MEAN, GREATEST = 1.1, 1.2  # RMSE / bound
COVER = (0.92, 0.98)
JUDGED = [*range(R.start, R.stop), *range(JP.start, JP.stop), *range(RATE.start, RATE.stop)]

Array = NDArray[np.float64]


class Run(NamedTuple):
    """One record fitted."""

    error: Array  # estimate - truth, physical coordinates
    stated: Array  # covariance as reported
    bound: Array  # inverse information at the truth
    names: tuple[str, ...]


def fitted(seed: int) -> Run:
    """Fit one record from the linear start."""
    recording, q0 = paper_runs.run(seed)
    found = trajectory.fit(recording, paper_runs.testbed(), trajectory.Params())
    problem = found.problem
    truth = physical(paper_runs.true_point(q0), problem.mass, problem.layout)
    error = physical(found.point, problem.mass, problem.layout) - truth
    error[TURN] = difference(found.point.q0, q0)
    names = problem.layout.names
    stated = conclude(found, trajectory.METHOD, recording).covariance_of(names)
    return Run(error, stated, np.linalg.inv(paper_runs.information(problem, q0)), names)


def ratio_rows(runs: Sequence[Run]) -> tuple[Row, ...]:
    """Return RMSE over bound. Each error counts in units of its own run's bound."""
    error = np.array([run.error / np.sqrt(np.diag(run.bound)) for run in runs])
    ratio = np.sqrt(np.mean(error**2, axis=0))[JUDGED]
    worst = int(np.argmax(ratio))
    few = len(runs) < FULL
    chance = ratio_limits(runs[0].bound[np.ix_(JUDGED, JUDGED)], len(runs)) if few else (0.0, 0.0)
    name = runs[0].names[JUDGED[worst]]
    return (
        at_most("RMSE / bound, mean over r, J, w0", float(ratio.mean()), max(MEAN, chance[0])),
        at_most(
            f"RMSE / bound, greatest ({name})", float(ratio[worst]), max(GREATEST, chance[1])
        ),
    )


def cover_rows(runs: Sequence[Run]) -> tuple[Row, ...]:
    """Return how often the 95 % intervals hold the truth."""
    z = np.array([run.error / np.sqrt(np.diag(run.stated)) for run in runs])
    inside = np.abs(z) < NORMAL_95
    each, names, n = inside.mean(axis=0), runs[0].names, len(runs)
    low, high = int(np.argmin(each)), int(np.argmax(each))
    band = share_band(COVER, 0.95, n, len(each))
    return (
        between("95 % intervals hold the truth, all", float(inside.mean()), COVER, ".1%"),
        between(f"the same, least ({names[low]})", float(each[low]), band, ".1%"),
        between(f"the same, most ({names[high]})", float(each[high]), band, ".1%"),
    )


def scale_note(runs: Sequence[Run]) -> str:
    """Return the RMSE in plain units."""
    rmse = np.sqrt(np.mean(np.array([run.error for run in runs]) ** 2, axis=0))
    com = ", ".join(f"{1e6 * v:.3f}" for v in rmse[R])
    inertia = ", ".join(f"{v:.4f}" for v in rmse[JP])
    return f"RMSE: r {com} um; J xx yy zz xy xz yz {inertia} kg m2."


def measure(seeds: Sequence[int], spread: Spread = in_turn) -> Result:
    """Fit one record for each seed."""
    runs = spread(fitted, seeds)
    nees = [run.error @ np.linalg.solve(run.stated, run.error) for run in runs]
    size = len(runs[0].error)
    rows = (
        *ratio_rows(runs),
        *cover_rows(runs),
        between(f"mean NEES, {size} unknowns", float(np.mean(nees)), nees_band(size, len(runs))),
    )
    claim = (
        f"Camera alone (5 Hz, 0.2 deg), 120 s, one exact move, start tilted 3-5 deg, {len(runs)} "
        "seeds: errors are at the Cramer-Rao bound and the stated intervals hold the truth."
    )
    return Result("efficiency", claim, rows, (scale_note(runs),))
