"""A body whose inertia lies at the limit of physical consistency is said to be flat."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from equipoise.estimation.method_contract import Options, estimated
from equipoise.estimation.methods.registry import METHODS
from equipoise.estimation.parameters.flat_body import flat_reasons
from equipoise.io.testbed.presets import read_preset
from equipoise.maths.attitude import exponential, to_matrix
from equipoise.model.mass_properties import (
    MassProperties,
    from_centre,
    inertia_from_second_moments,
)
from equipoise.model.outcome import Outcome, Trust
from equipoise.model.reasons.estimate_reasons import EstimateReason
from equipoise.model.units import MM, UM
from equipoise.simulation.carried_out import record


def plate(thickness, width=0.3, mass=10.0, com=(0.0, 0.0, 0.0), turn=(0.0, 0.0, 0.0)):
    """A square plate: second moments m a^2 / 12 along each edge."""
    R = to_matrix(exponential(np.array(turn)))
    sigma = R @ np.diag(mass * np.array([width, width, thickness]) ** 2 / 12) @ R.T
    return from_centre(mass, np.array(com), inertia_from_second_moments(sigma))


@pytest.mark.parametrize(("thickness", "flat"), [(0.001, True), (0.004, True), (0.0045, False)])
@pytest.mark.parametrize("turn", [(0.0, 0.0, 0.0), (0.3, -0.8, 0.2)])
def test_a_plate_of_300_mm_is_flat_up_to_4_24_mm(thickness, flat, turn):
    """t^2 / (2 w^2 + t^2) = 1e-4 at t = 1.41 % of w. P is not C."""
    body = plate(thickness, com=(0.02, 0.0, -0.1), turn=turn)
    assert bool(flat_reasons(body)) is flat


def test_the_gap_is_that_of_the_greatest_moment():
    """J = diag(1, 1, 1.9999) kg m^2: 1e-4 below 2, of 2."""
    (reason,) = flat_reasons(MassProperties(1.0, np.zeros(3), np.diag([1.0, 1.0, 1.9999])))
    assert reason.code is EstimateReason.FLAT_BODY
    assert reason.numbers["gap"] == pytest.approx(1e-4 / 1.9999, rel=1e-6)
    assert "at the limit of physical consistency" in reason.sentence
    assert "0.005 % below the sum" in reason.sentence


def test_what_cannot_exist_is_not_called_flat():
    assert flat_reasons(MassProperties(1.0, np.zeros(3), np.diag([1.0, 1.0, 2.1]))) == ()


def test_a_flat_body_may_be_relied_on():
    """A thin plate does lie at the edge."""
    reasons = flat_reasons(plate(0.001))
    assert Outcome(reasons).trust is Trust.TRUSTWORTHY


def of(bed, along):
    """The testbed whose true platform has these second moments along its axes, kg m^2."""
    com = np.array([10.0, -10.0, -100.0]) * UM
    true = from_centre(bed.body.mass, com, inertia_from_second_moments(np.diag(along)))
    return replace(bed, truth=replace(bed.truth, com=true.com, inertia_P=true.inertia_P))


@cache
def recorded(thin: bool):
    """Record and testbed of a table like `sputnix`, flat or not; guessed not to be."""
    bed = read_preset("sputnix")
    along = np.array([0.4, 0.3, 0.0 if thin else 0.02])
    guess = inertia_from_second_moments(np.diag([0.38, 0.32, 0.03]))
    body = from_centre(bed.body.mass, np.array([0.0, 0.0, -90.0]) * UM, guess)
    bed = replace(of(bed, along), body=body)
    move = (60.0, {"x1": -10 * MM, "y1": -10 * MM, "z1": -50 * MM})
    return record(bed, 120.0, [move], 2), bed


@pytest.mark.parametrize("thin", [True, False])
def test_a_fit_of_a_flat_body_says_so(thin):
    found = estimated(METHODS["trajectory"], *recorded(thin), Options())
    codes = [reason.code for reason in found.outcome.reasons]
    assert found.outcome.usable
    assert (EstimateReason.FLAT_BODY in codes) is thin


def test_a_linear_solution_at_the_edge_says_so():
    """Noise leads beyond it: the free solution is no body's, the nearest possible one is flat."""
    bed = read_preset("nanosat")
    half = 0.5 * np.trace(bed.body.inertia_P)
    bed = of(bed, half * np.array([0.57, 0.43, 0.0]))
    rows = record(bed, 30.0, [(15.0, {"z": -10 * MM})], 2)
    codes = {
        name: [r.code for r in estimated(METHODS[name], rows, bed, Options()).outcome.reasons]
        for name in ("momentum_laboratory", "momentum_possible")
    }
    assert EstimateReason.IMPOSSIBLE_INERTIA in codes["momentum_laboratory"]
    assert EstimateReason.FLAT_BODY not in codes["momentum_laboratory"]
    assert EstimateReason.FLAT_BODY in codes["momentum_possible"]
