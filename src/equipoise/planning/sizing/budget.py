"""The expected residual torque after measurements and moves, line by line.

    tau^2 = (m g)^2 tr( mean(e e^T) mean(E - n n^T) ) + sum of the squares of all else

root mean square over directions n of gravity within a tilt of level, e being the offsets that
measurements and moves leave. Each cause has a line; the causes are correlated, so their squares may
sum to a little more or less than those of e.

Platforms as the testbed states them are measured for the length of a record and moved, so many
times (``move_error``). A measurement of covariance P of offsets of covariance L estimates an offset
e by

    f = (1 - P / L) e + noise,    so that e - f has the covariance P and is uncorrelated with f

the first time by f = e + noise, as the prior is wide. Lines are the mean squares of the errors of
the last measurement and the last move, and the effects of room, deck and bearing (``environment``).
Platforms that the masses cannot bring to the target are left out; ``within`` is how many they can.

Platforms are drawn as evenly as chance would draw them: points of a scrambled Sobol sequence,
turned into normal numbers. They are the same each time, and a mean over them is nearer to the
expected value than one over as many random numbers.

Measurements are assumed to have the error that a fit of their record predicts, and no other.
"""

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
import scipy

from equipoise.model.arrays import Bools, Matrix3, Series, Series3
from equipoise.planning.sizing.case import Case
from equipoise.planning.sizing.environment import air_in_measurement, surrounding_lines
from equipoise.planning.sizing.expected_torque import REQUESTED, TESTBED, Line, expected_torque
from equipoise.planning.sizing.measurement_bound import MeasurementBound, first_bound, later_bound
from equipoise.planning.sizing.move_error import Left, Standing, at_home, move
from equipoise.planning.sizing.reachable_set import Reach, contains, reach_of, tolerance

MANY, SOME = 13, 9  # powers of 2, chosen: offsets to count those within reach; to move
FEWEST = 32  # chosen: offsets within reach by which a move is judged
EDGE = 1e-9  # chosen: normal numbers stay within six sd


class Balanced(NamedTuple):
    """Measurements, and what the last of the moves left of each platform."""

    first: MeasurementBound
    last: MeasurementBound
    standing: Standing
    left: Left


@dataclass(frozen=True, slots=True, eq=False)
class Budget:
    """The residual torque, and the share of platforms within reach."""

    lines: tuple[Line, ...]  # the largest first
    torque: float  # N m, rms, of all together
    within: float  # share of platforms, as stated, that the masses can bring to the target
    first: MeasurementBound
    last: MeasurementBound
    standing: Standing  # after the last move
    left: Left


def budget_of(case: Case) -> Budget:
    """Return the budget after all measurements and moves."""
    testbed = case.testbed
    reach = reach_of(testbed.masses, testbed.body.mass)
    along, across = spans(reach)
    done = balanced(case, reach)
    left, beyond = done.left, done.standing.error @ across
    of_offsets = [
        offset_line(case, "out of reach", "Offset that no mass can shift", mean_square(beyond)),
        offset_line(case, "measurement", "Error of the measured centre of mass",
                    along @ done.last.com @ along),
        offset_line(case, "steps", "Smallest step of the masses", mean_square(left.steps @ along)),
        offset_line(case, "stops", "Positioning accuracy of the masses", mean_square(left.stops)),
        offset_line(case, "backlash", "Backlash of the masses", mean_square(left.backlash)),
        offset_line(case, "rails", "Misalignment of the rails", mean_square(left.rails)),
    ]  # fmt: skip
    around = surrounding_lines(testbed, case.around, case.tilt)
    others = [target_line(case), air_in_measurement(case.around, case.measurement_time), *around]
    there = [line for line in (*of_offsets, *others) if line.torque > 0]
    offsets = expected_torque(testbed, mean_square(done.standing.error), case.tilt)
    torque = float(np.linalg.norm([offsets, *(line.torque for line in others)]))
    within = share_within(reach, stated_offsets(case, even_normals(MANY, 3)))
    return Budget(tuple(sorted(there, key=lambda line: -line.torque)), torque, within, *done)


def spans(reach: Reach) -> tuple[Matrix3, Matrix3]:
    """Return the projections along what masses can shift, and across it."""
    along: Matrix3 = reach.span @ reach.span.T
    return along, np.eye(3) - along if reach.rank < 3 else np.zeros((3, 3))


def mean_square(rows: Series3) -> Matrix3:
    """Return the mean of r r^T."""
    return rows.T @ rows / len(rows)


def balanced(case: Case, reach: Reach) -> Balanced:
    """Return the measurements, and what the last move leaves."""
    testbed, k = case.testbed, len(case.testbed.masses)
    normals = even_normals(SOME, 3 + 2 * k + case.moves * (3 + k))
    start, rest = normals[:, : 3 + 2 * k], normals[:, 3 + 2 * k :]
    kept, offsets = platforms(case, reach, start[:, :3])
    draws = np.split(rest[kept], case.moves, axis=1)
    first = last = first_bound(testbed, case.measurement_time)
    standing = at_home(testbed, offsets, start[kept, 3:], case.rail_lean)
    found = offsets + with_covariance(draws[0][:, :3], first.com)
    standing, left = move(testbed, standing, found, draws[0][:, 3:], case.rail_lean)
    for draw in draws[1:]:
        before = mean_square(standing.error)
        last = later_bound(testbed, case.measurement_time, case.target, replace(last, com=before))
        found = estimated(standing.error, before, last.com, draw[:, :3])
        standing, left = move(testbed, standing, found, draw[:, 3:], case.rail_lean)
    return Balanced(first, last, standing, left)


def estimated(error: Series3, before: Matrix3, after: Matrix3, normals: Series) -> Series3:
    """Return the estimates of errors of a prior and a posterior covariance, m^2."""
    share: Matrix3 = np.eye(3) - np.linalg.solve(before, after)
    return error @ share + with_covariance(normals, after @ share)


def platforms(case: Case, reach: Reach, normals: Series) -> tuple[Bools, Series3]:
    """Return which rows are platforms within reach, and their offsets from the target (m).

    Where hardly any is, platforms within half of the reach stand for them.
    """
    offsets = stated_offsets(case, normals)
    kept = within_reach(reach, offsets)
    if np.sum(kept) >= FEWEST:
        return kept, offsets[kept]
    along, _ = spans(reach)
    near = 0.5 / 3 * tolerance(reach) * normals @ along
    return np.ones(len(near), dtype=np.bool_), near


def offset_line(case: Case, name: str, cause: str, moment: Matrix3) -> Line:
    """Return the line of an offset of the centre of mass."""
    return Line(name, cause, expected_torque(case.testbed, moment, case.tilt), moment, TESTBED)


def target_line(case: Case) -> Line:
    """Return the line of a target that is not the centre of rotation."""
    moment: Matrix3 = np.outer(case.target, case.target)
    torque = expected_torque(case.testbed, moment, case.tilt)
    return Line(
        "target",
        "Distance of the target from the centre of rotation",
        torque,
        moment,
        REQUESTED,
    )


def even_normals(power: int, columns: int) -> Series:
    """Return 2^power rows of standard normal numbers in so many independent columns."""
    points = scipy.stats.qmc.Sobol(columns, scramble=True, seed=0).random_base2(power)
    return scipy.special.ndtri(np.clip(points, EDGE, 1 - EDGE))


def stated_offsets(case: Case, normals: Series) -> Series3:
    """Return where the centre of mass of platforms is, as stated, from the target (m)."""
    return case.testbed.body.com - case.target + case.testbed.com_sd * normals


def with_covariance(normals: Series, covariance: Matrix3) -> Series3:
    """Return vectors of this covariance (m^2)."""
    values, vectors = np.linalg.eigh(covariance)
    return normals * np.sqrt(np.maximum(values, 0.0)) @ vectors.T


def within_reach(reach: Reach, offsets: Series3) -> Bools:
    """Say of each offset (m) whether masses can undo all of it that lies along their span."""
    return contains(reach, -offsets @ reach.span @ reach.span.T)


def share_within(reach: Reach, offsets: Series3) -> float:
    """Return which share of offsets (m) can be undone."""
    return float(np.mean(contains(reach, -offsets)))
