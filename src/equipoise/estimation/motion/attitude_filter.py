"""Attitude, rate and gyro bias in real time: the feedback of a balancing law.

    q' = 1/2 q (0, w_meas - b),   b' = 0        error state [theta (body, rad), b], multiplicative

The gyro carries the attitude from row to row, the camera corrects it and the bias. Noise being the
same on all axes, one 2 x 2 covariance serves all three:

    row of the gyro, dt later     P <- A P A^T + diag(sd_w^2 dt_w dt, walk^2 dt),  A = [1 -dt; 0 1]
    row of the camera             K = P[:, 0] / (P00 + sd_q^2),
                                  q <- q exp(K0 v),  b <- b + K1 v,  v = log(q^-1 q_meas)

(Markley and Crassidis 2014 section 6.2, for isotropic noise.) The rate is the mean of the gyro's
rows since the last call, without bias, so it lags by half that time. It knows no platform: nothing
here depends on inertia or centre of mass.

Cannot see a bias that turns with the attitude (the Earth's rate), nor a camera out of plumb.
"""

from dataclasses import dataclass

import numpy as np

from equipoise.estimation.motion.sensor_noise import camera_noise, gyro_noise
from equipoise.maths.kernels.compiled import kernel
from equipoise.maths.turns import turn, turned
from equipoise.model.arrays import Floats, Ints, Quaternion, Series, Series1, Vector3
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import Testbed
from equipoise.sensors.timing import measured_at

WALK = 3e-7  # rad/s/sqrt(s), chosen: what a MEMS gyro's bias walks, 0.1 deg/s in two days
BIAS_SD = 0.02  # rad/s, chosen: of a gyro that the testbed does not state
GYRO, CAMERA = 0, 1
T, Q, B, RATE = 0, slice(1, 5), slice(5, 8), slice(11, 14)  # of the state


@dataclass(frozen=True, slots=True, eq=False)
class AttitudeState:
    """Time, attitude, bias, covariance (P00, P01, P11) and mean rate, as one array (14,)."""

    values: Floats

    @property
    def t(self) -> float:
        """Time of the last row, s."""
        return float(self.values[T])

    @property
    def q(self) -> Quaternion:
        """Attitude, body to laboratory."""
        return self.values[Q]

    @property
    def rate(self) -> Vector3:
        """Mean rate over the last call's rows, rad/s, without bias."""
        return self.values[RATE]

    @property
    def bias(self) -> Vector3:
        """Bias of the gyro, rad/s."""
        return self.values[B]


@kernel
def _follow(kind: Ints, t: Floats, rows: Floats, gyro: float, camera: float, x: Floats) -> None:
    """Take the state through rows in order of time; a gyro's row is a rate, a camera's a q."""
    wx, wy, wz, n = 0.0, 0.0, 0.0, 0
    for i in range(t.shape[0]):
        dt = max(t[i] - x[0], 0.0)
        if kind[i] == 0:
            wx, wy, wz, n = wx + rows[i, 0], wy + rows[i, 1], wz + rows[i, 2], n + 1
            a, b, c = rows[i, 0] - x[5], rows[i, 1] - x[6], rows[i, 2] - x[7]
        elif n > 0:  # to a camera's row with the last rate
            a, b, c = wx / n - x[5], wy / n - x[6], wz / n - x[7]
        else:
            a, b, c = x[11], x[12], x[13]
        x[1], x[2], x[3], x[4] = turned(x[1:5], a * dt, b * dt, c * dt)
        x[8] += dt * (dt * x[10] - 2.0 * x[9] + gyro)
        x[9] -= dt * x[10]
        x[10] += WALK * WALK * dt
        x[0] += dt
        if kind[i] == 1:
            k0, k1 = x[8] / (x[8] + camera), x[9] / (x[8] + camera)
            u, v, w = turn(x[1:5], rows[i])
            x[1], x[2], x[3], x[4] = turned(x[1:5], k0 * u, k0 * v, k0 * w)
            x[5], x[6], x[7] = x[5] + k1 * u, x[6] + k1 * v, x[7] + k1 * w
            x[10] -= k1 * x[9]
            x[9] *= 1.0 - k0
            x[8] *= 1.0 - k0
    norm = (x[1] * x[1] + x[2] * x[2] + x[3] * x[3] + x[4] * x[4]) ** -0.5
    for j in range(1, 5):
        x[j] *= norm
    if n > 0:
        x[11], x[12], x[13] = wx / n - x[5], wy / n - x[6], wz / n - x[7]


def first_state(t: float, q: Quaternion, testbed: Testbed) -> AttitudeState:
    """Return the state at a first row of the camera (s); the bias is only known to its sd."""
    sd = BIAS_SD if testbed.gyro is None else testbed.gyro.bias_sd
    spread = np.array([camera_noise(testbed) ** 2, 0.0, sd**2])
    return AttitudeState(np.concatenate([[t], q, np.zeros(3), spread, np.zeros(3)]))


def in_time(recording: Recording, testbed: Testbed) -> tuple[Ints, Series1, Series]:
    """Return kind, time (s) and values (4 columns) of gyro and camera rows, in order of time."""
    none = Samples(np.zeros(0), np.zeros((0, 4)))
    gyro, camera = recording.rate or none, recording.attitude or none
    times = [measured_at(gyro.t, testbed.gyro), measured_at(camera.t, testbed.attitude)]
    wide = np.zeros((len(gyro), 4))
    wide[:, : gyro.values.shape[1]] = gyro.values
    kind = np.repeat([GYRO, CAMERA], [len(gyro), len(camera)])
    t = np.concatenate(times)
    order = np.argsort(t, kind="stable")
    return kind[order], t[order], np.vstack([wide, camera.values])[order]


def followed(
    state: AttitudeState | None, fresh: Recording, testbed: Testbed
) -> AttitudeState | None:
    """Return the state after a fresh record; None until the camera has given a first row."""
    kind, t, rows = in_time(fresh, testbed)
    if state is None:
        observed = np.flatnonzero(kind == CAMERA)
        if not len(observed):
            return None
        first = int(observed[0])
        state = first_state(float(t[first]), rows[first], testbed)
        kind, t, rows = kind[first + 1 :], t[first + 1 :], rows[first + 1 :]
    rate = 100.0 if testbed.gyro is None else testbed.gyro.rate
    # rad^2/s, sd^2 times the time between rows; rad^2
    gyro, camera = gyro_noise(testbed) ** 2 / rate, camera_noise(testbed) ** 2
    values = state.values.copy()
    _follow(kind, t, rows, gyro, camera, values)
    return AttitudeState(values)
