"""Balance in two levels: by hand to within reach of the sliding masses, then by these masses.

Ivanov 2021 section 1: loads are shifted by hand first, then actuators balance what is left. Hands
aim at the target itself, and stop as soon as the masses can correct what is left for sure. So a
person makes as few placings as needed. The masses go on from the posterior of the hands: the
platform as loaded (``known_platform``). The known step of the weights has given it its scale.

Cannot see a weight that slips after the last swing by hand: the masses' own record has to show it.
"""

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np
import scipy

from equipoise.model.errors import InputError
from equipoise.model.hands import Hands
from equipoise.model.reasons.reason import axes_of, one_reason
from equipoise.model.reasons.step_reasons import StepReason
from equipoise.model.step import Step
from equipoise.model.testbed import Testbed
from equipoise.planning.sizing.reachable_set import box_about_home, reach_of
from equipoise.procedure.balancing import balance_manually
from equipoise.procedure.balancing.balance import FIRST_MEASUREMENT, MEASUREMENT
from equipoise.procedure.balancing.balance_manually import HandOptions, balance_by_hand

# chosen: of the reach. The other half lets the masses go below the target first, and brake. With
# 0.75 a person makes 1.24 placings in place of 1.48, but 3 of 25 verdicts, not 1, cannot tell.
SHARE = 0.5
TINY = 1e-9  # m, and -: less than any step of a mass
GO_ON = one_reason(StepReason.MASSES_GO_ON)


def check(testbed: Testbed) -> None:
    """Raise InputError for a testbed that lacks weights, sliding masses or sensors."""
    balance_manually.check(testbed)
    if not testbed.masses:
        wanted = "tables [[sliding_mass]]; or by hand alone, whose weights go on to the target"
        raise InputError(testbed.source or testbed.name, "no sliding masses", wanted)


def within_reach(testbed: Testbed, options: HandOptions) -> HandOptions:
    """Return the aim of the hands: what the masses can correct, and in time.

    Along an axis that no mass shifts, hands have to bring the centre of mass within the tolerance.
    """
    room = SHARE * box_about_home(reach_of(testbed.masses, testbed.body.mass))
    room *= share_in_time(testbed, float(np.linalg.norm(room)))
    return replace(options, tolerance=np.maximum(room, options.tolerance))


def share_in_time(testbed: Testbed, off: float) -> float:
    """Return the share f of an offset (m) that masses correct before the platform is at its stop.

        sqrt(2 theta J / (m g f |off|))  >=  t0 + f T

    Gravity's torque is at most m g f |off|, so a platform let go at level needs the left side at
    least to its tilt limit theta; J is its least moment, t0 the first measurement, T the travel.
    """
    least = float(np.linalg.eigvalsh(testbed.body.inertia_P)[0])
    fall = 2 * testbed.tilt_limit * least / (testbed.weight * max(off, TINY))  # s^2, of all of it
    travel = SHARE * max(max(map(abs, mass.travel)) / mass.speed for mass in testbed.masses)

    def spare(share: float) -> float:
        return float(np.sqrt(fall / share)) - FIRST_MEASUREMENT - MEASUREMENT - share * travel

    return 1.0 if spare(1.0) >= 0 else float(scipy.optimize.brentq(spare, TINY, 1.0))


def hands_then_masses(
    hands: Hands, options: HandOptions, go_on: Callable[[Testbed], Iterator[Step]]
) -> Iterator[Step]:
    """Yield the Steps of the hands and, once they are within reach, those of ``go_on``.

    ``options`` have the tolerance of the whole session. ``go_on`` takes the testbed as known then,
    and returns the steps of the masses on its bench. The last step has the verdict.
    """
    check(hands.testbed)
    coarse, known = within_reach(hands.testbed, options), None
    aim = one_reason(StepReason.HANDS_FIRST, **axes_of("within", coarse.tolerance))
    yield Step("control", hands.time, aim)
    for step in balance_by_hand(hands, coarse):
        known = step.known
        yield step if known is None else replace(step, reasons=(*step.reasons, *GO_ON))
    if known is not None:
        yield from go_on(known)
