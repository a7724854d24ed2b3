"""Messages of the runner as documents: the view, a step, the state."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from equipoise.app.dashboard.protocol.series import series_of
from equipoise.app.dashboard.runner.benches import Station
from equipoise.app.dashboard.runner.chart_rows import COM, standing_com
from equipoise.app.live.live_estimate import LiveEstimate
from equipoise.app.runs.balancing import Goal
from equipoise.model.devices import recorded_name

Document = dict[str, Any]


def about(station: Station, clock: int, session: str) -> Document:
    """Return what the page has to know before rows: geometry, series, a number for this clock."""
    bed = station.testbed
    masses = [
        {"name": m.name, "home": m.home.tolist(), "axis": m.axis.tolist(), "travel": list(m.travel)}
        for m in bed.masses
    ]
    wheels = [{"name": recorded_name(w), "axis": w.axis.tolist()} for w in bed.wheels]
    gyros = [
        {"name": recorded_name(g), "gimbal": g.gimbal_axis.tolist(), "spin": g.spin_axis.tolist()}
        for g in bed.cmgs
    ]
    return {
        "kind": "about", "clock": clock, "session": session, "title": station.title,
        "bench": station.kind, "up": bed.up.tolist(), "tilt_limit": bed.tilt_limit,
        "layout": bed.layout,
        "gravity": bed.gravity, "masses": masses, "wheels": wheels,
        "gyros": gyros,
        "series": [series.document() for series in series_of(bed)],
    }  # fmt: skip


def line_document(
    index: int, of: str, t: float, sentence: str, outcome: str | None = None
) -> Document:
    """Return a line of the story: a step with the outcome of its verdict, or a person's mark."""
    return {
        "kind": "step", "index": index, "of": of, "t": t, "sentence": sentence, "outcome": outcome,
    }  # fmt: skip


def state_document(
    station: Station, estimate: Mapping[str, Any] | None, goal: Goal | None, **state: object
) -> Document:
    """Return the state of the runner; ``state`` stands in the document as it is."""
    wanted = None if goal is None else {
        "target": goal.target.tolist(), "tolerance": goal.tolerance.tolist()}  # fmt: skip
    return {
        "kind": "state", "t": station.bench.time, "goal": wanted, "span": station.span,
        "seed": station.seed, "estimate": estimate, **state,
    }  # fmt: skip


def estimated(posterior: LiveEstimate) -> Mapping[str, Any] | None:
    """Return the centre of mass as the masses stand (m), and its covariance by rows (m^2)."""
    state, covariance, known = posterior.state, posterior.covariance, posterior.tail
    if state is None or covariance is None or known is None:
        return None
    (com,) = standing_com(known, posterior.testbed, np.array([state.t]), state.com[None])
    return {"com": com.tolist(), "covariance": covariance[COM, COM].ravel().tolist()}
