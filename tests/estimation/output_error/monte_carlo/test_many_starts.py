"""First points of many records: those of each alone."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.estimation.output_error.initial_guess import as_measured, start
from equipoise.estimation.output_error.monte_carlo.many_starts import first_points
from equipoise.estimation.output_error.trajectory import Params, held_names, problem_of
from equipoise.model.mass_properties import MassProperties
from equipoise.model.recording import Samples
from equipoise.model.testbed import AttitudeSensor
from tests.support.builders import guessed_wrong, move_at, noisy, platform, recording

TURNING = Samples(np.array([0.0, 5.0, 20.0]), np.array([[0.01, 0, 0], [0, 0.02, 0], [0, 0, 0.01]]))


def records(count: int, gyro: float = 0.0, moved: bool = True):
    """Some driven by wheels and a known torque while masses move."""
    track = move_at(6.0, 20.0) if moved else None
    clean = recording(20.0, track, gyro=gyro)
    torque = Samples(TURNING.t, 0.02 * TURNING.values)
    driven = replace(clean, momentum=TURNING, torque=torque) if moved else clean
    return [noisy(driven, seed, np.zeros(3)) for seed in range(count)]


def late(bed):
    """The same platform, its camera averaging and late."""
    camera = bed.attitude
    return replace(bed, attitude=AttitudeSensor(camera.rate, camera.noise, 0.05, averaging=0.04))


def impossible(bed):
    """The same platform, as a drawing that adds up to no body would have it."""
    inertia = np.diag([0.2, 0.3, 0.9])
    return replace(bed, body=MassProperties(bed.body.mass, bed.body.com, inertia))


@pytest.mark.parametrize(
    ("bed", "gyro", "moved"),
    [
        (platform(), 0.0, True),
        (guessed_wrong(platform(2e-4, gyro=True)), 20.0, True),
        (late(platform(gyro=True)), 20.0, True),
        (platform(gyro=True), 20.0, False),
        (impossible(platform(gyro=True)), 20.0, True),
        (impossible(platform()), 0.0, True),
    ],
)
def test_they_are_those_of_each_alone(bed, gyro, moved):
    """To 1e-9 of each number: by momentum, and as measured; an open scale is held."""
    found = records(4, gyro, moved)
    problem = problem_of(found[0], bed, Params())
    hold, first = held_names(found[0], bed, Params()), float(problem.line.t[0])
    assert bool(hold) != moved
    rates = [r.rate.values if r.rate else np.zeros((0, 3)) for r in found]
    attitudes = np.array([r.attitude.values for r in found])
    points = first_points(problem, attitudes, np.array(rates), hold)
    for k, record in enumerate(found):
        alone = start(record, bed, problem.layout, first, hold)
        measured = as_measured(record, bed, first, alone)
        np.testing.assert_allclose(points[k, 0], alone.flat, rtol=1e-9, atol=1e-12)
        np.testing.assert_allclose(points[k, 1], measured.flat, rtol=1e-9, atol=1e-12)
