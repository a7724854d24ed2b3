"""A Kalman filter on the camera, and a move to the target every 25 s, four times (Ivanov 2021).

    filter   x = (q, w, r) from the camera's rows since the start, moves fed (Eq. 5.1)
    move     s = r* - r       every 25 s, whatever the platform does; four times

r is estimated with the masses at home, s is the shift counted from there: each move goes to where
the estimate then says that the centre of mass meets the target. The filter is the method ``ekf_9``
(errata I7-I11); its J is that of the testbed, which the paper has from a fit made before. With
``inertia_sd`` of nought it is the printed filter; else it knows what its J is worth.

There is nothing else: the moment of a move, its size and the tilt that follows are not considered,
and the filter takes r to walk by 0.05 um/sqrt(s), so that it lags behind a steady drift.
"""

from dataclasses import dataclass, replace

from equipoise.control.law import Law, Sample
from equipoise.control.plant.swing_estimates import why_not_shown
from equipoise.model.arrays import Vector3
from equipoise.model.command import Command, Measurement
from equipoise.model.errors import InputError
from equipoise.model.estimate import COM, Estimate
from equipoise.model.law_card import LawCard
from equipoise.model.reasons.law_reasons import LawReason
from equipoise.model.reasons.reason import Reason, one_reason
from equipoise.model.testbed import Testbed

METHOD = "ekf_9"
EVERY, MOVES = 25.0, 4  # s and times, as printed
PERIOD = 1.0  # s, chosen: between looks at the tilt; five rows of the camera
ARRIVAL = 15.0  # s, chosen: for the last move, as masses pass their whole travel in ten


@dataclass(frozen=True, slots=True, eq=False)
class State:
    """The progress of the law."""

    began: float | None = None  # s, of the first sample
    moves: int = 0
    shift: Vector3 | None = None  # m, requested
    finished: tuple[Reason, ...] = ()


def begin(testbed: Testbed, target: Vector3) -> tuple[State, Vector3]:
    """Return the beginning, and the target (m); InputError for a testbed without masses."""
    if not testbed.masses:
        raise InputError("ivanov_25s", "a testbed without them", "sliding masses")
    return State(), target


def after_estimate(state: State, estimate: Estimate, target: Vector3) -> State:
    """Return the state with the masses on their way to where the centre of mass is as wanted."""
    if not estimate.sees(COM):
        return replace(state, finished=why_not_shown(estimate))
    moves = state.moves + 1
    made = one_reason(LawReason.MOVES_MADE, moves=moves) if moves == MOVES else ()
    return replace(state, moves=moves, shift=target - estimate.com, finished=made)


def due_after(moves: int, made: bool) -> float:
    """Return how long after the first sample (s) the next move is due, or the end after the last.

    ``made``: all moves are made. A scalar function, which a micro-controller runs too.
    """
    return EVERY * moves + (ARRIVAL if made else EVERY)


def step(state: State, sample: Sample | Estimate, target: Vector3) -> tuple[State, Command]:
    """Return the next state and the command: every 25 s an estimate, and the move that it asks."""
    if isinstance(sample, Estimate):
        state = after_estimate(state, sample, target)
        return state, Command(shift=state.shift)
    if state.began is None:
        state = replace(state, began=sample.t)
    assert state.began is not None
    left = state.began + due_after(state.moves, bool(state.finished)) - sample.t  # s
    if state.finished and left <= PERIOD:
        return state, Command(shift=state.shift, finished=state.finished)
    if left > PERIOD * 1.5:
        return state, Command(shift=state.shift)
    filtered = Measurement(max(left, PERIOD / 2), METHOD, since=state.began)
    return state, Command(measurement=filtered)


LAW = Law(
    LawCard(
        "ivanov_25s",
        (
            "A Kalman filter estimates attitude, rate and com from the camera; every 25 s "
            "the masses move to the target."
        ),
        "Ivanov et al. 2021, section 5, Eq. 5.1 with errata I7-I11",
        ("masses", "attitude"),
        (
            "a height error proportional to the error of J; drift between moves; the "
            "motor steps; swing"
        ),
        (
            "open loop: always stable. The platform must stay within its tilt limit for "
            "25 s without control"
        ),
        PERIOD,
    ),
    begin,
    step,
)
