"""Identify by a printed method, move the masses by what it found, and again (da Silva 2021, 3.1).

    hang     masses go down until the platform hangs whatever its height is
    swing    masses still; a method estimates the centre of mass from ROWS rows
    move     the masses go by the target less that estimate (after Eqs. 7 and 9, erratum R4), but up
             to SURE sds of its depth below: an inertia that is 10 % off would topple the platform

and so on for ROUNDS swings: "iterative CM compensation" of the review's table 1, with batches as
long as its section 3.1.1 states. The method takes the inertia from the testbed, or what it finds of
it; nothing is kept from one swing to the next.

What it cannot see: what its method leaves out. After the first move the platform hardly swings, and
the height is seen only as far as it still tilts.
"""

from dataclasses import dataclass, replace

from equipoise.control.law import Law, Sample
from equipoise.control.plant.settling import UNREPORTED, Stand, standing
from equipoise.control.plant.swing_estimates import hanging_shift, why_not_shown
from equipoise.model.arrays import Vector3
from equipoise.model.command import Command, Measurement
from equipoise.model.estimate import Estimate
from equipoise.model.law_card import LawCard
from equipoise.model.reasons.law_reasons import LawReason
from equipoise.model.reasons.reason import Reason, one_reason
from equipoise.model.testbed import Testbed

PERIOD = 0.5  # s, chosen: masses take seconds
ROUNDS = 6  # swings, chosen: each leaves at most a fifth of the depth
SURE = 2.0  # sds of the inertia, chosen
ROWS = 500  # of attitudes: "a batch of 500 measurements is sufficient" (section 3.1.1)
SHALLOW = 1e-4  # m, chosen: the least depth of the first swing
ARRIVED = 1.0  # s, chosen: masses that stand so long have arrived


@dataclass(frozen=True, slots=True, eq=False)
class Params:
    """The constants of a run."""

    up: Vector3
    target: Vector3  # m
    kept: float  # -, of the depth, by each move but the last
    measurement: Measurement


@dataclass(frozen=True, slots=True, eq=False)
class State:
    """The progress of the law."""

    shift: Vector3  # m, requested
    swings: int = 0
    stand: Stand = UNREPORTED
    finished: tuple[Reason, ...] = ()


def after_swing(state: State, estimate: Estimate, params: Params) -> State:
    """Return the state with the masses on their way by what the swing showed."""
    swings = state.swings + 1
    state = replace(state, swings=swings, stand=UNREPORTED)
    over = swings == ROUNDS
    if not estimate.outcome.usable:
        return replace(state, finished=why_not_shown(estimate) if over else ())
    off: Vector3 = estimate.com + state.shift - params.target
    below = 0.0 if over else params.kept * max(-float(off @ params.up), 0.0)
    done = one_reason(LawReason.AT_PLACE, swings=swings) if over else ()
    return replace(state, shift=state.shift - off - below * params.up, finished=done)


def step(state: State, sample: Sample | Estimate, params: Params) -> tuple[State, Command]:
    """Return the next state and the command: a move, and a swing once the masses stand."""
    if isinstance(sample, Estimate):
        state = after_swing(state, sample, params)
        return state, Command(shift=state.shift)
    state = replace(state, stand=standing(state.stand, sample))
    if sample.t < state.stand.since + ARRIVED:
        return state, Command(shift=state.shift)
    if state.finished:
        return state, Command(shift=state.shift, finished=state.finished)
    return state, Command(shift=state.shift, measurement=params.measurement)


def compensation(method: str, hold: tuple[str, ...] = ()) -> Law[State, Params]:
    """Return the law that moves masses by what a method finds, with parameters held."""

    def begin(testbed: Testbed, target: Vector3) -> tuple[State, Params]:
        """Return the beginning: masses go down."""
        assert testbed.attitude is not None  # by the card
        hang = hanging_shift(testbed, SHALLOW)[1]
        measurement = Measurement(ROWS / testbed.attitude.rate, method, hold)
        kept = SURE * testbed.inertia_sd
        return State(-hang * testbed.up), Params(testbed.up, target, kept, measurement)

    card = LawCard(
        f"compensation by {method}",
        "A swing, an estimate by a printed method, a move by it; repeated.",
        "da Silva et al. 2021 section 3.1 with erratum R4",
        ("masses", "gyro", "attitude"),
        "the errors of its method at small swings",
        "open loop between moves: always stable",
        PERIOD,
    )
    return Law(card, begin, step)
