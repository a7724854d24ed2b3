"""Balance: measure, move, measure, until the verdict passes or there is a reason to stop.

One fit uses the whole record, moves included, so that every measurement adds to the last. A move is
made when the estimate is precise enough for it to help, or when waiting would let the platform tilt
too far. (Ivanov 2021 section 5 moves every 25 s; this moves when it pays.)
"""

from collections.abc import Generator
from dataclasses import dataclass, replace

import numpy as np

from equipoise.actuators.sliding_masses import shift_by
from equipoise.estimation.model_selection.survey_reasons import reasons_of_added
from equipoise.model.arrays import Vector3
from equipoise.model.bench import Bench
from equipoise.model.move import Move
from equipoise.model.reasons.reason import Reason, axes_of, one_reason
from equipoise.model.reasons.step_reasons import MoveReason, StepReason
from equipoise.model.reasons.verdict_reasons import VerdictReason
from equipoise.model.recording import Recording, join
from equipoise.model.step import Step
from equipoise.model.testbed import Testbed
from equipoise.model.verdict import Verdict
from equipoise.procedure.steps.choose_move import DOWN, Option, good_moment, option_for, safest
from equipoise.procedure.steps.displacement_choice import displacements_for, gain_by_one
from equipoise.procedure.steps.joint_fit import Knowledge, learn, settled, stood, without_stops
from equipoise.procedure.steps.plain_steps import com_step, measurement_step, verdict_step
from equipoise.procedure.steps.planned_move import planned_move, stops_covariance
from equipoise.procedure.steps.tilt_guard import tilted
from equipoise.procedure.steps.tilt_prediction import Outlook, state_now
from equipoise.procedure.steps.verify import Aim, fresh_enough, is_known, is_within, verdict


@dataclass(frozen=True, slots=True, eq=False)
class BalanceOptions(Aim):
    """The aim, and the moves and the time that may be spent."""

    max_moves: int = 3
    max_time: float = 120.0  # s on the bench's clock
    closeness: float = 1.0  # share of the tolerance that what is uncertain may take

    @property
    def close(self) -> Vector3:
        """Return the tolerance (m) for what is uncertain, the offset left out."""
        return self.closeness * self.tolerance


FIRST_MEASUREMENT = 1.6  # s, before anything is fitted
NOTABLE = 20e-6  # m below the target, beyond what a motor step leaves
DEEPER = 80e-6  # m, the least way down
MEASUREMENT = 0.4  # s between fits
KNOWN = 0.3  # of the tolerance: an sd at which a move is worth making
AWAY = 0.1  # of the offset: the same for the first move, which is to learn from
BACK = 0.03  # of the offset, chosen: for later ones, since time spent below determines the height
INFORMED = 0.3  # of the offset: a sideways sd at which the direction of a move is known
FIRM = 0.99  # probability of being within tolerance at which to leave a move unused
SPENT = 0.98  # the same with no move left, or no time for one; a verdict passes from 0.975
TRIM = 0.3  # of the tolerance: an offset that the last move, when its time comes, is spent on
LATEST = 0.97  # of the time, less SETTLE: when the last move is made at the latest
LAST = 0.25  # of the tolerance: the same for the last move
HELPS = 0.9  # of the predicted tilt, chosen: that a move against tilting must reach
SETTLE = 20.0  # s to keep for the measurement after the last move
RETURN = 45.0  # s, chosen: to keep for a way below, a stay there, the way back and SETTLE


@dataclass(frozen=True, slots=True, eq=False)
class Progress:
    """Where the procedure stands."""

    knowledge: Knowledge
    moves: tuple[Move, ...] = ()
    still_since: float = 0.0  # s, when the last move ended
    braking: bool = False


def balance(
    bench: Bench, options: BalanceOptions, before: Recording | None = None
) -> Generator[Step, None, Knowledge]:
    """Yield Steps; the last is a verification, or a stop that says why, with a verdict.

    The record that this bench made ``before`` counts with what is recorded from now on. The
    generator returns the final knowledge.
    """
    began = bench.time
    fresh = bench.read(FIRST_MEASUREMENT)
    if before is not None:
        fresh = join(before, fresh)
    progress = Progress(learn(None, fresh, bench.testbed, options.budget), still_since=began)
    yield measurement_step(bench.time, fresh)
    stated: tuple[str, ...] = ()
    while True:
        if progress.knowledge.found != stated:
            stated = progress.knowledge.found
            yield com_step(bench.time, progress.knowledge, reasons_of_added(stated))
        why = reason_to_stop(bench, progress, options, began)
        if why is not None:
            known = settled(progress.knowledge, bench.testbed, options.budget)
            progress = replace(progress, knowledge=known)
            why = reason_to_stop(bench, progress, options, began)
        if why is not None:
            bench.stop()
            yield final(bench, progress, options, why)
            return progress.knowledge
        decided = decide(bench, progress, options, began)
        if decided is None:
            fresh = bench.read(MEASUREMENT)
            knowledge = learn(progress.knowledge, fresh, bench.testbed, options.budget)
            progress = replace(progress, knowledge=knowledge)
            continue
        yield com_step(bench.time, progress.knowledge)
        (option, reason), knowledge = decided, progress.knowledge
        now = knowledge.displacement
        posterior = without_stops(knowledge, bench.testbed, option.targets != now)
        move = planned_move(bench.testbed, now, option.targets, posterior, reason)
        yield Step("move", bench.time, announced(move), move=move)
        bench.move(move.targets)
        fresh = bench.read(move.duration + MEASUREMENT)
        knowledge = learn(progress.knowledge, fresh, bench.testbed, options.budget)
        still = bench.time - MEASUREMENT
        progress = Progress(knowledge, (*progress.moves, move), still, option.brake)
        yield measurement_step(bench.time, fresh)


def reason_to_stop(
    bench: Bench, progress: Progress, options: BalanceOptions, began: float
) -> StepReason | None:
    """Return why to stop now, or None."""
    knowledge = progress.knowledge
    if tilted(knowledge.recording, bench.testbed, began):
        return StepReason.TILTED
    judged = fresh_enough(knowledge, progress.still_since) and not progress.braking
    movable = len(progress.moves) < options.max_moves
    early = bench.time - began < LATEST * (options.max_time - SETTLE)
    sure = FIRM if movable and early else SPENT
    if judged and is_within(knowledge, options, sure) and is_known(knowledge, options.close, sure):
        return StepReason.WITHIN_TOLERANCE
    if judged and not knowledge.estimate.outcome.usable and bench.time - began > SETTLE:
        return StepReason.ESTIMATE_UNUSABLE
    if bench.time - began + MEASUREMENT > options.max_time:
        return StepReason.TIME_USED_UP
    outside = np.abs(knowledge.com - options.target) - 2 * knowledge.sd > options.tolerance
    hopeless = judged and bool(outside.any())
    if hopeless and not movable:
        return StepReason.MOVES_USED_UP
    stuck = hopeless and not comes_nearer(knowledge, bench.testbed, options)
    return StepReason.NEAREST if stuck else None


def comes_nearer(knowledge: Knowledge, testbed: Testbed, options: BalanceOptions) -> bool:
    """Say whether the masses have travel left that brings the centre of mass nearer.

    By TRIM of the tolerance along an axis at least. A gain of three times that, summed over the
    axes, is enough for one of them; so mostly no search for the best move of all is needed.
    """
    off, least = options.target - knowledge.com, TRIM * options.tolerance
    now = knowledge.displacement
    if gain_by_one(testbed, now, off) > 3 * float(least.max()):
        return True
    errors = stood(knowledge, testbed)
    goal = displacements_for(testbed, now, off, stood=errors)
    left = off - shift_by(testbed, goal - now - errors * (goal != now))
    return bool(np.any(np.abs(off) - np.abs(left) > least))


def decide(
    bench: Bench, progress: Progress, options: BalanceOptions, began: float
) -> tuple[Option, MoveReason] | None:
    """Return a move to make now and why, or None to go on measuring."""
    left = options.max_moves - len(progress.moves)
    knowledge, testbed = progress.knowledge, bench.testbed
    if left == 0 or not testbed.masses:
        return None
    view = Outlook(knowledge, testbed, state_now(knowledge, testbed))
    may_brake = left > 2  # a brake costs another move to come back, and the last is for the trim
    if left > 1 and not progress.braking and urgent(view, options.target, may_brake):
        option = safest(view, options.target, may_brake)
        if option.peak < HELPS * view.peak(knowledge.displacement):
            return option, MoveReason.BRAKE if option.brake else MoveReason.BELOW_FIRST
    if not (progress.braking or ripe(bench, progress, options, began)):
        return None
    hurried = bench.time - began > options.max_time - RETURN
    option, reason = way(view, 1 if hurried else left, options)
    pressed = bench.time - began > options.max_time - SETTLE
    stays = np.array_equal(option.targets, knowledge.displacement)  # stops are too rough for it
    return None if stays or not (pressed or good_moment(view, option)) else (option, reason)


def way(view: Outlook, left: int, options: BalanceOptions) -> tuple[Option, MoveReason]:
    """Return the move below the target where that pays, else the one to the target, and why."""
    knowledge, testbed = view.knowledge, view.testbed
    if worth_learning(knowledge, testbed, left, options):
        down = option_for(view, below(knowledge, options.target, testbed))
        if left > moves_back(down, view, options):
            return down, MoveReason.BELOW_FIRST
    return option_for(view, options.target), MoveReason.TO_TARGET


def worth_learning(
    knowledge: Knowledge, testbed: Testbed, left: int, options: BalanceOptions
) -> bool:
    """Say whether to go below the target: at first, and again while the height is uncertain.

    The masses stop with the same error in a long move as in a short one, so long moves determine
    the scale best. The last move is the way back; when the platform is low already, it is kept for
    the trim.
    """
    up, first = testbed.up, left == options.max_moves
    low = float((knowledge.com - options.target) @ up) < -NOTABLE
    vague = float(np.sqrt(up @ knowledge.covariance @ up)) > KNOWN * float(options.close @ up)
    return left > 1 and (first or (vague and not low))


def moves_back(down: Option, view: Outlook, options: BalanceOptions) -> int:
    """Return how many moves follow one below: the way back, and a trim where stops are rough."""
    stops = stops_covariance(view.testbed, down.targets != view.knowledge.displacement)
    rough = np.sqrt(np.diag(stops)) > KNOWN * options.close
    return 2 if rough.any() else 1


def below(knowledge: Knowledge, target: Vector3, testbed: Testbed) -> Vector3:
    """Return a place (m) well below both the target and the present centre of mass.

    It makes the platform stiffer, and the known changes on the way there and back determine the
    scale of inertia and centre of mass.
    """
    depth = max(DOWN, DEEPER - float((knowledge.com - target) @ testbed.up))
    return target - depth * testbed.up


def urgent(view: Outlook, target: Vector3, may_brake: bool) -> bool:
    """Say whether to move because of the tilt.

    When staying would pass the guard: if a direct move one measurement later would pass it too; but
    while the estimate is uncertain, only if even the safest move then would pass the brink.
    """
    knowledge, up = view.knowledge, view.testbed.up
    later, hopeful = replace(view, wait=MEASUREMENT), replace(view, cautious=False)
    if hopeful.peak(knowledge.displacement) <= view.guard:
        return False
    off = float(np.linalg.norm(knowledge.com - target))
    sideways = knowledge.sd - (knowledge.sd @ up) * up
    if float(np.linalg.norm(sideways)) < INFORMED * off:
        return bool(option_for(later, target).peak > view.guard)
    return bool(safest(replace(hopeful, wait=MEASUREMENT), target, may_brake).peak > view.brink)


def ripe(bench: Bench, progress: Progress, options: BalanceOptions, began: float) -> bool:
    """Say whether a move would help: the offset is known, or time presses, and is worth it."""
    knowledge = progress.knowledge
    left = options.max_moves - len(progress.moves)
    off, sd = np.abs(knowledge.com - options.target), knowledge.sd
    share = LATEST if left == 1 else 1 - left / (options.max_moves + 1)
    late = bench.time - began > share * (options.max_time - SETTLE)
    enough = LAST if left == 1 else KNOWN
    rough = AWAY if left == options.max_moves else BACK
    known = bool(np.all((sd < enough * options.close) | ((sd < rough * off) & (left > 1))))
    worth = off > TRIM * options.close if late and left == 1 else off + sd > options.close
    return bool(np.any(worth)) and (known or late) and fresh_enough(knowledge, progress.still_since)


def announced(move: Move) -> tuple[Reason, ...]:
    """Return why masses are moved, and the predicted result."""
    com = axes_of("com", move.predicted_com)
    return one_reason(move.reason, **com, travel=move.travel, duration=move.duration)


def final(bench: Bench, progress: Progress, options: BalanceOptions, why: StepReason) -> Step:
    """Return the verification, or the stop with its reason."""
    knowledge = progress.knowledge
    last = progress.moves[-1] if progress.moves else None
    judged = verdict(knowledge, last, progress.still_since, options)
    if why is StepReason.TILTED:
        judged = Verdict(one_reason(VerdictReason.TILTED), knowledge.com, knowledge.sd)
    reasons = (Reason(why), *judged.reasons)
    return verdict_step(bench.time, judged, reasons, knowledge.recording, knowledge.estimate)
