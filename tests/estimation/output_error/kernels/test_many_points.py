"""Many points of one problem at once: each as by itself, and peaks as energy has them."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.dynamics.propagation import NO_COLUMNS, NO_GROUPS, propagate, rigid_body, stacked
from equipoise.dynamics.sensitivities import Inputs
from equipoise.estimation.information.information_matrix import ended_at
from equipoise.estimation.output_error.kernels.many_points import information_at, peaks_at
from equipoise.estimation.output_error.problem import posed as as_posed
from equipoise.estimation.output_error.trajectory import Params
from equipoise.io.testbed.presets import read_preset
from equipoise.maths.attitude import tilt
from equipoise.model.manoeuvre import Manoeuvre
from equipoise.model.mass_properties import MassProperties
from equipoise.planning.manoeuvre.noiseless_record import imagined
from equipoise.planning.manoeuvre.predicted_information import posed, true_point

X = np.array([1.0, 0.0, 0.0])
MOVED = Manoeuvre(
    40.0, np.radians(6.0), X, np.radians([0.5, 0.0, 2.0]),
    ((10.0, {"x1": -0.010, "z1": -0.030}), (25.0, {"x1": 0.005})),
)  # fmt: skip
SWING = Manoeuvre(60.0, np.radians(20.0), X, np.zeros(3), ())


def hanging(by=100e-6):
    """The preset with its principal axes along the body's, com straight below the pivot (m)."""
    bed = read_preset("sputnix")
    body = MassProperties(bed.body.mass, np.array([0.0, 0.0, -by]), np.diag([0.6, 0.8, 1.0]))
    return replace(bed, body=body)


def problem_and_points(manoeuvre, fineness=1.0):
    """The problem of a manoeuvre, and three points that differ in all that platforms differ in."""
    bed = hanging()
    observed = imagined(bed, bed.body, manoeuvre)
    problem = posed(observed, bed, Params(fineness=fineness), None)
    first = true_point(observed, bed.body, manoeuvre, problem.layout)
    second = replace(first, com=np.array([4e-6, -3e-6, -70e-6]), w0=first.w0 + 0.01)
    third = replace(first, six=first.six + 0.02, error=first.error + 2e-4)
    return bed, problem, (first, second, third)


def peaks_of(bed, problem, points):
    """Tilt and rate at most, of each point."""
    line, maps = problem.line, stacked(problem.maps)
    inputs = Inputs(maps, line.t, line.known, line.owners, NO_COLUMNS, NO_GROUPS)
    rows = np.array([point.flat for point in points])
    return peaks_at(inputs, problem.mass, problem.gravity, rows, bed.up)


def test_the_information_at_many_points_is_that_at_each():
    _, problem, points = problem_and_points(MOVED)
    together = information_at(as_posed(problem), np.array([p.flat for p in points]))
    for one, point in zip(together, points, strict=True):
        np.testing.assert_array_equal(one, ended_at(problem, point).at.normal)
    assert np.abs(together[1] / together[0] - 1)[6, 6] > 1e-3


def test_the_peaks_of_many_motions_are_those_of_each():
    """As the propagator has them at the nodes, or up to 1 % more, which is between these."""
    bed, problem, points = problem_and_points(MOVED)
    together = peaks_of(bed, problem, points)
    for found, point in zip(together, points, strict=True):
        rigid = rigid_body(point.body(problem.mass), problem.gravity)
        motion = propagate(rigid, problem.maps, problem.line, point.q0, point.w0)
        at_nodes = [tilt(motion.q, bed.up).max(), np.linalg.norm(motion.rate, axis=1).max()]
        assert np.all(found >= np.array(at_nodes) - 1e-9)
        np.testing.assert_allclose(found, at_nodes, rtol=0.01)
        np.testing.assert_array_equal(peaks_of(bed, problem, [point])[0], found)
    assert np.abs(together[2] / together[0] - 1).max() > 1e-3


@pytest.mark.parametrize("fineness", [1.0, 0.5])
def test_the_peaks_of_a_swing_are_as_its_energy_has_them(fineness):
    """Let go at rest at 20 deg about y: no tilt is greater, and J w^2 / 2 = m g l (1 - cos 20 deg).

    The moment of inertia is 0.8 kg m^2. Low side x: the body turns about y.
    """
    bed, problem, (first, *_) = problem_and_points(SWING, fineness)
    (found,) = peaks_of(bed, problem, [first])
    lift = 100e-6 * (1 - np.cos(np.radians(20.0)))
    rate = np.sqrt(2 * bed.body.mass * bed.gravity * lift / 0.8)
    np.testing.assert_allclose(found, [np.radians(20.0), rate], rtol=2e-3)
