"""Held values: moments and centre of mass that stay exactly where they are set.

A held coordinate has no step of its own (``gauss_newton``). It moves all the same where a step
leads to a body that cannot exist, which is put back among the possible ones as a whole
(``pseudo_inertia``). A first point may also have another value than the one to hold. So a point is
put right before a search, and after it. The search keeps the inertia about the centre of mass, of J
about P and com r

    J_C = J - m (|r|^2 E - r r^T)
"""

from dataclasses import replace

import numpy as np

from equipoise.estimation.output_error.problem import Problem
from equipoise.estimation.output_error.solution import MOST, Fitted, settle
from equipoise.estimation.parameters.fit_parameters import CORE, JP, R, Unknowns, core_of
from equipoise.maths import pseudo_inertia
from equipoise.maths.linalg import pack_symmetric, unpack_symmetric
from equipoise.model.arrays import Bools, Floats
from equipoise.model.mass_properties import parallel_axis

PINNED, REPINNED = 1e-9, 3  # relative; times that a held value is put back, chosen
ROUNDING = 1e-13  # of a moment, for products held at zero, chosen


def fixed(problem: Problem) -> Bools:
    """Return which unknowns have one value; what an open scale is held by may have any."""
    held, mean = problem.prior.held, problem.prior.mean
    return held & (mean == 0.0) if problem.scale_open else held


def pinned(problem: Problem, point: Unknowns) -> Unknowns:
    """Return the point with held moments and centre of mass exactly where they are held."""
    body, mean, held = point.body(problem.mass), problem.prior.mean, fixed(problem)
    packed = pack_symmetric(body.inertia_P)
    six: Floats = np.where(held[JP], mean[JP], packed)
    com: Floats = np.where(held[R], mean[R], point.com)
    if np.array_equal(six, packed) and np.array_equal(com, point.com):
        return point
    inertia_C = unpack_symmetric(six) - parallel_axis(problem.mass, com)
    return replace(point, six=pseudo_inertia.from_inertia(inertia_C), com=com)


def settle_pinned(
    problem: Problem, point: Unknowns, jumps: Floats | None = None, most: int = MOST
) -> Fitted:
    """Return the optimum with held values held.

    A search that touches the boundary of the possible bodies is put back inside, and takes what is
    held along; from where it ends it is put right and goes the little way again. One that never
    stays is left where it is put right, not settled.
    """
    found = settle(problem, pinned(problem, point), jumps, most)
    for _ in range(REPINNED):
        if is_pinned(problem, found.point):
            return found
        found = settle(problem, pinned(problem, found.point), found.jumps, most)
    if is_pinned(problem, found.point):
        return found
    return settle(problem, pinned(problem, found.point), found.jumps, 1)


def is_pinned(problem: Problem, point: Unknowns) -> bool:
    """Say whether held moments and centre of mass are where they are held."""
    body = point.body(problem.mass)
    rounding = np.append(np.full(6, ROUNDING * np.trace(body.inertia_P)), np.zeros(3))
    mean, held = problem.prior.mean[CORE], fixed(problem)[CORE]
    near = np.abs(core_of(body) - mean) <= PINNED * np.abs(mean) + rounding
    return bool(np.all(near[held]))
