"""What one recording says of the body by itself, to be put together with others.

A trajectory fit with the testbed's prior ends at x, where the information A (data and prior) and
the pull of the prior are known. Of inertia and centre of mass, all else marginalised, with W the
prior's weight and m its mean:

    Lambda = A_cc - A_co A_oo^-1 A_oc - W,      eta = Lambda x + W (x - m)

is what the recording adds, near x: it says Lambda y = eta. Along the scale of J and com, which a
free swing does not show, x only says which ratios hold, and Lambda x = 0 there at every scale: so
recordings at different loads determine together the scale that none determines alone.

Taken to be Gauss-Newton's parabola at x; the prior should not be narrower than what is sought.

Cannot see a torque that wanders: 1 uN m of air within 30 s makes errors of J_zz 1.4 times as large
as stated (`verification/manual.py`), and a recording of a minute does not show that it is there.
"""

from typing import NamedTuple

import numpy as np

from equipoise.estimation.output_error import trajectory
from equipoise.estimation.output_error.fit_estimate import conclude, residual_of, widening
from equipoise.estimation.output_error.free_vertical import with_free_vertical
from equipoise.estimation.parameters.fit_parameters import CORE, core_of
from equipoise.maths.linalg import schur_complement, symmetrise
from equipoise.model.arrays import Floats, Square
from equipoise.model.estimate import Estimate
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed


class Shown(NamedTuple):
    """What a recording says of J_P (6) and com (3), without any prior."""

    information: Square
    pull: Floats  # information times what it says
    estimate: Estimate  # with the prior


def shown_by(recording: Recording, testbed: Testbed) -> Shown:
    """Return what a recording says of a platform that is about as the testbed has it."""
    params = trajectory.Params(testbed.disturbances, use_prior=True)
    params = with_free_vertical(recording, testbed, params)
    fitted = trajectory.fit(recording, testbed, params)
    prior, x = fitted.problem.prior, core_of(fitted.point.body(fitted.problem.mass))
    weight, mean = prior.weight[CORE], prior.mean[CORE]
    information, pull = data_alone(fitted.at.normal, x, weight, mean)
    factor = widening(residual_of(fitted)) ** 2
    estimate = conclude(fitted, trajectory.METHOD, recording)
    return Shown(information / factor, pull / factor, estimate)


def data_alone(normal: Square, x: Floats, weight: Floats, mean: Floats) -> tuple[Square, Floats]:
    """Return Lambda and eta of the optimum's information, x there, and the prior of the core."""
    core = range(len(normal))[CORE]
    others = [k for k in range(len(normal)) if k not in core]
    information = symmetrise(schur_complement(normal, core, others)) - np.diag(weight)
    return information, information @ x + weight * (x - mean)
