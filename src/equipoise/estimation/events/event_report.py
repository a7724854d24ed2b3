"""The events of a survey as a person wants them: impulses in N m s, steps in m, and where.

A jump dw of the rate is an impulse R J dw about P in laboratory axes. One whose horizontal part is
most of it can come of an upward push at a place of the body, which lies along

    z x L_h                           (a push along z at rho gives L = rho x z dt)
"""

from dataclasses import replace

import numpy as np

from equipoise.estimation.events.event_times import moment_errors, rows_of
from equipoise.estimation.events.record_model import Happening, RecordModel, refitted
from equipoise.estimation.output_error.kernels.interval_smoother import Smoothed
from equipoise.estimation.output_error.problem import forward_of
from equipoise.estimation.output_error.solution import Fitted, smooth_at
from equipoise.estimation.parameters.fit_parameters import unknowns_of
from equipoise.maths.attitude import to_matrix
from equipoise.model.arrays import Matrix3, Vector3
from equipoise.model.event import Event

SURE = 3.0  # chosen: sd by which a horizontal part must stand out to be placed
MOSTLY = 0.5  # chosen: share of the impulse that is horizontal


def azimuth_of(impulse_N: Vector3, sd: float, R: Matrix3, up: Vector3) -> float | None:
    """Return where an upward push would have given this impulse, rad about ``up``; None: unsure."""
    level = impulse_N * [1.0, 1.0, 0.0]
    size = float(np.linalg.norm(level))
    if size < SURE * sd or size < MOSTLY * float(np.linalg.norm(impulse_N)):
        return None
    place = R.T @ np.cross([0.0, 0.0, 1.0], level)
    forward = np.array(forward_of(up))
    return float(np.arctan2(place @ np.cross(up, forward), place @ forward))


def reported_events(model: RecordModel) -> tuple[Event, ...]:
    """Return the events of a model in order of time, each as if its kind were clear."""
    if not model.events:
        return ()
    order = sorted(model.events, key=lambda event: event.t)
    clear = tuple(replace(event, unclear=False) for event in order)
    single = replace(model, events=clear)
    single = refitted(single) if any(event.unclear for event in order) else single
    fit, after = single.fitted, smooth_at(single.fitted)
    rows = zip(order, rows_of(fit, clear), moment_errors(single)[1], strict=True)
    return tuple(
        reported_event(model, event, fit, after, k, float(np.hypot(s, event.aside)))
        for event, k, s in rows
    )


def reported_event(
    model: RecordModel, event: Happening, fit: Fitted, after: Smoothed, k: int, sd: float
) -> Event:
    """Return the event at inner cut ``k`` of a fit."""
    jump, spread = fit.jumps[k, :3], after.jump_covariance[k, :3, :3]
    surprise = float(jump @ np.linalg.solve(spread, jump))
    found = Event("com_step", event.t, sd, jump.copy(), spread.copy(), surprise, event.unclear)
    if event.kind == "com_step":
        return found
    point = unknowns_of(after.points[k + 1])
    R = to_matrix(point.q0)
    turn: Matrix3 = R @ point.body(model.testbed.body.mass).inertia_P
    size, covariance = turn @ jump, turn @ spread @ turn.T
    where = azimuth_of(size, float(np.sqrt(np.trace(covariance) / 3)), R, model.testbed.up)
    return replace(found, kind="impulse", size=size, covariance=covariance, azimuth=where)
