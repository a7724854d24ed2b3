"""When an event happened: its moment by Newton steps, all events of a record at once.

Had an event come later by dt, the state behind it would differ by d dt, all else equal:

    an impulse u              d = -u about the attitude          (it turned on without u)
    a step s of com           d = -J^-1 (m g s x down) about the rate

(the part of d that the event's own jump can make, it makes). With P, p the information and score
of the rows behind the cut and C the covariance there, all other unknowns free (``jump_test``),

    h = d^T (P - P C P) d,     dt = d^T p / h,     sd = h^(-1/2)

Cannot see the moment of an event whose d the record does not show: its h is nearly 0.
"""

from dataclasses import replace

import numpy as np

from equipoise.estimation.events.jump_test import INFORMATIVE
from equipoise.estimation.events.record_model import Happening, RecordModel, refitted
from equipoise.estimation.output_error.solution import Fitted, smooth_at
from equipoise.estimation.parameters.fit_parameters import RATE, TURN, unknowns_of
from equipoise.estimation.search_budget import Stage
from equipoise.maths.attitude import to_matrix
from equipoise.maths.linalg import inverse_spd
from equipoise.model.arrays import Floats, Vector3

DOWN_N = np.array([0.0, 0.0, -1.0])
FARTHEST = {False: 8.0, True: 1.0}  # spacings a step, without and with process noise, chosen
STEPS = 12
SHARES = (1.0, 0.3)  # of a step that are tried
CLOSE = 0.1  # sd, chosen: a moment that is off by less is found
SEPARATION = 0.25  # spacings, chosen: two events are not separable any nearer


def rows_of(fit: Fitted, events: tuple[Happening, ...]) -> list[int]:
    """Return the index of each event among the jumps of a fit."""
    at = {round(jump.t, 9): k for k, jump in enumerate(fit.problem.jumps)}
    return [at[round(event.t, 9)] for event in events]


def lateness(model: RecordModel, kind: str, jump: Vector3, flat: Floats) -> tuple[slice, Vector3]:
    """Return d and the coordinates it is about, from the state behind the event."""
    if kind == "impulse":
        return TURN, -jump
    here = unknowns_of(flat)
    body = here.body(model.testbed.body.mass)
    torque: Vector3 = model.testbed.weight * np.cross(jump, to_matrix(here.q0).T @ DOWN_N)
    return RATE, -inverse_spd(body.inertia_P) @ torque


def moment_errors(model: RecordModel) -> tuple[Floats, Floats]:
    """Return by how much each event came later than modelled, and the sd, s; no h: 0 and 0."""
    fit, after = model.fitted, smooth_at(model.fitted)
    late, sd = np.zeros((2, len(model.events)))
    for i, k in enumerate(rows_of(fit, model.events)):
        kind = model.events[i].kind
        B, d = lateness(model, kind, fit.jumps[k, :3], after.points[k + 1])
        P, C, p = after.information[k + 1], after.covariance[k + 1], after.score[k + 1]
        behind, across = d @ P[B, B] @ d, P[:, B] @ d
        h = behind - across @ C @ across
        if h > INFORMATIVE * behind:
            late[i], sd[i] = d @ p[B] / h, h**-0.5
    return late, sd


def later(model: RecordModel, shifts: Floats) -> RecordModel:
    """Return the model with each event later by ``shifts`` (s), where there is room for it."""
    start, end = model.recording.span
    events = list(model.events)
    for k, event in enumerate(model.events):
        t = event.t + float(shifts[k])
        others = (e.t for j, e in enumerate(events) if j != k)
        free = all(abs(t - other) > SEPARATION * model.spacing for other in others)
        if free and start + model.spacing < t < end - model.spacing:
            events[k] = replace(event, t=t)
    return refitted(replace(model, events=tuple(events)), model.events)


def timed(model: RecordModel, only: int | None = None) -> RecordModel:
    """Return the model with its events (or one) at the moments that explain most."""
    most = FARTHEST[model.wanders] * model.spacing
    chosen = np.ones(len(model.events)) if only is None else np.arange(len(model.events)) == only
    for _ in range(STEPS):
        if not model.may(Stage.EVENTS):
            break
        late, sd = moment_errors(model)
        step = chosen * np.clip(late, -most, most)
        if np.all(np.abs(step) <= CLOSE * sd):
            break
        trials = (later(model, share * step) for share in SHARES)
        better = (t for t in trials if t.fitted.at.cost < model.fitted.at.cost)
        nearer = next(better, None)
        if nearer is None:
            break
        model = nearer
    return model
