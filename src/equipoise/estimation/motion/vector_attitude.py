"""Attitude and rate by a gyro and sensors of vectors, without a camera: a start for a fit.

The gyro, less a bias b, is integrated from an attitude that turns the vectors of the first second
onto those of the laboratory (Wahba's problem; with gravity alone the heading is near zero). Where
the first attitude R_0 errs by theta (body axes) and the bias by db, with Q_k from the axes at t_k
to those at t_0,

    Q_k ( y_k - R_k^T v_N ) = c x ( theta - I_k db ),     c = R_0^T v_N,    I_k = integral of Q

which is linear: theta and db follow from all rows at once, and again from where that leads.

Cannot see the heading without a second vector; takes biases of the other sensors, and what an
accelerometer feels of turning, for noise.
"""

import numpy as np
import scipy

from equipoise.maths.attitude import exponential, from_matrix, multiply, normalise, to_matrix
from equipoise.maths.kernels.compiled import kernel
from equipoise.model.arrays import Floats, Matrix3, Quaternion, Series1, Series3, Series4, Vector3
from equipoise.model.recording import Samples
from equipoise.model.testbed import Gyro
from equipoise.sensors.vector_sensors import VectorSensor

Rows = list[tuple[VectorSensor, Samples]]

FIRST = 1.0  # s, chosen: of the rows that make the first attitude
ROUGH = 0.01  # of a vector's length, chosen: one sd of a row, biases and turning included
OPEN = 1.0  # rad, chosen: one sd of the first attitude, which decides the heading alone
EXACT = 1e-6  # rad/s, chosen: what a stated sd of 0 is taken for
TURNS = 3  # chosen: the drift of a bias is no small angle at first


@kernel
def _integrate(q: Floats, half_turns: Floats) -> None:
    for i in range(1, q.shape[0]):
        a, b = q[i - 1], half_turns[i - 1]
        q[i, 0] = a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3]
        q[i, 1] = a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2]
        q[i, 2] = a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1]
        q[i, 3] = a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]


def integrate_rate(t: Series1, w: Series3, q0: Quaternion) -> Series4:
    """Return the attitudes that rates w (rad/s) lead to from q0."""
    q = np.zeros((len(t), 4))
    q[0] = q0
    _integrate(q, exponential(0.5 * (w[1:] + w[:-1]) * np.diff(t)[:, None]))
    return normalise(q)


def first_attitude(rows: Rows, start: float) -> Quaternion:
    """Return the attitude that turns what is measured from ``start`` (s) on onto the laboratory."""
    early = [(each, channel.values[channel.t <= max(start, channel.t[0]) + FIRST])
             for each, channel in rows]  # fmt: skip
    measured = np.array([_unit(np.median(values, axis=0)) for _, values in early])  # some are wild
    true = np.array([_unit(each.vector_N) for each, _ in early])
    return from_matrix(
        scipy.spatial.transform.Rotation.align_vectors(true, measured)[0].as_matrix()
    )


def _unit(vector: Vector3) -> Vector3:
    return vector / np.linalg.norm(vector)


def running_integral(t: Series1, R: Floats) -> Floats:
    """Return the integral of matrices (n, 3, 3) from the first time to each, by trapezoids."""
    steps = 0.5 * (R[1:] + R[:-1]) * np.diff(t)[:, None, None]
    return np.concatenate([np.zeros((1, 3, 3)), np.cumsum(steps, axis=0)])


def corrections(rows: Rows, t: Series1, q: Series4, bias_sd: float) -> tuple[Vector3, Vector3]:
    """Return theta (rad) and db (rad/s) of an attitude that was integrated along times t (s)."""
    R_0: Matrix3 = to_matrix(q[0])
    Q: Floats = R_0.T @ to_matrix(q)
    integral = running_integral(t, Q)
    normal, right = np.diag(np.repeat([OPEN**-2, bias_sd**-2], 3)), np.zeros(6)
    for sensor, channel in rows:
        k = np.clip(np.searchsorted(t, channel.t - sensor.delay), 0, len(t) - 1)
        c, length = sensor.vector_N @ R_0, float(np.linalg.norm(sensor.vector_N))
        cross = np.cross(c, np.eye(3)).T
        A = np.concatenate([np.broadcast_to(cross, (len(k), 3, 3)), -cross @ integral[k]], axis=2)
        left = np.einsum("nij,nj->ni", Q[k], channel.values) - c
        sd = np.hypot(sensor.noise, ROUGH * length)
        normal += np.einsum("nia,nib->ab", A, A) / sd**2
        right += np.einsum("nia,ni->a", A, left) / sd**2
    found = np.linalg.solve(normal, right).astype(np.float64, copy=False)
    return found[:3], found[3:]


def attitude_by_vectors(
    rows: Rows, t: Series1, w: Series3, gyro: Gyro | None
) -> tuple[Series4, Series3]:
    """Return attitudes and rates (rad/s) without the gyro's bias along its times t (s)."""
    bias_sd = gyro.bias_sd if gyro and gyro.bias_sd else EXACT
    q0, bias = first_attitude(rows, float(t[0])), np.zeros(3)
    for _ in range(TURNS):
        theta, change = corrections(rows, t, integrate_rate(t, w - bias, q0), bias_sd)
        q0, bias = multiply(q0, exponential(theta)), bias + change
    return integrate_rate(t, w - bias, q0), w - bias
