"""A start for the trajectory fit, from the linear methods, so that nobody has to guess one.

The laboratory-axes momentum integral is solved with the testbed's inertia and centre of mass as
weak priors: they only decide what the record leaves open.
"""

import numpy as np

from equipoise.estimation.momentum_integral import balance
from equipoise.estimation.sampled_motion import SampledMotion, at_start, sampled_motion
from equipoise.estimation.unknowns import Layout, Unknowns
from equipoise.maths import pseudo_inertia
from equipoise.maths.linalg import pack_symmetric, unpack_symmetric
from equipoise.model.arrays import Floats
from equipoise.model.mass_properties import parallel_axis
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed

INERTIA_TRUST = 0.3  # relative sd of the testbed's inertia, chosen: a student's first CAD model
COM_TRUST = 3e-4  # m, least sd of the testbed's centre of mass


def start(recording: Recording, testbed: Testbed, layout: Layout, first: float) -> Unknowns:
    """Return a point near the optimum; ``first`` is the time (s) of the first node."""
    motion = sampled_motion(recording, testbed)
    inertia, com, torque = solve(recording, testbed, layout, motion)
    q0, w0 = at_start(motion, first)
    inertia_C = inertia - parallel_axis(testbed.body.mass, com)
    return Unknowns(
        q0, w0, pseudo_inertia.from_inertia(inertia_C), com, torque, np.zeros(len(layout.errors)),
        np.zeros(3),
    )  # fmt: skip


def solve(
    recording: Recording, testbed: Testbed, layout: Layout, motion: SampledMotion
) -> tuple[Floats, Floats, Floats]:
    """Return inertia (3, 3), centre of mass and the 16 torque coefficients."""
    rows = balance(recording, testbed, Layout(), *motion, "laboratory")
    body = testbed.body
    moments = np.diag(body.inertia_P)
    sizes = np.sqrt(pack_symmetric(np.outer(moments, moments)))
    spread = np.concatenate(
        [INERTIA_TRUST * sizes, body.mass * np.maximum(3 * testbed.com_sd, COM_TRUST)]
    )
    guess = np.concatenate([pack_symmetric(body.inertia_P), body.first_moment])
    scale = np.append(spread, np.full(3, float(sizes.max()) * 0.1))
    # what misfit the rows have anyway decides how much the priors weigh
    free, *_ = np.linalg.lstsq(rows.regressor * scale, rows.known, rcond=1e-10)
    left = rows.known - rows.regressor @ (scale * free)
    noise = max(float(np.sqrt(np.mean(left**2))), 1e-9)
    prior = np.hstack([np.diag(1.0 / spread), np.zeros((9, 3))])
    A = np.vstack([rows.regressor / noise, prior]) * scale
    b = np.concatenate([rows.known / noise, guess / spread])
    best = scale * np.linalg.lstsq(A, b, rcond=None)[0]
    return unpack_symmetric(best[:6]), best[6:9] / body.mass, np.zeros(16)
