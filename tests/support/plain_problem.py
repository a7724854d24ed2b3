"""Problems of the trajectory fit in a form that plain code can follow, for several tests."""

from dataclasses import replace

import numpy as np

from equipoise.dynamics.rigid_body import KNOWN_D
from equipoise.dynamics.timeline import timeline
from equipoise.estimation.output_error.problem import Problem
from equipoise.estimation.parameters.fit_parameters import Unknowns, physical, unknowns_of
from equipoise.estimation.parameters.retraction import retract
from equipoise.maths.attitude import difference
from equipoise.model.recording import Recording
from tests.support.builders import MASS


def noded(problem: Problem, record: Recording) -> Problem:
    """The same problem with a node at every row, where the plain propagator can be compared."""
    cut = np.array([jump.t for jump in problem.jumps])
    line = timeline(
        record.attitude.t, record.rate.t, record.masses, len(problem.maps.momentum), 1.0,
        record.momentum, record.torque, problem.errors.response, problem.errors.owner, cut=cut,
        temperature=record.temperature,
    )  # fmt: skip
    observed = problem.observed._replace(
        attitude_node=line.attitude_node,
        attitude_share=line.attitude_share,
        rate_node=line.rate_node,
        rate_share=line.rate_share,
    )
    return replace(problem, line=line, observed=observed)


def with_errors(problem: Problem, error: np.ndarray) -> np.ndarray:
    """Return the known inputs with the masses where they really are."""
    known, k = problem.line.known.copy(), len(problem.maps.momentum)
    for j, (owner, unknown) in enumerate(problem.errors.owner):
        known[:, KNOWN_D + owner] += error[unknown] * known[:, KNOWN_D + k + j]
    return known


def stepped(problem: Problem, point: Unknowns, step: np.ndarray) -> Unknowns:
    """Return the point after a step in physical coordinates."""
    out = np.empty_like(point.flat)
    retract(point.flat, step, MASS, problem.layout.slots, out)
    return unknowns_of(out)


def separation(problem: Problem, point: Unknowns, other: Unknowns) -> np.ndarray:
    """Return how far another point is in physical coordinates, body axes for the attitude."""
    there, here = (physical(p, MASS, problem.layout) for p in (other, point))
    off = there - here
    off[:3] = difference(other.q0, point.q0)
    return off
