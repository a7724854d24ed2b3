"""First points for many records of one testbed that share their times and known inputs.

What ``initial_guess`` gives each alone, in one compiled call (``kernels.momentum_start``).
"""

import numpy as np

from equipoise.estimation.motion.sampled_motion import rows_around
from equipoise.estimation.output_error.initial_guess import (
    COM_TRUST,
    CORRELATED,
    MOMENTUM_SIZE,
    WITH_GYRO,
    WITHOUT,
    kept,
)
from equipoise.estimation.output_error.kernels.many_records import points_at
from equipoise.estimation.output_error.kernels.momentum_start import Body, Inputs, start_each
from equipoise.estimation.output_error.problem import Problem
from equipoise.estimation.parameters.fit_parameters import core_of
from equipoise.estimation.parameters.retraction import ERROR
from equipoise.estimation.regression.formulations.columns import known_impulse, moved_masses
from equipoise.maths.linalg import PAIRS, element_sizes, pack_symmetric, unpack_symmetric
from equipoise.maths.sampled.running_integral import parabola_weights
from equipoise.model.arrays import Floats
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed
from equipoise.sensors.timing import measured_at


def first_points(
    problem: Problem, attitudes: Floats, rates: Floats, hold: tuple[str, ...] = ()
) -> Floats:
    """Return two first points of each record, (k, 2, p): by momentum, and as measured.

    ``attitudes`` (k, n, 4) and ``rates`` (k, m, 3), rad/s, are of all records; the problem is that
    of one of them. ``hold``: what is at the testbed's value.
    """
    recording, testbed = problem.recording, problem.testbed
    inputs, body = inputs_of(recording, testbed), body_of(testbed, rates.shape[1] > 0)
    bodies, motions = np.empty((len(attitudes), 9)), np.empty((len(attitudes), 10))
    start_each(inputs, body, attitudes, rates, bodies, motions)
    if hold:
        for row in bodies:
            inertia, com = kept(unpack_symmetric(row[:6]), row[6:].copy(), testbed, hold)
            row[:] = *pack_symmetric(inertia), *com
    ahead, size = float(problem.line.t[0] - inputs.t[0]), ERROR + len(problem.layout.errors) + 3
    return points_at(bodies, motions, inputs.mass, ahead, size)


def inputs_of(recording: Recording, testbed: Testbed) -> Inputs:
    """Return what is the same in all records, from one of them."""
    assert recording.attitude is not None
    t = measured_at(recording.attitude.t, testbed.attitude)
    bend, momentum, shifted = moved_masses(recording, testbed, t)
    i, j = np.array(PAIRS).T
    period, rows, inside = float(np.median(np.diff(t))), np.zeros((len(t), 2), np.int64), t != t
    if recording.rate is not None and len(recording.rate):
        rate_t = measured_at(recording.rate.t, testbed.gyro)
        rows = np.column_stack(rows_around(rate_t, t, period)).astype(np.int64)
        inside = (t >= rate_t[0]) & (t <= rate_t[-1])
    bent = np.ascontiguousarray(bend[:, i, j])
    return Inputs(t, period, *parabola_weights(t), bent, momentum, shifted,
                  known_impulse(recording, t), rows, inside, testbed.body.mass,
                  testbed.gravity)  # fmt: skip


def body_of(testbed: Testbed, with_gyro: bool) -> Body:
    """Return what is believed of the platform before its records are seen."""
    body, trusts = testbed.body, (WITH_GYRO, WITHOUT) if with_gyro else (WITHOUT,)
    com_sd = np.maximum(3 * testbed.com_sd, COM_TRUST)
    sizes = element_sizes(body.inertia_P)
    momentum = MOMENTUM_SIZE * float(sizes.max())
    return Body(core_of(body), sizes, com_sd, momentum, np.array(trusts), CORRELATED)
