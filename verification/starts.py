"""Case S from a bad start, and from none: the search ends at the optimum all the same.

The optimum is that of the search from a good start. Two ends are one when what they leave of the
record is the same (``SAME``); what is believed beforehand has no part in that.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from equipoise.estimation.output_error.solution import Fitted
from equipoise.estimation.output_error.trajectory import Params, fit
from equipoise.model.arrays import Vector3
from equipoise.model.mass_properties import MassProperties, is_possible
from equipoise.model.testbed import Testbed
from equipoise.procedure.identification.identify import IdentifyOptions, identify
from tests.oracle import cases
from verification.result import Result, Row, Spread, at_least, at_most, in_turn
from verification.stated_errors import stated_errors

SAME = 1.0  # chosen: in chi-square, of some 1800
HALF = 0.5  # of each moment
ASIDE: Vector3 = np.array([0.1e-3, -0.1e-3, -0.3e-3])  # m
WORST = 4.0  # sd
Start = Callable[[cases.Logged, int], Testbed]


class Ended(NamedTuple):
    """Where one search ended."""

    same: bool
    worst: float  # error of com and inertia in the identified record, in stated sd
    usable: bool


def half_off(logged: cases.Logged, seed: int) -> Testbed:
    """Return a testbed whose moments are wrong by up to 50 %, and whose com is elsewhere."""
    rng, truth = np.random.default_rng([seed, 8]), np.diag(logged.truth.inertia_P)
    while True:
        moments = np.diag(truth * (1 + rng.uniform(-HALF, HALF, 3)))
        body = MassProperties(logged.testbed.body.mass, ASIDE, moments)
        if is_possible(body):
            return replace(logged.testbed, body=body, inertia_sd=HALF, com_sd=np.full(3, 3e-4))


def from_nothing(moment: float) -> Start:
    """Return the start of one who knows nothing: a ball of this inertia (kg m^2) about P."""

    def start(logged: cases.Logged, seed: int) -> Testbed:
        body = MassProperties(logged.testbed.body.mass, np.zeros(3), moment * np.eye(3))
        return replace(logged.testbed, body=body, inertia_sd=1.0, com_sd=np.full(3, 5e-4))

    return start


STARTS: dict[str, Start] = {
    "J wrong by 50 %, r = (0.1, -0.1, -0.3) mm": half_off,
    "J = 0.1 kg m2 E, r = 0": from_nothing(0.1),
    "J = 1 kg m2 E, r = 0": from_nothing(1.0),
    "J = 10 kg m2 E, r = 0": from_nothing(10.0),
}


def left(fitted: Fitted) -> float:
    """Return the sum of squared residuals, in sd."""
    return float(np.sum(fitted.at.left_q**2) + np.sum(fitted.at.left_w**2))


def ended(item: tuple[str, int]) -> Ended:
    """Search from one start, and identify."""
    name, seed = item
    logged = cases.case_s(seed)
    bed = STARTS[name](logged, seed)
    good, found = (fit(logged.recording, b, Params()) for b in (logged.testbed, bed))
    same = found.converged and abs(left(found) - left(good)) < SAME
    *_, last = identify(logged.recording, bed, IdentifyOptions("trajectory"))
    estimate = last.estimate
    assert estimate is not None
    worst = float(np.abs(stated_errors(estimate, logged.truth)).max())
    return Ended(same, worst, estimate.outcome.usable)


def rows_of(name: str, seeds: Sequence[int], spread: Spread) -> tuple[Row, ...]:
    """Return the rows of one start."""
    runs = spread(ended, [(name, seed) for seed in seeds])
    n = len(seeds)
    return (
        at_least(f"{name}: searches, of {n}, that end at the optimum",
                 sum(run.same for run in runs), n, "d"),
        at_least(f"{name}: identified and usable", sum(run.usable for run in runs), n, "d"),
        at_most(f"{name}: greatest error / sd", max(run.worst for run in runs), WORST),
    )  # fmt: skip


def measure(seeds: Sequence[int], spread: Spread = in_turn) -> Result:
    """Search Case S from every start, once for each seed."""
    claim = (
        f"Case S (14 kg, camera 5 Hz and 0.2 deg, one move, by MuJoCo), {len(seeds)} seeds: from "
        "an inertia wrong by 50 % and a centre of mass elsewhere, and from no idea of either, the "
        "search ends at the same optimum as from a good start."
    )
    rows = tuple(row for name in STARTS for row in rows_of(name, seeds, spread))
    return Result("starts", claim, rows)
