"""Ivanov et al.'s experiments on a simulated platform of theirs, sections 4 and 5.

The platform is what their fit found (section 4): its centre of mass, inertia and first rate are the
truth, and beforehand only CAD's inertia and 100 um below P are known, as they began. It drifts, of
warmth, in a random direction, and no testbed says so; the paper prints no rate, and 1 um/min is
chosen.

    session      600 s with a move every 120 s                       Figs. 4 and 5
    experiment   75 s with one move at 37 s, fitted without prior    Figs. 6 to 9
    tracked      240 s with the same move at 120 s                   Figs. 10 to 13

One load along each axis moves; its mass shifts the centre of mass by (11, 11, 55) um where they
print (10, 10, 50) (erratum I15).
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from equipoise.model.arrays import Series1, Series3, Vector3
from equipoise.model.errors import InputError
from equipoise.model.estimate import Estimate
from equipoise.model.mass_properties import MassProperties, from_centre
from equipoise.model.predicted_motion import PredictedMotion
from equipoise.model.recording import Recording, window
from equipoise.model.testbed import Testbed
from equipoise.model.torque_terms import expand
from equipoise.model.units import MINUTE, MM, UM
from equipoise.procedure.identification.identify import IdentifyOptions, identify
from equipoise.procedure.identification.record_courses import (
    FitMotions,
    TrackedCourses,
    fit_motions,
    tracked_courses,
)
from equipoise.procedure.steps.clean_record import sound
from equipoise.simulation.carried_out import performed

COM = np.array([-0.92, -0.1, -79.0]) * UM  # m, section 4
INERTIA_C = np.array(  # kg m^2, section 4
    [[0.3565, -0.0078, 0.0314], [-0.0078, 0.5301, 0.0113], [0.0314, 0.0113, 0.8782]]
)
RATE = np.array([-0.010, -0.004, 0.011])  # rad/s, section 4
FIRST_COM = np.array([0.0, 0.0, -100.0]) * UM  # m, section 4: where their search begins
DRIFT = 1.0 * UM / MINUTE  # m/s, chosen: the paper prints none
METHOD = "trajectory"

Moves = tuple[tuple[float, Mapping[str, float]], ...]  # s, m
LOADS = ("x1", "y1", "z1")


def loads_at(x: float, y: float, z: float) -> dict[str, float]:
    """Return targets (m) of one load along each axis, from mm."""
    return dict(zip(LOADS, (x * MM, y * MM, z * MM), strict=True))


# Every two minutes; the third is the one of section 5, (-10, -10, -50) mm. The others are chosen.
SESSION: Moves = (
    (120.0, loads_at(10, 0, 20)),
    (240.0, loads_at(10, 10, 20)),
    (360.0, loads_at(0, 0, -30)),
    (480.0, loads_at(0, 0, 0)),
)
SESSION_TIME = 600.0  # s
BEFORE, SEGMENT = 37.0, 75.0  # s, Figs. 5 to 8: the move and the length of a segment
THIRD = SESSION[2][0]
MOVE = loads_at(-10, -10, -50)
TRACKED, MOVED_AT = 240.0, 120.0  # s, Fig. 13: the move comes at 120 s


@dataclass(frozen=True, slots=True, eq=False)
class Fitted:
    """An experiment and its fit."""

    recording: Recording
    testbed: Testbed  # sensors as the rows show them
    estimate: Estimate


@dataclass(frozen=True, slots=True, eq=False)
class Tracked:
    """A record with a move, and the tracker with and without it."""

    recording: Recording
    testbed: Testbed
    truth: tuple[Series1, Series3]  # s, m: corners of the true course, masses as they stand
    courses: TrackedCourses


def changes(moves: Moves) -> list[tuple[float, Vector3]]:
    """Return when loads were moved (s), and by how much along each axis (m)."""
    found, before = list[tuple[float, Vector3]](), np.zeros(3)
    for t, targets in moves:
        there = np.array([targets[name] for name in LOADS])
        found.append((t, there - before))
        before = there
    return found


def true_body(preset: Testbed) -> MassProperties:
    """Return the body that the paper's fit found."""
    return from_centre(preset.body.mass, COM, INERTIA_C)


def platform(preset: Testbed) -> Testbed:
    """Return the paper's platform: its fit as the truth, CAD's inertia as what is known."""
    truth = preset.truth
    if truth is None:
        raise InputError("ivanov2021", "a testbed without [truth]", "the preset sputnix")
    body = from_centre(preset.body.mass, FIRST_COM, preset.body.inertia_C)
    inertia_P, fastest = true_body(preset).inertia_P, float(np.abs(RATE).max())
    made = replace(truth, com=COM, inertia_P=inertia_P, rate_limit=fastest)
    return replace(preset, body=body, truth=made)


def drifting(testbed: Testbed, speed: float, seed: int) -> Testbed:
    """Return the testbed whose centre of mass drifts (m/s) in a random direction, undeclared."""
    way = np.random.default_rng([seed, 2]).normal(size=3)
    drift = dict(zip(expand(("drift",)), speed * way / np.linalg.norm(way), strict=True))
    assert testbed.truth is not None
    return replace(testbed, truth=replace(testbed.truth, torque=drift))


def drift_of(testbed: Testbed) -> Vector3:
    """Return the true drift of the centre of mass, m/s."""
    assert testbed.truth is not None
    return np.array([testbed.truth.torque[term] for term in expand(("drift",))])


def session(preset: Testbed, seed: int) -> Recording:
    """Return the record of the whole session; it starts with the printed rate."""
    bed = platform(preset)
    assert bed.truth is not None
    bed = drifting(replace(bed, truth=replace(bed.truth, rate=RATE)), DRIFT, seed)
    return performed(bed, seed, None, SESSION_TIME, SESSION)[1]


def segment(recording: Recording) -> Recording:
    """Return the part of a session about its third move, with the session's times."""
    start = THIRD - BEFORE
    return window(recording, start, start + SEGMENT)


def experiment(preset: Testbed, seed: int) -> Fitted:
    """Return one experiment of section 4, fitted to attitudes alone, without any prior."""
    bed = drifting(platform(preset), DRIFT, seed)
    recording = performed(bed, seed, None, SEGMENT, ((BEFORE, MOVE),))[1]
    *_, last = identify(recording, bed, IdentifyOptions(METHOD))
    assert last.estimate is not None
    return Fitted(*sound(recording, bed), last.estimate)


def motions(fitted: Fitted) -> FitMotions | None:
    """Return the motion as predicted beforehand, and as the estimate has it (Fig. 6)."""
    return fit_motions(fitted.recording, fitted.testbed, fitted.estimate)


def largest_residual(recording: Recording, after: PredictedMotion) -> float:
    """Return the largest component of q - q_predicted (Fig. 7), the shorter way."""
    rows = recording.attitude
    assert rows is not None
    turned = np.sign(np.sum(rows.values * after.q, axis=1))[:, None]
    return float(np.abs(rows.values - turned * after.q).max())


def tracked(preset: Testbed, known: Estimate, seed: int) -> Tracked:
    """Return the tracker along a move, with the inertia of an estimate, as section 5 has it."""
    bed = drifting(platform(preset), DRIFT, seed)
    bench, recording = performed(bed, seed, None, TRACKED, ((MOVED_AT, MOVE),))
    courses = tracked_courses(recording, bed, known, compare=True)
    return Tracked(recording, bed, true_course(bed, bench.truth().com), courses)


def true_course(testbed: Testbed, end: Vector3) -> tuple[Series1, Series3]:
    """Return the corners of the true course (s, m) of a record with a move that ends at ``end``."""
    drift = drift_of(testbed)
    arrived = MOVED_AT + max(map(abs, MOVE.values())) / testbed.masses[0].speed
    before, after = COM + MOVED_AT * drift, end - (TRACKED - arrived) * drift
    return np.array([0.0, MOVED_AT, arrived, TRACKED]), np.array([COM, before, after, end])
