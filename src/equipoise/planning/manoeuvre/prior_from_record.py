"""The posterior of an earlier recording, as the prior of the next manoeuvre.

    information of (J, r, where masses stand) = covariance of its estimate ^-1

The masses stand where that recording left them. The error of a stop is one unknown of both
recordings, so its information is kept: ``error_x1_2`` at the end of the first is ``error_x1_1`` at
the beginning of the next.
"""

from typing import NamedTuple

import numpy as np

from equipoise.maths.linalg import inverse_spd, symmetrise
from equipoise.model.errors import InputError
from equipoise.model.estimate import BODY, Estimate
from equipoise.model.mass_properties import MassProperties
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed
from equipoise.planning.manoeuvre.predicted_information import Known
from equipoise.planning.manoeuvre.scenario import Prior


class RecordPrior(NamedTuple):
    """The prior after a recording."""

    prior: Prior
    known: Known
    standing: dict[str, float]  # m


def record_prior(recording: Recording, estimate: Estimate, testbed: Testbed) -> RecordPrior:
    """Return the prior from a recording; InputError where its estimate is not usable.

    The estimate is to have the testbed's body as prior: then all of it has a covariance.
    """
    where = recording.source or "recording"
    if not estimate.outcome.usable or not estimate.sees(BODY):
        raise InputError(where, estimate.outcome.sentence, "a recording that can be identified")
    body = MassProperties(testbed.body.mass, estimate.com, estimate.inertia_P)
    prior = Prior(body, symmetrise(estimate.covariance_of(BODY)))
    standing = stands(recording, testbed)
    errors = {last: f"error_{mass}_1" for mass, last in last_stops(estimate, standing, testbed)}
    information = inverse_spd(symmetrise(estimate.covariance_of((*BODY, *errors))))
    return RecordPrior(prior, Known((*BODY, *errors.values()), information), standing)


def stands(recording: Recording, testbed: Testbed) -> dict[str, float]:
    """Return where masses stand at the end that are not at home, m."""
    if recording.masses is None:
        return {}
    last = recording.masses.values[-1]
    pairs = zip(testbed.mass_names, last, strict=True)
    return {name: float(d) for name, d in pairs if not np.isclose(d, 0.0)}


def last_stops(
    estimate: Estimate, standing: dict[str, float], testbed: Testbed
) -> list[tuple[str, str]]:
    """Return masses that stand away from home, and what the estimate calls their last stop."""
    found: list[tuple[str, str]] = []
    for name, d in standing.items():
        stops = [p.name for p in estimate.parameters if p.name.startswith(f"error_{name}_")]
        if stops and abs(d) > testbed.mass_named(name).accuracy:
            found.append((name, max(stops, key=lambda stop: int(stop.rsplit("_", 1)[1]))))
    return found
