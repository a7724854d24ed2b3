"""A centre of mass that moves by itself, undeclared, by masses that nobody knows, of MuJoCo."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from equipoise.actuators.sliding_masses import com_shift, mass_maps
from equipoise.dynamics.lamp_warmth import warms
from equipoise.estimation.model_selection.reference_fit import estimate
from equipoise.estimation.output_error.trajectory import Params
from equipoise.estimation.tracker import tracker
from equipoise.estimation.tracker.predict_correct import WARM
from equipoise.model.devices import Lamp
from equipoise.model.estimate import COM, END
from equipoise.model.reasons.estimate_reasons import EstimateReason as Why
from equipoise.model.recording import Samples, window
from equipoise.model.testbed import AttitudeSensor, Gyro
from equipoise.model.torque_terms import GROUPS
from tests.oracle import cases
from tests.oracle import mujoco_bench as oracle
from tests.support import thorough

CAMERA, GYRO = AttitudeSensor(5.0, np.radians(0.1)), Gyro(10.0, 1e-4, np.radians(0.5))
DRIFT, THERMAL = 1e-6 / 60, 1e-6  # m/s, m/K
SECONDS, HIDDEN = 240.0, 0.05  # s; kg of each mass that nobody knows
LAMP, SLOW, WARMER = 40.0, 60.0, 3.0  # s when it goes on, s of its e-fold, K in the end
MOVE = np.array([-0.010, -0.010, -0.030])  # m, of the known masses at half of the record
SPIN = np.radians(30.0)


def drift(t):
    """Return how far (m) it drifts until t (s)."""
    return DRIFT * t


def warmth(t):
    """Return by how much (K) a lamp has warmed it."""
    return WARMER * -np.expm1(-np.maximum(t - LAMP, 0.0) / SLOW)


def warmed(t):
    """Return how far (m) the lamp's warmth has moved it."""
    return THERMAL * warmth(t)


@cache
def moving(seed: int, spin: float, course):
    """Return platform, way of the motion, record of the known masses alone, and testbed."""
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
    wanted = np.hstack([share * MOVE, course(t) * way * known.mass / HIDDEN])
    run = oracle.driven(platform, wanted, np.zeros_like(wanted[:, :3]))
    record = oracle.sensor_log(run, rng, 5.0, CAMERA.noise, 10.0, GYRO.noise, mass_rate=10.0)
    masses = replace(record.masses, values=record.masses.values[:, :3])
    record = replace(record, mass_names=record.mass_names[:3], masses=masses)
    return known, way, record, case.testbed


def check_found(found, terms, coefficients, com):
    """Coefficients and com are within 4 sd, and nothing is an event."""
    names = (*terms, *COM)
    truth = np.concatenate([coefficients, com])
    sd = np.sqrt(np.diag(found.covariance_of(names)))
    assert np.abs((found.values(names) - truth) / sd).max() < 4.0
    assert not found.events


@pytest.mark.parametrize("spin", thorough.some([0.0, SPIN], 1))
def test_a_drift_is_found_and_its_declaration_stated(spin):
    """1 um/min for four minutes, at rest or spinning: within 4 sd, com too; nothing is an event."""
    platform, way, record, testbed = moving(0, spin, drift)
    found = estimate(record, testbed, Params())
    check_found(found, GROUPS["drift"], DRIFT * way, platform.com)
    (reason,) = [r for r in found.outcome.reasons if r.code is Why.TERMS_TO_DECLARE]
    assert reason.parameters == ("drift",)
    assert "Declare drift under [disturbance] consider" in reason.sentence


def thermometer(noise: float) -> Samples:
    """A reading every 2 s, to 1 mK, that errs by ``noise`` K."""
    t = np.arange(0.0, SECONDS + 1.0, 2.0)
    error = np.random.default_rng(1).normal(scale=noise, size=len(t))
    return Samples(t, np.round(21.3 + warmth(t) + error, 3)[:, None])


@pytest.mark.parametrize("spin", thorough.some([SPIN, 0.0], 1))
def test_a_lamps_warmth_is_found_by_the_recorded_temperature(spin):
    """3 um in minutes, of a lamp that goes on at 40 s: within 4 sd, com too; no events."""
    platform, way, record, testbed = moving(0, spin, warmed)
    found = estimate(replace(record, temperature=thermometer(0.0)), testbed, Params())
    check_found(found, GROUPS["thermal"], THERMAL * way, platform.com)
    end = np.array([found.values((name,))[0] for name in END])
    moved = com_shift(mass_maps(testbed.masses), platform.mass, MOVE)
    np.testing.assert_allclose(
        end - found.com, THERMAL * way * warmth(SECONDS) + moved, rtol=0, atol=3e-7
    )
    (reason,) = [r for r in found.outcome.reasons if r.code is Why.TERMS_TO_DECLARE]
    assert reason.parameters == ("thermal",)


def lamp_at(stated: float, record, testbed):
    """Return the record with the lamp's switch, and the testbed with what is stated of it (s)."""
    switch = Samples(np.array([0.0, LAMP]), np.array([[0.0], [1.0]]))
    return replace(record, lamp=switch), replace(testbed, lamp=Lamp(WARMER, stated))


@pytest.mark.parametrize(
    ("spin", "stated"), thorough.some([(SPIN, 150.0), (0.0, 20.0), (SPIN, 20.0), (0.0, 150.0)], 1)
)
def test_a_lamps_warmth_is_found_by_its_switch(spin, stated):
    """However wrong its time constant is stated: found within a tenth; com as by a thermometer."""
    platform, way, record, testbed = moving(0, spin, warmed)
    found = estimate(*lamp_at(stated, record, testbed), Params())
    check_found(found, GROUPS["thermal"], THERMAL * way, platform.com)
    (reason,) = [r for r in found.outcome.reasons if r.code is Why.LAMP_RESPONSE]
    assert reason.numbers["found"] == pytest.approx(SLOW, rel=0.1)
    assert reason.numbers["stated"] == stated


def test_the_tracker_foresees_a_lamp_whose_switch_is_recorded():
    """By MuJoCo: within 4 sd all along, and nearer than without the switch; k within 4 sd."""
    platform, way, record, testbed = moving(0, SPIN, warmed)
    recorded, lit = lamp_at(SLOW, record, testbed)
    body = replace(lit.body, inertia_P=platform.inertia_P)
    lit = replace(lit, inertia_sd=0.0, body=body)  # no scale to be learnt beside
    first = tracker.first_state(0.0, record.attitude.values[0], lit)
    found, surprised = (
        tracker.track(each, lit, tracker.Params(), first) for each in (recorded, record)
    )
    late = found.t > LAMP
    true = platform.com + warmed(found.t)[:, None] * way
    error, other = (np.abs(each.com - true)[late] for each in (found, surprised))
    assert (error / found.com_sd[late]).max() < 4.0
    assert np.mean(error**2) < np.mean(other**2) / 1.5
    off = found.thermal[-1] - THERMAL * way
    assert (np.abs(off) < 4.0 * found.sd[-1, WARM]).all()


@pytest.mark.parametrize("stated", thorough.some([20.0, 60.0, 180.0], 2))
def test_a_time_constant_that_is_not_known_widens_the_intervals(stated):
    """Ten seconds behind the switch nobody can tell how warm it will be in the end."""
    _, way, record, testbed = moving(0, SPIN, warmed)
    record, testbed = lamp_at(stated, window(record, 0.0, LAMP + 10.0), testbed)
    names = GROUPS["thermal"]
    found = estimate(record, testbed, Params(names))
    known = estimate(replace(record, temperature=thermometer(0.0)), testbed, Params(names))
    sd, least = (np.sqrt(np.diag(one.covariance_of(names))) for one in (found, known))
    assert (np.abs(found.values(names) - THERMAL * way) < 4.0 * sd).all()
    assert sd.max() > 5.0 * least.max()


@thorough.whole
def test_a_thermometer_that_errs_leaves_com_as_certain_as_stated():
    """By 0.05 K a reading, which moves com by 0.05 um: com within 4 sd, the term is there."""
    platform, _, record, testbed = moving(0, SPIN, warmed)
    found = estimate(replace(record, temperature=thermometer(0.05)), testbed, Params())
    sd = np.sqrt(np.diag(found.covariance_of(COM)))
    assert np.abs((found.com - platform.com) / sd).max() < 4.0
    assert all(found.has(name) for name in GROUPS["thermal"])


def test_a_temperature_that_does_not_change_is_no_candidate():
    """Nor one that was never recorded: its columns would be zero."""
    _, _, record, testbed = moving(0, SPIN, warmed)
    steady = Samples(np.array([0.0, SECONDS]), np.array([[21.0], [21.0]]))
    assert not warms(record, testbed)
    assert not warms(replace(record, temperature=steady), testbed)
    assert warms(replace(record, temperature=thermometer(0.0)), testbed)
