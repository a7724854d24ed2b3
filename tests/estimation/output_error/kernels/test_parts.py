"""A record's local model is the same, whether each part has all columns or its own alone."""

import warnings
from dataclasses import replace

import numpy as np
import pytest

from equipoise.estimation.output_error.initial_guess import start
from equipoise.estimation.output_error.kernels.gauss_newton import descend
from equipoise.estimation.output_error.kernels.parts import Parts, parts_of
from equipoise.estimation.output_error.kernels.record_pass import local_for
from equipoise.estimation.output_error.problem import Problem, posed
from equipoise.estimation.output_error.segment_jumps import Jump, walk
from equipoise.estimation.output_error.trajectory import Params, problem_of
from equipoise.estimation.parameters.fit_parameters import Unknowns
from equipoise.maths.levenberg_marquardt import FIRST, GROWTH
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import Testbed
from tests.support.builders import move_at, noisy, platform, recording

RATE_NAMES = ("rate_x", "rate_y", "rate_z")
STEP = Jump(21.0, ("com_x", "com_y", "com_z"), (1e-5,) * 3, is_event=True)
TOUCHES = (*walk(np.arange(3.0, 38.0, 2.0), RATE_NAMES, np.full(3, 1e-3)), STEP)


def moved_twice(slow: float = 0.0) -> Samples:
    """Masses that travel at 5 s and back at 25 s; one of them creeps by ``slow`` m/s besides."""
    out = move_at(5.0, 40.0)
    t = np.array([0.0, 5.0, 6.0, 10.0, 25.0, 27.0, 40.0])
    d = np.vstack([[np.interp(x, out.t, out.values[:, k]) for k in range(3)] for x in t])
    d[5:, :2], d[:, 2] = 0.0, d[:, 2] + slow * t
    return Samples(t, d)


def problem_with(jumps: tuple[Jump, ...], slow: float = 0.0) -> Problem:
    """A record of 40 s whose masses may be off in their stops and sizes."""
    record = noisy(recording(40.0, moved_twice(slow), gyro=20.0), 3, np.zeros(3))
    testbed: Testbed = platform(3e-4, gyro=True)
    masses = tuple(replace(mass, mass_sd=0.01 * mass.mass) for mass in testbed.masses)
    moved: Recording = replace(record, masses=moved_twice(slow))
    return problem_of(moved, replace(testbed, masses=masses), Params(("swirl",), jumps=jumps))


def with_every_column(parts: Parts, problem: Problem) -> Parts:
    """The same parts with all columns each."""
    n, kinds = len(parts.nodes) - 1, problem.columns.kinds
    return Parts(
        parts.nodes, parts.stretch, np.arange(n + 1) * len(kinds), np.tile(kinds, n),
        np.tile(problem.columns.indices, n), np.tile(np.arange(len(kinds)), n),
    )  # fmt: skip


def undivided(problem: Problem) -> Parts:
    """One part a stretch, with all columns."""
    parts = posed(problem).parts
    nodes, stretch = parts.nodes[parts.stretch], np.arange(len(parts.stretch))
    return with_every_column(Parts(nodes, stretch, *parts[2:]), problem)


def local_model(problem: Problem, parts: Parts) -> tuple[np.ndarray, ...]:
    """Normal matrix, descent, residuals and cost a little way from the start."""
    layout, rng = problem.layout, np.random.default_rng(1)
    point: Unknowns = replace(
        first_point(problem), error=1e-4 * rng.standard_normal(len(layout.errors))
    )
    what = posed(problem)._replace(parts=parts)
    best, size = local_for(what, point.flat), layout.size
    best.pieces.jumps[:] = 1e-4 * rng.standard_normal(best.pieces.jumps.shape)
    normal, toward = np.eye(size), np.zeros(size)
    cost = descend(what, best, 1, normal, toward, FIRST, GROWTH).cost
    sizes = np.sqrt(np.diag(normal))
    scaled = normal / np.outer(sizes, sizes)
    return scaled, toward / sizes, best.left_q, best.left_w, np.array([cost])


def first_point(problem: Problem) -> Unknowns:
    """The testbed's body where the record begins."""
    first = float(problem.line.t[0])
    return start(problem.recording, problem.testbed, problem.layout, first, ())


@pytest.mark.parametrize("jumps", [(), TOUCHES])
@pytest.mark.parametrize(("slow", "alike"), [(0.0, 1e-9), (1e-5, 1e-4)])
def test_parts_with_their_own_columns_make_the_whole(jumps, slow, alike):
    """Where a mass creeps by 0.4 mm, arms of 200 mm are taken as at its middle."""
    problem = problem_with(jumps, slow)
    own = posed(problem).parts
    assert len(own.kinds) < 0.9 * len(with_every_column(own, problem).kinds)
    found, wanted = (local_model(problem, parts) for parts in (own, undivided(problem)))
    for x, y in zip(found, wanted, strict=True):
        np.testing.assert_allclose(x, y, rtol=alike, atol=alike * np.abs(y).max())


def test_a_part_where_masses_stand_has_no_column_of_an_error():
    """Moves at 5 to 10 s and 25 to 27 s: they stand in the first part, and others."""
    problem = problem_with(())
    parts, t = posed(problem).parts, problem.line.t
    begins = np.searchsorted(t, np.array([0.0, 5.0, 10.0, 25.0, 27.0, 40.0]) - 1e-9)
    late = [0, 0, 1, 0, 1, 0]  # steps: a stand begins one late
    np.testing.assert_array_equal(parts.nodes, begins + late)
    counts = np.diff(parts.first)
    assert list(counts[[0, 2, 4]]) == [16, 16, 16]  # state 6, J 6, first moment 3, a torque
    assert min(counts[[1, 3]]) > 16


def test_a_creeping_share_keeps_its_column():
    """What grows with a displacement that never stands is no constant."""
    problem = problem_with((), 1e-5)
    own = posed(problem).parts
    names = problem.layout.names
    gains = [k for k, name in enumerate(names) if name.startswith("gain_z")]
    assert len(gains) == 1
    for p in range(len(own.nodes) - 1):
        assert gains[0] in own.places[own.first[p] : own.first[p + 1]]


def test_cuts_are_where_parts_begin():
    problem = problem_with(TOUCHES)
    what = posed(problem)
    np.testing.assert_array_equal(what.parts.nodes[what.parts.stretch], what.cuts.nodes)
    again = parts_of(problem.line, what.cuts.nodes, problem.columns)
    np.testing.assert_array_equal(again.nodes, what.parts.nodes)


def test_a_grid_of_one_node_has_no_part():
    problem = problem_with(())
    line = problem.line._replace(t=problem.line.t[:1], known=problem.line.known[:1])
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        parts = parts_of(line, np.array([0, 0]), problem.columns)
    assert len(parts.nodes) == 1
    assert len(parts.kinds) == 0
