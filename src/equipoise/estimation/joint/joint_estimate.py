"""Several recordings of one platform: the estimate of all together, and whether they agree.

Each record is surveyed by itself (``reference_fit``): its noise, its events, its terms. Those whose
own estimate can be used are then fitted together in these models (``profile_descent``). A record
whose residuals are not quite noise counts less, by the square of how much that widens its own
intervals. Where runs scatter more than their sd lead to expect (``run_scatter``), all intervals are
widened by as much; beyond ``DISAGREE`` the runs are of different platforms, and a joint fit bends
all that it can to make them one: it has no numbers then.

Cannot see what errs alike in all records: a camera that leans always. A mass that is stated wrong
within its sd is counted.
"""

import itertools
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from equipoise.estimation.events.record_model import RecordModel
from equipoise.estimation.joint.joint_information import (
    beside_fit,
    by_inputs,
    considered,
    pull_of_sag,
    shared_information,
    sizes_of,
    visibility_of,
)
from equipoise.estimation.joint.profile_descent import Joint, fit_jointly
from equipoise.estimation.joint.run_scatter import (
    OwnShare,
    exceeds,
    scatter_of,
    verdict_of,
)
from equipoise.estimation.joint.shared_parameters import BODIES
from equipoise.estimation.output_error.fit_estimate import (
    UNSETTLED,
    smoothed_residual,
    widening,
)
from equipoise.estimation.output_error.trajectory import METHOD
from equipoise.estimation.parameters.flat_body import flat_reasons
from equipoise.estimation.parameters.observability import Visibility
from equipoise.estimation.parameters.scale_free_ratios import ORDER, ratios_of
from equipoise.estimation.search_budget import UNLIMITED, Budget, cut_short
from equipoise.model.arrays import Floats, Square
from equipoise.model.estimate import Estimate, Parameter
from equipoise.model.joint_estimate import JointEstimate, RunScatter
from equipoise.model.mass_properties import MassProperties
from equipoise.model.outcome import Outcome, outcome
from equipoise.model.reasons.estimate_reasons import EstimateReason as Why
from equipoise.model.reasons.reason import Reason, one_reason
from equipoise.model.reasons.verdict_reasons import VerdictReason
from equipoise.model.testbed import Testbed
from equipoise.model.verdict import Verdict
from equipoise.model.version import __version__

FEWEST = 2  # runs
DISAGREE = 3.0  # chosen: times as large as stated; sd of a sound fit are not so much too small


@dataclass(frozen=True, slots=True, eq=False)
class Run:
    """A record by itself."""

    source: str
    sha256: str
    model: RecordModel | None  # None: too few rows
    estimate: Estimate

    @property
    def usable(self) -> bool:
        """Say whether it can take part in a joint fit."""
        return self.model is not None and self.estimate.outcome.usable


def estimate_jointly(
    runs: Sequence[Run], testbed: Testbed, budget: Budget = UNLIMITED
) -> JointEstimate:
    """Return the estimate of all runs that are usable by themselves, and whether they agree."""
    used = tuple(run.usable for run in runs)
    models = [run.model for run in runs if run.model is not None and run.usable]
    kept = [run for run in runs if run.usable]
    if len(kept) < FEWEST:
        return without_fit(outcome(Why.TOO_FEW_RUNS, usable=len(kept), count=len(runs)), used)
    joint = fit_jointly(models, [weight_of(model) for model in models], testbed, budget)
    if not joint.converged:
        lost = cut_short(without_numbers(UNSETTLED), budget.unfinished)
        return without_fit(lost.outcome, used)
    view = visibility_of(joint)
    own = zip(models, [run.estimate for run in kept], strict=True)
    beside = [beside_fit(joint, k, *each) for k, each in enumerate(own)]
    pulls = [pull_of_sag(joint, record, view.covariance) for record in joint.records]
    scatter = scatter_of(
        own_shares(joint, view.covariance, beside, pulls),
        [run.source for run in kept],
        [run.estimate for run in kept],
        held_names(joint),
    )
    verdict = verdict_of(scatter)
    reasons = (*reasons_of(view, scatter), *left_out_reasons(runs))
    if disagree(scatter):
        return JointEstimate(without_numbers(Outcome(reasons)), verdict, scatter, used)
    covariance = considered(joint, view.covariance, beside, pulls)
    wider = widened_by(scatter) ** 2 * covariance + by_inputs(joint, view.covariance)
    found = concluded(joint, view, wider)
    body = MassProperties(models[0].testbed.body.mass, found.com, found.inertia_P)
    ended = Outcome((*reasons, *flat_reasons(body)))
    estimate = replace(found, outcome=ended, provenance=origin_of(kept))
    return JointEstimate(estimate, verdict, scatter, used)


def without_fit(why: Outcome, used: tuple[bool, ...]) -> JointEstimate:
    """Return what there is where no joint fit was found."""
    verdict = Verdict(one_reason(VerdictReason.RUNS_NOT_FITTED))
    return JointEstimate(without_numbers(why), verdict, None, used)


def without_numbers(why: Outcome) -> Estimate:
    """Return an estimate that says why it has no numbers."""
    return Estimate(METHOD, why, (), np.zeros((0, 0)))


def weight_of(model: RecordModel) -> float:
    """Return by how much the information of a record counts less than its noise says."""
    _, residual = smoothed_residual(model.fitted)
    return max(widening(residual), model.coloured) ** -2


def own_shares(
    joint: Joint, covariance: Square, beside: Sequence[Square], pulls: Sequence[Floats]
) -> list[OwnShare]:
    """Return what each record alone shows, in natural sizes; what is held is not sought."""
    found: list[OwnShare] = []
    for k, record in enumerate(joint.records):
        (S, g), place = shared_information(joint, k), record.place
        sought = ~joint.shared.prior.held[place.shared]
        own, size = place.shared[sought], sizes_of(record)[place.own[sought]]
        at = np.ix_(own, own)
        both = np.outer(size, size)
        found.append(
            OwnShare(
                S[at] * both,
                g[own] * size,
                beside[k][at] / both,
                pulls[k][own] * size,
                covariance[at] / both,
            )
        )
    return found


def disagree(scatter: RunScatter) -> bool:
    """Say whether runs scatter too much to be of one platform."""
    return exceeds(scatter) and scatter.factor > DISAGREE


def held_names(joint: Joint) -> tuple[str, ...]:
    """Return what is held at one value in every run."""
    return tuple(itertools.compress(joint.shared.names, joint.shared.prior.held))


def widened_by(scatter: RunScatter) -> float:
    """Return the factor on every sd."""
    return max(scatter.factor, 1.0) if exceeds(scatter) else 1.0


def reasons_of(view: Visibility, scatter: RunScatter) -> tuple[Reason, ...]:
    """Return what there is to know of the joint estimate."""
    widening = {"widening": scatter.factor}
    if disagree(scatter):
        return (Reason(Why.RUNS_DISAGREE, (), widening),)
    found = [Reason(Why.FITTED_JOINTLY, (), {"count": len(scatter.deviations)})]
    if exceeds(scatter):
        found.append(Reason(Why.RUNS_SCATTERED, (), widening))
    if view.scale_open:
        found.insert(0, Reason(Why.RATIOS_ONLY))
    elif bool(view.hidden[BODIES].any()):
        found.append(Reason(Why.PART_UNOBSERVABLE))
    return tuple(found)


def left_out_reasons(runs: Sequence[Run]) -> tuple[Reason, ...]:
    """Return which runs were left out."""
    sources = tuple(run.source for run in runs if not run.usable)
    return (Reason(Why.RUNS_LEFT_OUT, sources),) if sources else ()


def concluded(joint: Joint, view: Visibility, covariance: Square) -> Estimate:
    """Return values and covariance of what is shared, com first, without an outcome yet."""
    shared, x = joint.shared, joint.x
    order = [*ORDER, *range(BODIES.stop, shared.size)]
    sd = np.where(view.hidden, np.inf, np.sqrt(np.maximum(np.diag(covariance), 0.0)))
    parameters = tuple(
        Parameter(
            shared.names[k], shared.units[k], float(x[k]), float(sd[k]), not bool(view.hidden[k])
        )
        for k in order
    )
    ratios = ratios_of(x[BODIES], covariance[BODIES, BODIES], view.unseen[BODIES])
    return Estimate(
        METHOD,
        Outcome(()),
        parameters,
        covariance[np.ix_(order, order)],
        unobservable=view.unobservable,
        ratios=ratios if view.scale_open else (),
    )


def origin_of(runs: Sequence[Run]) -> dict[str, str]:
    """Return what the estimate was made of, and by which version."""
    sources = {f"source {k}": run.source for k, run in enumerate(runs, 1)}
    hashes = {f"sha256 {k}": run.sha256 for k, run in enumerate(runs, 1)}
    return {"version": __version__} | sources | hashes
