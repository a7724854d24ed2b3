"""The predicted sd of a manoeuvre: rms over the platforms that may be there.

    sd_i = rms over platforms k of sd_i,k

each platform let go by a hand that errs. It is the expected error, squared and averaged over the
uncertain platforms: a Monte Carlo over them should find the same. A parameter that is unobservable
for one of them has no finite sd.

Whether limits are kept is tried on more platforms, which takes no information. Where all n keep
them, at least 1 - 3 / n of all platforms do (at 95 %).

The sd is that of a fit in the model that the testbed states. Where ``identify`` adds a term, of
torque or camera, it is larger.
"""

from dataclasses import dataclass, replace

import numpy as np

from equipoise.maths.attitude import leaning, to_matrix
from equipoise.model.arrays import Floats, Vector3
from equipoise.model.estimate import BODY
from equipoise.model.manoeuvre import Manoeuvre
from equipoise.model.mass_properties import MassProperties
from equipoise.model.reasons.reason import Reason, distinct
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed
from equipoise.planning.manoeuvre.limit_check import course_of, for_search, peaks
from equipoise.planning.manoeuvre.noiseless_record import imagined, known_side
from equipoise.planning.manoeuvre.plan import Wish
from equipoise.planning.manoeuvre.predicted_information import (
    Predicted,
    at_truth,
    posed,
    prediction,
)
from equipoise.planning.manoeuvre.scenario import Scenario, let_go, platforms_of, scenarios

PLATFORMS = 240  # chosen: of 60 the rms changed by up to a third, by the few with the largest sd
TRIED = 300  # chosen: if all keep the limits, then 99 % of all platforms do
FRESH = 1  # added to the seed of a search: platforms that it did not use


@dataclass(frozen=True, slots=True, eq=False)
class Promise:
    """The prediction for a manoeuvre."""

    manoeuvre: Manoeuvre
    names: tuple[str, ...]
    sds: Floats  # SI, (platforms, names); infinite: unobservable; 0: held
    body: MassProperties  # that is expected
    expected: Predicted  # of it, let go as planned
    tried: int  # platforms of which only the motion was followed
    kept: int  # of them, within the limits of tilt and rate
    greatest_tilt: float  # rad, of them
    greatest_rate: float  # rad/s
    unobservable: tuple[Reason, ...]  # directions

    @property
    def platforms(self) -> int:
        """Return of how many platforms the sd are."""
        return len(self.sds)

    @property
    def sd(self) -> Floats:
        """Return the rms over platforms, SI; infinite: unobservable for one of them; 0: held."""
        return np.sqrt(np.mean(self.sds**2, axis=0))

    def sd_of(self, names: tuple[str, ...]) -> Floats:
        """Return several sd, SI."""
        return self.sd[[self.names.index(name) for name in names]]

    @property
    def keeps(self) -> bool:
        """Say whether all platforms that were tried keep within the limits."""
        return self.kept == self.tried


def peaks_of(
    testbed: Testbed, manoeuvre: Manoeuvre, wish: Wish, rng: np.random.Generator
) -> Floats:
    """Return the greatest tilt (rad) and rate (rad/s) of platforms that no search has used."""
    others = scenarios(wish.prior, TRIED + 1, rng)[1:]
    stiff = for_search(testbed)
    return peaks(stiff, course_of(stiff, manoeuvre, wish.params.fineness), platforms_of(others))


def met(manoeuvre: Manoeuvre, scenario: Scenario, up: Vector3) -> Manoeuvre:
    """Return a manoeuvre as a hand that errs begins it."""
    q0 = leaning(up, manoeuvre.low_side, manoeuvre.tilt)
    q, rate = let_go(q0, manoeuvre, scenario.lean, scenario.push, up)
    down = -to_matrix(q)[2]
    sinks = down - (down @ up) * up
    size = float(np.linalg.norm(sinks))
    return replace(
        manoeuvre,
        tilt=float(np.arctan2(size, -down @ up)),
        low_side=sinks / size if size > 0 else manoeuvre.low_side,
        rate=rate,
    )


def predicted_of(
    scenario: Scenario, testbed: Testbed, manoeuvre: Manoeuvre, wish: Wish, reported: Recording
) -> Predicted:
    """Return the prediction for one platform; ``reported``: the manoeuvre's known side."""
    begun = met(manoeuvre, scenario, testbed.up)
    observed = imagined(testbed, scenario.body, begun, reported)
    problem = posed(observed, testbed, wish.params, wish.known)
    fitted = at_truth(problem, observed, scenario.body, begun, wish.known)
    return prediction(fitted, observed, testbed)


def promise(
    testbed: Testbed, manoeuvre: Manoeuvre, wish: Wish, seed: int, rate_limit: float
) -> Promise:
    """Return the prediction for a manoeuvre on platforms that no search has used.

    ``rate_limit`` in rad/s; the limit of tilt is the testbed's.
    """
    rng = np.random.default_rng(seed + FRESH)
    reported = known_side(testbed, manoeuvre)
    drawn = scenarios(wish.prior, PLATFORMS + 1, rng)
    said = [predicted_of(scenario, testbed, manoeuvre, wish, reported) for scenario in drawn]
    expected, others = said[0], said[1:]
    tilts, rates = peaks_of(testbed, manoeuvre, wish, rng).T
    return Promise(
        manoeuvre,
        BODY,
        np.array([one.sd_of(BODY) for one in others]),
        wish.prior.body,
        expected,
        len(tilts),
        int(np.sum((tilts <= testbed.tilt_limit) & (rates <= rate_limit))),
        float(tilts.max()),
        float(rates.max()),
        distinct(reason for one in said for reason in one.unobservable),
    )


def times_better(before: Promise, after: Promise, names: tuple[str, ...]) -> Floats:
    """Return the ratio of the first sd to the second; held on both sides: 1."""
    first, second = before.sd_of(names), after.sd_of(names)
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.where(first == second, 1.0, first / second)
