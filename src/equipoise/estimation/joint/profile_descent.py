"""The descent of a joint fit: over what is shared, with all else of each record at its optimum.

    F(x) = sum_i w_i min over u_i of f_i(x, u_i) + 1/2 sum weight (mean - x)^2

u_i are the start, bias, torques, stops and jumps of record i, which its own fit finds with x kept
(``kernels.gauss_newton``). With A_i and b_i the local model of f_i by (x, u) there,

    S_i = A_xx - A_xu A_uu^-1 A_ux,      g_i = b_x - A_xu A_uu^-1 b_u
    (sum w_i S_i + weight) dx = sum w_i g_i + weight (mean - x)

is the Gauss-Newton step of all unknowns at once: what is private is eliminated exactly (Schur).
Steps are damped and stay among possible bodies, like those of one record.

It begins where the records' own local models meet, and elsewhere (``starts``) if that fails.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from equipoise.estimation.events.record_model import RecordModel
from equipoise.estimation.joint.shared_parameters import (
    BODIES,
    Record,
    Shared,
    freed,
    keeping,
    placed,
    shared_of,
    stepped,
)
from equipoise.estimation.output_error.kernels.gauss_newton import HELD
from equipoise.estimation.output_error.solution import cost_of, evaluate, finite_cost, settle
from equipoise.estimation.parameters.fit_parameters import CORE
from equipoise.estimation.parameters.retraction import possible_step, step_work_for
from equipoise.estimation.search_budget import UNLIMITED, Budget, Stage
from equipoise.maths.levenberg_marquardt import FIRST, judge, promise, tolerated
from equipoise.maths.linalg import inverse_spd, inverse_where, unit_eigenvalues
from equipoise.maths.scaled_solve import scaled_solve
from equipoise.model.arrays import Floats, Square
from equipoise.model.testbed import Testbed

MOST = 40  # steps, chosen: a fit that settles takes fewer than ten
STARTS = 4  # at most, chosen
TINY = 1e-9  # kg m^2 or m: the least size of a held value
EACH = 60  # evaluations of a record with what is shared kept, chosen: it begins a step away


@dataclass(frozen=True, slots=True, eq=False)
class Joint:
    """Where a joint fit stands."""

    shared: Shared
    records: tuple[Record, ...]  # each at the optimum of what is private
    x: Floats  # what is shared, physical coordinates
    converged: bool = False

    @property
    def cost(self) -> float:
        """Return half the weighted sum of squares, with the priors on what is shared."""
        off = self.shared.prior.mean - self.x
        of_priors = 0.5 * float(np.sum(self.shared.prior.weight * off**2))
        return of_priors + sum(r.weight * r.fitted.at.cost for r in self.records)

    @property
    def rows(self) -> int:
        """Return the number of residuals."""
        return sum(r.fitted.at.residuals for r in self.records)


def without_private(record: Record, of_all: Floats) -> Floats:
    """Return w (b_x - A_xu A_uu^-1 b_u) for b of all unknowns of a record, (n,) or columns."""
    normal, own, private = record.fitted.at.normal, record.place.own, record.place.private
    gain = normal[np.ix_(own, private)] @ inverse_spd(normal[np.ix_(private, private)])
    return record.weight * (of_all[own] - gain @ of_all[private])


def reduced(record: Record) -> tuple[Square, Floats]:
    """Return w S and w g of a record by its own part of what is shared."""
    at, own = record.fitted.at, record.place.own
    both = without_private(record, np.column_stack([at.normal[:, own], at.descent]))
    return both[:, :-1], both[:, -1]


def of_data(joint: Joint) -> tuple[Square, Floats]:
    """Return information and descent of all records by what is shared, without priors on it."""
    normal, descent = np.zeros((joint.shared.size,) * 2), np.zeros(joint.shared.size)
    for record in joint.records:
        S, g = reduced(record)
        normal[np.ix_(record.place.shared, record.place.shared)] += S
        descent[record.place.shared] += g
    return normal, descent


def local_model(joint: Joint) -> tuple[Square, Floats]:
    """Return the same with priors; what is held has only its own row, and stays."""
    normal, descent = of_data(joint)
    prior = joint.shared.prior
    normal[np.diag_indices_from(normal)] += prior.weight
    descent += prior.weight * (prior.mean - joint.x)
    normal[prior.held], normal[:, prior.held], descent[prior.held] = 0.0, 0.0, 0.0
    normal[prior.held, prior.held] = (HELD * np.maximum(np.abs(prior.mean[prior.held]), TINY)) ** -2
    return normal, descent


def within_possible(joint: Joint, normal: Square, descent: Floats, damping: float) -> Floats:
    """Return the damped step among possible bodies.

    The step of one record has its start before what is shared: here that has no descent.
    """
    first, before = joint.records[0], CORE.start
    n = before + len(descent)
    padded, toward, step = np.eye(n), np.zeros(n), np.zeros(n)
    padded[before:, before:], toward[before:] = normal, descent
    mass, point = first.problem.mass, first.fitted.point.flat
    possible_step(point, mass, padded, toward, damping, step_work_for(n), step)
    return step[before:]


def settled(record: Record, x: Floats) -> Record:
    """Return a record at the optimum of what is private, with what is shared at x.

    It begins where its local model expects that optimum.
    """
    at, place, layout = record.fitted.at, record.place, record.problem.layout
    to_go = x[place.shared] - record.values(len(x))[place.shared]
    own, private = place.own, place.private
    block = np.ix_(private, private)
    toward = at.descent[private] - at.normal[np.ix_(private, own)] @ to_go
    step = np.zeros(layout.size)
    step[private] = scaled_solve(np.ascontiguousarray(at.normal[block]), toward, 0.0)
    ahead = placed(record, stepped(record.problem, record.fitted.point, step), x)
    kept = keeping(record.problem, place)
    found = [settle(kept, ahead, record.fitted.jumps, EACH)]
    if not found[0].converged:  # so wide a step may mislead: begin where it stood
        beside = placed(record, record.fitted.point, x)
        found.append(settle(kept, beside, record.fitted.jumps, EACH))
    best = min(found, key=cost_of)
    here = evaluate(record.problem, best.point, best.jumps)
    return replace(record, fitted=replace(best, problem=record.problem, at=here))


def moved_to(joint: Joint, x: Floats) -> Joint:
    """Return the joint fit with what is shared at x, or at the nearest possible body."""
    records = tuple(settled(record, x) for record in joint.records)
    reached = x.copy()
    reached[BODIES] = records[0].values(len(x))[BODIES]
    return replace(joint, records=records, x=reached)


def descend(joint: Joint, budget: Budget = UNLIMITED) -> Joint:
    """Return the optimum from a joint fit.

    It has arrived when a step promises less than a hundredth of a standard deviation a record, as
    nearly as each record's own optimum is found. Where a prediction grows beyond what digits hold,
    the information is not positive: a small promise says nothing there, and it has not arrived.
    """
    damping, growth = FIRST, 2.0
    for _ in range(MOST):
        if not (np.isfinite(joint.cost) and budget.allows(Stage.RUNS)):
            return joint
        normal, descent = local_model(joint)
        step = within_possible(joint, normal, descent, damping)
        promised = promise(normal, descent, step)
        if promised < len(joint.records) * tolerated(joint.cost, joint.rows):
            are_settled = all(r.fitted.converged for r in joint.records)
            return replace(joint, converged=are_settled and bool(unit_eigenvalues(normal)[0] > 0))
        trial = moved_to(joint, joint.x + step)
        gained = 2.0 * (joint.cost - trial.cost)
        taken, damping, growth = judge(gained, promised, damping, growth)
        joint = trial if taken else joint
    return joint


def meeting(shared: Shared, records: Sequence[Record]) -> Floats:
    """Return where the records' own local models meet: sum S_i (x - x_i) = g_i, with the priors."""
    weight, free = shared.prior.weight, ~shared.prior.held
    normal, right = np.diag(weight), weight * shared.prior.mean
    for record in records:
        (S, g), place = reduced(record), record.place.shared
        normal[np.ix_(place, place)] += S
        right[place] += S @ record.values(shared.size)[place] + g
    kept = np.where(free, 0.0, shared.prior.mean)
    return kept + inverse_where(normal, free) @ (right - normal @ kept)


def own_optimum(shared: Shared, record: Record) -> Floats:
    """Return what is shared as a record has it by itself; else, and held, as the prior has it."""
    x = shared.prior.mean.copy()
    x[record.place.shared] = record.values(shared.size)[record.place.shared]
    return np.where(shared.prior.held, shared.prior.mean, x)


def expected_cost(shared: Shared, records: Sequence[Record], x: Floats) -> float:
    """Return how much the cost rises from the records' own optima to x, by their local models."""
    off = shared.prior.mean - x
    total = 0.5 * float(np.sum(shared.prior.weight * off**2))
    for record in records:
        (S, g), place = reduced(record), record.place.shared
        away = x[place] - record.values(shared.size)[place]
        total += float(away @ (0.5 * S @ away - g))
    return total


def starts(shared: Shared, records: Sequence[Record]) -> list[Floats]:
    """Return where to begin, the likeliest first.

    Where the local models meet, each record's own optimum, and what is known beforehand; of a
    record that shows little, the own optimum may be far from all others.
    """
    found = [meeting(shared, records), shared.prior.mean]
    found += [own_optimum(shared, record) for record in records]
    return sorted(found, key=lambda x: expected_cost(shared, records, x))[:STARTS]


def first_record(model: RecordModel, names: tuple[str, ...], weight: float) -> Record:
    """Return a record as its own fit left it, with what is shared free."""
    problem, place = freed(model, names)
    at = evaluate(problem, model.fitted.point, model.fitted.jumps)
    return Record(problem, place, weight, replace(model.fitted, problem=problem, at=at))


def fit_jointly(
    models: Sequence[RecordModel],
    weights: Sequence[float],
    testbed: Testbed,
    budget: Budget = UNLIMITED,
) -> Joint:
    """Return the joint optimum of records that were each fitted by itself.

    ``testbed`` says what is known of the body beforehand.
    """
    shared = shared_of(models, testbed)
    records = tuple(
        first_record(model, shared.names, weight)
        for model, weight in zip(models, weights, strict=True)
    )
    ended = list[Joint]()
    for x in starts(shared, records):
        ended.append(attempt(Joint(shared, records, x), budget))
        if ended[-1].converged or budget.unfinished:
            break
    return min(ended, key=lambda each: (not each.converged, finite_cost(each.cost)))


def attempt(joint: Joint, budget: Budget = UNLIMITED) -> Joint:
    """Return the optimum from a start; the start itself where a record's information is none."""
    try:
        return descend(moved_to(joint, joint.x), budget)
    except np.linalg.LinAlgError:
        return joint
