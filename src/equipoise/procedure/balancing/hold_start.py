"""The state that a hold begins with: the estimate of balancing, as the tracker carries it on."""

from dataclasses import replace

import numpy as np

from equipoise.actuators.sliding_masses import shift_by
from equipoise.estimation.tracker import tracker
from equipoise.estimation.tracker.known_inputs import inputs_kept, inputs_of
from equipoise.estimation.tracker.known_sag import with_sag
from equipoise.estimation.tracker.predict_correct import BODY, DRIFTING, RATE_OF_COM, WARM
from equipoise.estimation.tracker.stored_covariance import SAG_ROW
from equipoise.estimation.tracker.warmth import THERMAL, warmth_of
from equipoise.model.estimate import INERTIA, Estimate
from equipoise.model.testbed import Testbed
from equipoise.model.torque_terms import GROUPS
from equipoise.procedure.steps.joint_fit import DRIFT, Knowledge
from equipoise.procedure.steps.tilt_prediction import state_now

WARMING = 1e-8  # m/s, chosen: one sd of what a drift may be other than before the hold
SAG = GROUPS["sag"]


def first_state(knowledge: Knowledge, testbed: Testbed) -> tracker.State:
    """Return the tracker's prior: the estimate at the end of the record of balancing."""
    q, rate = state_now(knowledge, testbed)
    shift = shift_by(testbed, knowledge.displacement)
    t = float(knowledge.fitted.problem.line.t[-1])
    inertia_P = knowledge.fitted.point.body(testbed.body.mass).inertia_P
    estimate, known = knowledge.estimate, (*knowledge.standing, *INERTIA)
    posterior = tracker.Posterior(knowledge.com - shift, inertia_P, estimate.covariance_of(known),
                                  warmth_of(estimate, known))  # fmt: skip
    state = tracker.first_state(t, q, testbed, posterior)
    drift, covariance = np.zeros(3), state.covariance.copy()
    if estimate.has(DRIFT[0]):
        drift, every = estimate.values(DRIFT), np.ix_(DRIFTING, DRIFTING)
        covariance[every] = estimate.covariance_of((*known, *DRIFT))
    state = replace(state, rate=rate, drift=drift, covariance=covariance,
                    inputs=inputs_kept(inputs_of(None, knowledge.recording), t))  # fmt: skip
    state = sagging(state, estimate, known)
    for k in DRIFTING[-3:]:
        state.covariance[k, k] += WARMING**2
    return state


def sagging(state: tracker.State, estimate: Estimate, known: tuple[str, ...]) -> tracker.State:
    """Return the state with the sag of an estimate, if any, and its covariance with all else.

    ``known`` are the names of com and inertia.
    """
    sag = tuple(name for name in SAG if estimate.has(name))
    if not sag:
        return state
    rows, names = [*range(BODY.start, BODY.stop)], [*known]
    for terms, at, has in (
        (DRIFT, RATE_OF_COM, estimate.has(DRIFT[0])),
        (THERMAL, WARM, estimate.sees(THERMAL)),
    ):
        rows += [*range(at.start, at.stop)] if has else []
        names += terms if has else []
    rows += [SAG_ROW + SAG.index(name) for name in sag]
    values = np.zeros(len(SAG))
    values[[SAG.index(name) for name in sag]] = estimate.values(sag)
    state = with_sag(state, values, np.zeros((len(SAG), len(SAG))))
    state.covariance[np.ix_(rows, rows)] = estimate.covariance_of((*names, *sag))
    return state
