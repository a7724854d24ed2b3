"""Whether what was estimated can be the platform that was recorded.

The radius of gyration found is held against that of any platform (``body``). A centre of mass
found above the pivot is held against the record (``swings_through_level``). There it would fall
over, with the largest moment of inertia J, within

    1 / l = sqrt(J / m g z),        z: its height above the pivot

unless its spin w steadies it, which takes J w of 2 sqrt(J m g z) and more.
"""

from dataclasses import replace

import numpy as np

from equipoise.actuators.sliding_masses import shift_by
from equipoise.assessment.plausibility.body import possible_radii, radius_of
from equipoise.assessment.plausibility.swings_through_level import Swings, free_swings
from equipoise.model.arrays import Matrix3
from equipoise.model.estimate import COM, INERTIA, Estimate
from equipoise.model.outcome import Outcome
from equipoise.model.reasons.implausible_reasons import ImplausibleReason as Why
from equipoise.model.reasons.reason import Reason, distinct, one_reason
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed

SURE = 3.0  # sd, beyond which it is none of chance (chosen)
FALLS = 4.0  # times 1/l, chosen: a lean has grown by e^4 then
PASSES = 4  # of level, chosen: two are possible
STEADY = 0.5  # of the spin that steadies a platform (chosen)


def with_plausibility(estimate: Estimate, recording: Recording, testbed: Testbed) -> Estimate:
    """Return an estimate with the reasons why it is none of the platform recorded, if any."""
    if not estimate.outcome.usable:
        return estimate
    found = (*_gyration(estimate, testbed), *_above(estimate, recording, testbed))
    return replace(estimate, outcome=Outcome(distinct((*estimate.outcome.reasons, *found))))


def _gyration(estimate: Estimate, testbed: Testbed) -> tuple[Reason, ...]:
    """Return that no body of that mass has the inertia found, by more than chance."""
    moments = INERTIA[:3]
    if not estimate.sees(INERTIA):
        return ()
    mass, (low, high) = testbed.body.mass, possible_radii(testbed)
    trace = float(np.trace(estimate.inertia_P))
    sd = float(np.sqrt(estimate.covariance_of(moments).sum()))
    least, radius, most = (radius_of(trace + k * sd, mass) for k in (-SURE, 0.0, SURE))
    if most >= low and least <= high:
        return ()
    numbers = {"mass": mass, "radius": radius, "sd": (most - least) / (2 * SURE)}
    return one_reason(Why.INERTIA_OF_NO_BODY, **numbers, low=low, high=high)


def _above(estimate: Estimate, recording: Recording, testbed: Testbed) -> tuple[Reason, ...]:
    """Return that the record swings as no platform does whose centre of mass is above."""
    if not all(map(estimate.has, COM)) or estimate.events:
        return ()
    swings = free_swings(recording, testbed)
    if swings is None or swings.count < PASSES:
        return ()
    height, sd = _height(estimate, swings, testbed)
    if not height > SURE * sd:
        return ()
    square = testbed.weight * (height - SURE * sd)  # l^2 at the least, where J is one
    inertia = _inertia(estimate, testbed)
    moments = np.linalg.eigvalsh(inertia)
    growth = float(np.sqrt(square / moments[-1]))
    start, end = swings.span
    steadied = moments[-1] * swings.spin > STEADY * 2 * np.sqrt(moments[0] * square)
    if steadied or growth * (end - start) < FALLS:
        return ()
    numbers = {"sds": height / sd, "seconds": 1 / growth, "start": start, "end": end,
               "count": swings.count}  # fmt: skip
    return one_reason(Why.SWINGS_WITH_COM_ABOVE, **numbers)


def _inertia(estimate: Estimate, testbed: Testbed) -> Matrix3:
    return estimate.inertia_P if all(map(estimate.has, INERTIA)) else testbed.body.inertia_P


def _height(estimate: Estimate, swings: Swings, testbed: Testbed) -> tuple[float, float]:
    """Return how high (m) the centre of mass found is while the platform swings, and its sd.

    Where the scale is open, at the inertia of the estimate: the ratio to it is what is known.
    """
    shift = np.zeros(3)
    if len(swings.displacement) == len(testbed.masses) > 0:
        shift = shift_by(testbed, swings.displacement)
    height = float((estimate.com + shift) @ testbed.up)
    if estimate.sees(COM):
        return height, float(np.sqrt(testbed.up @ estimate.covariance_of(COM) @ testbed.up))
    return height, _sd_of_ratio(estimate, testbed)


def _sd_of_ratio(estimate: Estimate, testbed: Testbed) -> float:
    """Return the sd (m) of the height at the inertia of the estimate; infinite if it is open."""
    sd = 0.0
    for name, along in zip(COM, np.abs(testbed.up).tolist(), strict=True):
        ratio = next((p for p in estimate.ratios if p.name.startswith(f"{name}/")), None)
        if along > 0 and ratio is None:
            return float("inf")
        if along > 0 and ratio is not None:
            top = ratio.name.partition("/")[2]
            sd += along * ratio.sd * estimate.parameters[estimate.index(top)].value
    return sd
