"""The centre of mass in successive parts of a record, and how it wanders.

Each part has a trajectory fit of its own, as a stiff platform that does not drift within it; parts
share no row. The inertia is that of the whole record, or, where that is not usable, the testbed's
with its sd. Its error is common to all parts, and absent from their scatter (evaluated by
``assessment.metrics.allan``).

Changes quicker than a part are unobservable; a part whose fit is not usable is left out.
"""

from dataclasses import dataclass, replace

import numpy as np

from equipoise.assessment.metrics.allan import FEWEST, Wander, wander_of
from equipoise.estimation.output_error import growing_horizon, trajectory
from equipoise.estimation.output_error.fit_estimate import conclude
from equipoise.maths.linalg import given
from equipoise.model.arrays import Series1, Series3, Vector3
from equipoise.model.estimate import COM, INERTIA, Estimate
from equipoise.model.recording import Recording, arranged, window
from equipoise.model.testbed import Testbed
from equipoise.procedure.identification.assess import UNKNOWN_COM
from equipoise.procedure.steps.joint_fit import as_if_stiff


@dataclass(frozen=True, slots=True, eq=False)
class OverHours:
    """The centre of mass by parts, and its wander."""

    t: Series1  # s, the middle of each
    com: Series3  # m, as the masses stood
    sd: Series3  # m
    left_out: int  # parts whose fits were not usable
    wander: Wander | None  # None: too few parts


def metrics_over_hours(
    recording: Recording, testbed: Testbed, seconds: float, inertia_known: bool
) -> OverHours:
    """Return metrics of parts of ``seconds`` each; the inertia counts as known, or as a prior."""
    recording = arranged(recording, testbed.mass_names)
    bed = replace(as_if_stiff(testbed).without("drift"), com_sd=np.full(3, UNKNOWN_COM))
    held = INERTIA if inertia_known else ()
    params = trajectory.Params(bed.disturbances, hold=held, use_prior=True)
    start, end = recording.span
    count = max(int((end - start) / seconds), 1)
    parts = with_rows(recording, seconds, count)
    found, times, left_out = list[Estimate](), list[float](), count - len(parts)
    for k in parts:
        first = start + k * seconds
        measurement = metric_of(window(recording, first, min(first + seconds, end)), bed, params)
        if measurement is None:
            left_out += 1
            continue
        found.append(measurement)
        times.append(first + 0.5 * seconds)
    com = np.array([measurement.values(measurement.standing) for measurement in found])
    sd = np.array([spread_of(measurement) for measurement in found])
    t, com, sd = np.array(times, dtype=float), com.reshape(-1, 3), sd.reshape(-1, 3)
    wander = wander_of(t, com, sd) if len(t) >= FEWEST else None
    return OverHours(t, com, sd, left_out, wander)


def with_rows(recording: Recording, seconds: float, count: int) -> list[int]:
    """Return which of so many parts hold rows: behind a wrong stamp there may be any number."""
    start = recording.span[0]
    channels = [c.t for c in (recording.attitude, recording.rate) if c is not None]
    part = np.floor((np.concatenate(channels) - start) / seconds)
    return np.unique(part[(part >= 0) & (part < count)]).astype(int).tolist()


def spread_of(measurement: Estimate) -> Vector3:
    """Return the sd of a part's centre of mass but for the inertia, whose error all parts share."""
    own, J = (
        [measurement.index(name) for name in names] for names in (measurement.standing, INERTIA)
    )
    return np.sqrt(np.diag(given(measurement.covariance, own, J)))


def metric_of(part: Recording, testbed: Testbed, params: trajectory.Params) -> Estimate | None:
    """Return the fit of a part; None where it is not usable or does not show all of com."""
    rows = max((len(c) for c in (part.attitude, part.rate) if c is not None), default=0)
    if rows < growing_horizon.FEW_ROWS:
        return None
    fitted = trajectory.fit(part, testbed, params)
    estimate = conclude(fitted, trajectory.METHOD, part)
    return estimate if estimate.outcome.usable and estimate.sees(COM) else None
