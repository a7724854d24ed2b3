"""Quiet records of a platform that unknown torques drive: its plain fit is lost, its body is not.

Spin of 10 to 60 deg/s, tilt of 0.5 to 2 deg, a torque of 0.1 mN m that changes within 5 s: it turns
the heading by whole turns, which no body explains.
"""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy.signal import lfilter

from equipoise.estimation.events.noise_identification import followed, weighed
from equipoise.estimation.events.record_model import RecordModel, improbability, nearest
from equipoise.estimation.model_selection import model_choice
from equipoise.estimation.model_selection.survey import cut_times
from equipoise.estimation.output_error.trajectory import Params, fit
from equipoise.model.estimate import BODY, COM
from equipoise.model.testbed import AttitudeSensor
from equipoise.procedure.identification.identify import IdentifyOptions, identify
from tests.oracle import cases
from tests.oracle import mujoco_bench as oracle
from tests.support import quiet_records, thorough

DURATION, RATE, NOISE, STEP = 40.0, 10.0, np.deg2rad(0.02), 1e-3
TORQUE, MEMORY = 1e-4, 5.0  # N m, s
HELD = ("com_y",)
SURE = 5.0  # sd: beyond is wrong


@cache
def draughty(seed):
    """Return platform, testbed and record; the guess of J is off by up to 30 % of all of it."""
    rng = np.random.default_rng([seed, 35])
    body = cases._spinning(rng)
    spin = rng.uniform(10.0, 60.0) * rng.choice([-1.0, 1.0])
    upright = oracle.rotation(np.array([np.pi / 2, 0.0, 0.0]))
    way, heading = rng.uniform(0, 2 * np.pi, 2)
    lean = np.deg2rad(rng.uniform(0.5, 2.0)) * np.array([np.cos(way), np.sin(way), 0.0])
    turned = oracle.product(oracle.rotation(np.array([0.0, 0.0, heading])), upright)
    q = oracle.product(oracle.rotation(lean), turned)
    rate = oracle.matrix(q).T @ np.deg2rad([*rng.uniform(-1.0, 1.0, 2), spin])
    platform = replace(body, q=q, rate=rate)
    steps = len(oracle.middles(DURATION, STEP))
    keep = np.exp(-STEP / MEMORY)
    white = rng.normal(0.0, TORQUE, (steps, 3))
    torque = lfilter([np.sqrt(1 - keep**2)], [1.0, -keep], white, axis=0)
    run = oracle.driven(platform, np.zeros((steps, 0)), torque, STEP)
    record = replace(oracle.sensor_log(run, rng, RATE, NOISE), masses=None, mass_names=())
    bed = oracle.testbed_for(platform, rng, 0.05, AttitudeSensor(RATE, NOISE))
    J = np.diag(np.diag(platform.inertia_P)) * (1 + rng.uniform(-0.3, 0.3))
    guess = replace(bed.body, com=np.array([0.0, platform.com[1], 0.0]), inertia_P=J)
    return platform, replace(bed, up=cases.UP_Y, com_sd=np.full(3, 5e-4), body=guess,
                             inertia_sd=0.3), record  # fmt: skip


def errors_in_sd(platform, estimate):
    """Return the errors of J and com in sd, (9,); of the held value 0."""
    J = platform.inertia_P[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
    sd = np.sqrt(np.diag(estimate.covariance_of(BODY)))
    off = estimate.values(BODY) - np.concatenate([J, platform.com])
    return np.divide(off, sd, out=np.zeros(9), where=sd > 0)


@pytest.mark.parametrize("seed", range(thorough.count(20, 1)))
def test_a_driven_quiet_record_gives_its_body(seed):
    """Usable, no value off by five sd, moments within 5 %."""
    platform, bed, record = draughty(seed)
    *_, last = identify(record, bed, IdentifyOptions("trajectory", hold=HELD))
    found = last.estimate
    assert found.outcome.usable
    assert np.abs(errors_in_sd(platform, found)).max() < SURE
    moments = np.diag(platform.inertia_P)
    assert np.abs(found.values(BODY[:3]) - moments).max() < 0.05 * moments.max()


@pytest.mark.parametrize("how", [{"drag": 1e-6}, {"torque": 1e-6}], ids=["drag", "draught"])
@pytest.mark.parametrize("seed", range(thorough.count(10, 1)))
def test_what_acts_all_the_time_is_no_touch(how, seed):
    """Two impulses explain a minute as well as a drag or a draught does, and bend com by 10 sd."""
    found = quiet_records.quiet(seed, **how)
    for minute in found.minutes[: thorough.count(2, 1)]:
        *_, last = identify(minute, found.testbed, IdentifyOptions("trajectory", use_prior=True))
        assert last.estimate.outcome.usable
        assert not last.estimate.events
        assert np.abs(errors_in_sd(found.platform, last.estimate)).max() < SURE


@cache
def model_of(seed):
    """Return the plain model of a record, its fit lost."""
    _, bed, record = draughty(seed)
    params = Params(hold=HELD)
    lost = fit(record, bed, params)
    return RecordModel(record, bed, params, cut_times(record), np.zeros(3), (), lost, bed)


def test_shooting_with_process_noise_follows_what_a_plain_fit_loses():
    """The plain fit leaves many times the noise; the driven one leaves about the noise."""
    model = model_of(0)
    driven = followed(model)
    left = (2 * each.fitted.at.cost / record_size(model) for each in (model, driven))
    lost, found = left
    assert lost > 100.0
    assert found < 1.5
    assert driven.fitted.point.com[1] == model.stated.body.com[1]
    assert set(COM) & set(HELD)


def record_size(model):
    """Return the number of residuals."""
    return 3 * model.recording.rows


def test_a_model_that_is_no_number_never_wins(monkeypatch):
    """Of three the first is no number: it lost, whether it comes first or last."""
    worth = {"bad": np.nan, "worse": np.inf, "good": 3.0}
    model = model_of(0)
    named = {name: replace(model, coloured=float(k)) for k, name in enumerate(worth)}
    of = {float(k): value for k, value in enumerate(worth.values())}
    evidence = "equipoise.estimation.events.record_model.evidence"
    monkeypatch.setattr("equipoise.estimation.events.record_model.smoothed", lambda m: (m, m))
    monkeypatch.setattr(evidence, lambda m, *_: of[m.coloured])
    for order in (("bad", "worse", "good"), ("good", "worse", "bad"), ("worse", "good", "bad")):
        assert model_choice.likeliest([named[name] for name in order]) is named["good"]
    assert improbability(named["bad"]) == np.inf
    monkeypatch.undo()
    at = replace(model.fitted.at, cost=np.nan)
    astray = replace(model, fitted=replace(model.fitted, at=at))
    assert nearest([astray, model]) is model
    assert weighed(model) is model
