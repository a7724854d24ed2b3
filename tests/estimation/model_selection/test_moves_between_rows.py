"""Recorded moves that are over between two rows, in records by MuJoCo."""

import functools
from dataclasses import replace

import numpy as np
import pytest

from equipoise.estimation.model_selection.reference_fit import estimate
from equipoise.estimation.output_error.trajectory import Params
from equipoise.model.estimate import BODY
from equipoise.model.reasons.estimate_reasons import EstimateReason as Why
from equipoise.model.testbed import AttitudeSensor, Gyro
from tests.oracle import cases
from tests.oracle import mujoco_bench as oracle
from tests.support import thorough

WAY, STEPS, STIFF = np.array([-0.02, 0.03, -0.04]), 20, 300.0
FAST = 0.1  # m/s
MOVED, NEAR = 31.0, 5.0  # s: the moves are within 30 and 32 s; chance makes events elsewhere
KINDS = ("steps", "jump", "even rows")
COVERED = 4.0  # sd, of nine values in some dozens of records


def schedule(kind: str, start: float) -> tuple[oracle.Ramp, ...]:
    """Return twenty steps of 2 mm, one every 0.1 s; or one fast move."""
    if kind == "steps":
        parts = np.arange(1, STEPS + 1) / STEPS
        return tuple(
            oracle.Ramp(start + 0.1 * k, share * WAY, FAST, even=True)
            for k, share in enumerate(parts)
        )
    return (oracle.Ramp(start, WAY, 2.0 if kind == "jump" else FAST, even=True),)


@functools.cache
def estimated(kind: str, seed: int):
    """Return estimate and truth of 60 s with a move at 30 s, masses logged with the camera."""
    rate = 50.0 if kind == "even rows" else 10.0
    camera, gyro = AttitudeSensor(rate, np.deg2rad(0.1)), Gyro(rate, 1e-4, np.deg2rad(1.0))
    case = cases._fourteen_case(seed, STIFF, camera, gyro)
    start = 30.0 + 0.1 * np.random.default_rng([seed, 7]).random()
    run = oracle.simulate(case.platform, schedule(kind, start), 60.0)
    rng = np.random.default_rng([seed, 8])
    record = oracle.sensor_log(run, rng, rate, camera.noise, rate, gyro.noise, mass_rate=rate)
    masses = tuple(replace(mass, speed=FAST) for mass in case.testbed.masses)
    found = estimate(record, replace(case.testbed, masses=masses), Params())
    return found, true_values(case.platform)


def true_values(body):
    """Return J and com of a platform, (9,)."""
    J = body.inertia_P[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
    return np.concatenate([J, body.com])


def errors_in_sd(kind: str, seed: int):
    """Return the errors of J and com in sd, (9,)."""
    found, truth = estimated(kind, seed)
    return (found.values(BODY) - truth) / np.sqrt(np.diag(found.covariance_of(BODY)))


@pytest.mark.parametrize("kind", KINDS)
def test_a_move_within_rows_is_no_event_and_leaves_the_scale(kind):
    """Intervals hold, and nothing is stepped over at the time of the move."""
    for seed in range(thorough.count(20, 2)):
        found, _ = estimated(kind, seed)
        assert found.outcome.usable
        assert all(abs(event.t - MOVED) > NEAR for event in found.events), (kind, seed)
        assert np.abs(errors_in_sd(kind, seed)).max() < COVERED, (kind, seed)


@pytest.mark.parametrize("kind", KINDS)
def test_intervals_are_as_wide_as_errors_of_moves_within_rows(kind):
    """The mean square error in sd is that of chance: nine values a record, not independent."""
    seeds = range(thorough.count(20, 2))
    square = np.mean([np.mean(errors_in_sd(kind, seed) ** 2) for seed in seeds])
    few = 9 * len(seeds) / 3
    assert square < 1 + 3 * np.sqrt(2 / few)


def test_rates_during_a_jump_are_left_out_and_counted():
    """Two rows or three, of 600; none where masses travel from row to row."""
    found, _ = estimated("jump", 0)
    (reason,) = [r for r in found.outcome.reasons if r.code is Why.RATES_UNRESOLVED]
    assert 2 <= reason.numbers["rows"] <= 4


def test_an_event_at_the_only_move_leaves_the_scale_open_and_says_so():
    """A track that is wrong of one mass, at the only move: ratios are left, and a reason."""
    found = misread()
    assert found.events
    codes = {reason.code for reason in found.outcome.reasons}
    assert {Why.EVENTS_AT_TRAVELS, Why.RATIOS_ONLY} <= codes
    assert not any(p.observable for p in found.parameters if p.name in BODY)


def misread():
    """Return the estimate where y's recorded way is half of what it travelled, at 30 s."""
    camera, gyro = AttitudeSensor(10.0, np.deg2rad(0.1)), Gyro(10.0, 1e-4, np.deg2rad(1.0))
    case = cases._fourteen_case(3, STIFF, camera, gyro)
    run = oracle.simulate(case.platform, (oracle.Ramp(30.0, WAY, FAST, even=True),), 60.0)
    record = oracle.sensor_log(run, np.random.default_rng(3), 10.0, camera.noise, 10.0, gyro.noise)
    track = record.masses
    half = replace(record, masses=replace(track, values=track.values * [1.0, 0.5, 1.0]))
    masses = tuple(replace(mass, speed=FAST) for mass in case.testbed.masses)
    return estimate(half, replace(case.testbed, masses=masses), Params())
