"""Platforms of the plan's Monte Carlo, each carried through a manoeuvre and identified.

Camera alone: the records are made by MuJoCo. A hand lets go with its error, masses stop with
theirs, and hang on drives as soft as the testbed allows for (and follow late by 2 / w, w being the
servo's frequency). Gyro and wheels: those of the simulated bench, reference table.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from equipoise.estimation.output_error.free_vertical import PLUMB
from equipoise.maths.attitude import tilt
from equipoise.maths.linalg import pack_symmetric
from equipoise.maths.straight_lines import read_at
from equipoise.model import sensor_terms, torque_terms
from equipoise.model.estimate import COM, INERTIA, Estimate
from equipoise.model.manoeuvre import Manoeuvre
from equipoise.model.mass_properties import MassProperties, smallest_second_moment
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import Testbed
from equipoise.procedure.identification.identify import IdentifyOptions, identify
from equipoise.simulation import actuator
from equipoise.simulation.carried_out import bench_for, carried_out, let_go
from equipoise.simulation.draw_truth import SimulatedPlatform, draw_truth
from tests.oracle import mujoco_bench as oracle

BODY = (*INERTIA, *COM)
STIFF = 300.0  # rad/s, MuJoCo's stiffest servo
STEP = 2e-3  # s, of MuJoCo: 0.6 rad of that servo
TERMS = {*torque_terms.TERMS, *sensor_terms.TERMS}

Array = NDArray[np.float64]


class Run(NamedTuple):
    """One record identified."""

    error: Array  # estimate - truth, in the order of BODY
    covariance: Array
    usable: bool
    tilt: float  # rad, the greatest
    beyond: tuple[str, ...]  # terms that the testbed does not state, and "events"

    @property
    def sd(self) -> Array:
        """Return the sd that `identify` states."""
        return np.sqrt(np.diag(self.covariance))

    @property
    def as_stated(self) -> bool:
        """Say whether the record was identified in the model that the testbed states."""
        return not self.beyond


def beyond_of(estimate: Estimate, testbed: Testbed) -> tuple[str, ...]:
    """Return what a model has beyond the testbed's own: terms, and whether it has events."""
    stated = {*testbed.disturbances, *PLUMB}
    found = [p.name for p in estimate.parameters if p.name in TERMS and p.name not in stated]
    return (*found, *(["events"] if estimate.events else []))


def judged(estimate: Estimate, testbed: Testbed, body: MassProperties, greatest: float) -> Run:
    """Return what one estimate is worth."""
    true = np.append(pack_symmetric(body.inertia_P), body.com)
    error, covariance = estimate.values(BODY) - true, estimate.covariance_of(BODY)
    usable, beyond = estimate.outcome.usable, beyond_of(estimate, testbed)
    return Run(error, covariance, usable, greatest, beyond)


def estimated(recording: Recording, testbed: Testbed) -> Estimate:
    """Return the reference estimate."""
    *_, last = identify(recording, testbed, IdentifyOptions("trajectory"))
    assert last.estimate is not None
    return last.estimate


def truth_of(testbed: Testbed, manoeuvre: Manoeuvre, seed: int) -> SimulatedPlatform:
    """Return the platform of a seed, let go as a hand meets the manoeuvre.

    One in some hundred that are drawn could not be without its masses, being nearly flat.
    """
    rng, begun = np.random.default_rng([seed, 1]), let_go(testbed, manoeuvre, seed)
    while True:
        truth = draw_truth(begun, rng)
        if smallest_second_moment(oracle.bare_body(built(testbed, truth, STIFF))[2]) > 0:
            return truth


def built(testbed: Testbed, truth: SimulatedPlatform, stiffness: float) -> oracle.Platform:
    """Return a platform for MuJoCo, its masses on servos of this frequency (rad/s)."""
    slides = tuple(oracle.Slide(m.name, m.mass, m.home, m.axis, stiffness)
                   for m in testbed.masses)  # fmt: skip
    body = truth.body
    return oracle.Platform(body.mass, body.inertia_P, body.com, slides, testbed.gravity,
                           truth.attitude, truth.rate)  # fmt: skip


def by_mujoco(testbed: Testbed, manoeuvre: Manoeuvre, seed: int) -> Run:
    """Carry out a manoeuvre on a platform of MuJoCo bodies, and identify it."""
    rng = np.random.default_rng([seed, 2])
    truth = truth_of(testbed, manoeuvre, seed)
    soft = np.sqrt(testbed.gravity / max(abs(rng.normal(0.0, testbed.masses[0].sag_sd)), 1e-9))
    platform = built(testbed, truth, min(float(soft), STIFF))
    t = oracle.middles(manoeuvre.duration, STEP)
    reported, real = sent(testbed, manoeuvre, rng)
    run = oracle.driven(platform, read_at(t, real.t, real.values), np.zeros((len(t), 3)), STEP)
    assert testbed.attitude is not None
    log = oracle.sensor_log(run, rng, testbed.attitude.rate, testbed.attitude.noise)
    found = estimated(replace(log, masses=reported), testbed)
    return judged(found, testbed, truth.body, float(tilt(run.q, testbed.up).max()))


def sent(
    testbed: Testbed, manoeuvre: Manoeuvre, rng: np.random.Generator
) -> tuple[Samples, Samples]:
    """Return where masses are told to be, and where their drives take them."""
    masses = testbed.masses
    travel = actuator.left_at(masses, {}, rng)
    track = actuator.tracked(travel)
    for t, targets in manoeuvre.moves:
        goals = actuator.checked(travel, t, targets, masses)
        travel = actuator.sent(travel, t, goals, masses, (), rng)
        track = actuator.retracked(track, travel, t)
    reported = actuator.reported_rows(track, 0.0, manoeuvre.duration)
    return reported, Samples(track.t, track.real)


def by_bench(testbed: Testbed, manoeuvre: Manoeuvre, seed: int) -> Run:
    """Carry out a manoeuvre on the simulated bench, and identify it."""
    bench = bench_for(testbed, manoeuvre, seed)
    recording = carried_out(bench, manoeuvre)
    assert recording.attitude is not None
    greatest = float(tilt(recording.attitude.values, testbed.up).max())
    greatest = np.inf if bench.touches else greatest  # beyond the limit, but for its stop
    return judged(estimated(recording, testbed), testbed, bench.platform.body, greatest)
