"""Impulses of all causes along a stretch: the balance that they close, and their derivatives."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.dynamics.rigid_body import KNOWN_D
from equipoise.estimation.output_error.problem import posed
from equipoise.estimation.output_error.segment_jumps import Jump
from equipoise.estimation.output_error.trajectory import Params, problem_of
from equipoise.estimation.parameters.fit_parameters import Unknowns
from equipoise.estimation.torque_by_cause.by_cause import moved_point
from equipoise.estimation.torque_by_cause.posed_record import JOINED
from equipoise.estimation.torque_by_cause.stretch_motion import followed, inertia_at, known_at
from equipoise.estimation.torque_by_cause.stretch_torque import impulse_of
from equipoise.io.testbed.presets import read_preset
from equipoise.maths import pseudo_inertia
from equipoise.maths.attitude import exponential, multiply
from equipoise.model import torque_by_cause as cause
from equipoise.model.recording import Recording, Samples
from equipoise.model.torque_terms import TERMS, typical_sizes
from equipoise.sensors.camera import N_SENSOR

CUTS = (1.0, 2.0, 3.0, 4.0)
SPIN, TILT = np.array([0.4, -0.3, 1.2]), np.array([0.1, -0.2, 0.05])


@pytest.fixture(scope="module")
def posed_case():
    """A platform that turns while two masses travel, one from a cut on, with every torque."""
    testbed, t = read_preset("sputnix"), np.arange(0.0, 5.01, 0.2)
    way = Samples(np.array([0.0, 1.0, 2.0, 2.4, 3.1, 5.0]), np.zeros((6, 6)))
    way.values[:, 0] = [2e-3, 2e-3, 12e-3, 12e-3, 12e-3, 12e-3]  # begins to move at a cut
    way.values[:, 3] = [0.0, 0.0, 0.0, 0.0, -7e-3, -7e-3]
    turning = Samples(t, multiply(exponential(TILT), exponential(np.outer(t, SPIN))))
    recording = Recording(turning, None, testbed.mass_names, way, source="made")
    jumps = tuple(Jump(c, JOINED, (1.0,) * 9) for c in CUTS)
    problem = problem_of(recording, testbed, Params(TERMS, (), jumps))
    body = testbed.body
    point = Unknowns(
        exponential(TILT), SPIN, pseudo_inertia.from_inertia(body.inertia_C), body.com,
        10 * typical_sizes(TERMS), np.zeros(N_SENSOR), 1e-4 * np.ones(len(problem.layout.errors)),
        np.zeros(3),
    )  # fmt: skip
    names = problem.layout.errors
    point.error[[k for k, name in enumerate(names) if name.startswith("mass_lag")]] = 0.01
    return problem, point


def standing(problem):
    return problem.line.known[0, KNOWN_D : KNOWN_D + len(problem.maps.momentum)]


@pytest.mark.parametrize("k", range(5))
def test_sum_of_impulses_is_the_change_of_the_first_inertia_s_momentum(posed_case, k):
    """J w|_end - J w|_begin + int w x J w: whatever masses do meanwhile."""
    problem, point = posed_case
    known, nodes = known_at(problem, point), posed(problem).cuts.nodes
    stretch = slice(int(nodes[k]), int(nodes[k + 1]) + 1)
    found = impulse_of(problem, known, stretch, point, standing(problem))
    at, inertia = (
        followed(problem, known, stretch, point),
        inertia_at(problem, point, standing(problem)),
    )
    w = at.motion.rate
    turned = at.weights @ np.cross(w, w @ inertia)
    change = inertia @ (w[-1] - point.w0) + turned
    assert found.value.sum(axis=0) == pytest.approx(change, rel=1e-6, abs=2e-8)


def test_gravity_at_rest_is_weight_times_lever(posed_case):
    """Level, at rest: (m g) r across, which turns about the level axes alone."""
    problem, point = posed_case
    still = replace(point, q0=np.array([1.0, 0, 0, 0]), w0=np.zeros(3), torque=np.zeros(19),
                    error=0 * point.error, com=np.array([2e-5, -1e-5, -9e-5]))  # fmt: skip
    nodes, start = posed(problem).cuts.nodes, np.zeros(6)
    stretch = slice(0, 2)  # so short that the platform has hardly begun to swing
    found = impulse_of(problem, known_at(problem, still), stretch, still, start)
    seconds = problem.line.t[1] - problem.line.t[0]
    weight = 14.24 * 9.81
    assert found.value[cause.GRAVITY] / seconds == pytest.approx(
        weight * np.array([1e-5, 2e-5, 0.0]), rel=2e-2, abs=2e-5
    )
    assert len(nodes) == len(CUTS) + 2


@pytest.mark.parametrize("k", [0, 1, 3])
def test_slopes_are_differences(posed_case, k):
    problem, point = posed_case
    nodes, start = posed(problem).cuts.nodes, standing(problem)
    stretch = slice(int(nodes[k]), int(nodes[k + 1]) + 1)

    def value(step):
        other = moved_point(point, step, problem)
        return impulse_of(problem, known_at(problem, other), stretch, other, start).value

    slope = impulse_of(problem, known_at(problem, point), stretch, point, start).slope
    sizes = np.full(problem.layout.size, 1e-5)
    sizes[problem.layout.torques] = 1e-2 * typical_sizes(problem.layout.terms)
    sizes[12:15] = 1e-7
    for column, name in enumerate(problem.layout.names):
        step = np.zeros(problem.layout.size)
        step[column] = sizes[column]
        wanted = (value(step) - value(-step)) / (2 * sizes[column])
        scale = np.abs(slope[:, :, column]).max() + 1e-12
        assert slope[:, :, column] == pytest.approx(wanted, rel=2e-2, abs=2e-2 * scale), name
