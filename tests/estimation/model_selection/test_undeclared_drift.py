"""A drift of the centre of mass that nobody declared, by masses that nobody knows, of MuJoCo."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.estimation.model_selection.reference_fit import estimate
from equipoise.estimation.output_error.trajectory import Params
from equipoise.model.estimate import COM
from equipoise.model.reasons.estimate_reasons import EstimateReason as Why
from equipoise.model.testbed import AttitudeSensor, Gyro
from equipoise.model.torque_terms import GROUPS
from tests.oracle import cases
from tests.oracle import mujoco_bench as oracle

CAMERA, GYRO = AttitudeSensor(5.0, np.radians(0.1)), Gyro(10.0, 1e-4, np.radians(0.5))
DRIFT, SECONDS, HIDDEN = 1e-6 / 60, 240.0, 0.05  # m/s; s; kg of each mass that nobody knows
MOVE = np.array([-0.010, -0.010, -0.030])  # m, of the known masses at half of the record
SPIN = np.radians(30.0)


def drifting(seed: int, spin: float):
    """Return platform, way of the drift, record of the known masses alone, and testbed."""
    case, rng = cases._fourteen_case(seed, 300.0, CAMERA, GYRO), np.random.default_rng([seed, 9])
    way = rng.normal(size=3)
    way /= np.linalg.norm(way)
    hidden = tuple(
        oracle.Slide(f"h{k}", HIDDEN, np.full(3, 0.1), e) for k, e in enumerate(np.eye(3))
    )
    known = case.platform
    rate = known.rate + np.array([0.0, 0.0, spin])
    platform = replace(known, slides=known.slides + hidden, rate=rate)
    t = oracle.middles(SECONDS, 1e-3)[:, None]
    share = oracle.smooth(np.clip((t - SECONDS / 2) / 3.0, 0.0, 1.0))
    wanted = np.hstack([share * MOVE, t * way * DRIFT * known.mass / HIDDEN])
    run = oracle.driven(platform, wanted, np.zeros_like(wanted[:, :3]))
    record = oracle.sensor_log(run, rng, 5.0, CAMERA.noise, 10.0, GYRO.noise, mass_rate=10.0)
    masses = replace(record.masses, values=record.masses.values[:, :3])
    record = replace(record, mass_names=record.mass_names[:3], masses=masses)
    return known, way, record, case.testbed


@pytest.mark.parametrize("spin", [0.0, SPIN])
def test_a_drift_is_found_and_its_declaration_stated(spin):
    """1 um/min for four minutes, at rest or spinning: within 4 sd, com too; nothing is an event."""
    platform, way, record, testbed = drifting(0, spin)
    found = estimate(record, testbed, Params())
    names = (*GROUPS["drift"], *COM)
    truth = np.concatenate([DRIFT * way, platform.com])
    sd = np.sqrt(np.diag(found.covariance_of(names)))
    assert np.abs((found.values(names) - truth) / sd).max() < 4.0
    assert not found.events
    (reason,) = [r for r in found.outcome.reasons if r.code is Why.TERMS_TO_DECLARE]
    assert reason.parameters == ("drift",)
    assert "[disturbance] consider in the testbed file: drift" in reason.sentence
