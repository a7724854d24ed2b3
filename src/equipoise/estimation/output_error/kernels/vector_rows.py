"""Rows of sensors that see a vector of the laboratory: accelerometer, sun sensor, magnetometer.

    y  = M^T f + b,    f = u + w' x p + w x (w x p),    u = R^T v_N     (``sensors.vector_sensors``)
    dy = M^T ( u x dth + dw' x p + dw x (w x p) + w x (dw x p) ) + dM^T f + db

    M^T f = f - m x f + m x (m x f) / 2,     dM^T f = -dm x f + ( dm x (m x f) + m x (dm x f) ) / 2

(wrong by m^3 / 6: 1e-6 at 1 deg). dth is the turn of the attitude, body axes, and dw' follows
from the same columns as the motion (``dynamics.angular_acceleration``): an accelerometer away from
P also sees inertia and torque.
"""

from typing import NamedTuple

from equipoise.dynamics.angular_acceleration import (
    angular_acceleration,
    forcing_change,
    inertia_change,
)
from equipoise.dynamics.rigid_body import ROWS, Now, cross, times
from equipoise.dynamics.sensitivities import LANES, Inputs, Work, place, spot
from equipoise.maths.kernels.compiled import part
from equipoise.maths.turns import to_body
from equipoise.model.arrays import Floats, Ints, Triple


class Vectors(NamedTuple):
    """What sensors of vectors reported, in order of time, and of which sensor each row is."""

    values: Floats  # (n_v, 3) SI
    node: Ints  # (n_v,) of the timeline
    share: Floats  # of the step behind the node
    sensor: Ints  # (n_v,) among the k sensors
    vector_N: Floats  # (k, 3) SI
    place: Floats  # (k, 3) m
    sd: Floats  # (k,) SI
    bias: Ints  # (k,) where a list of coefficients has its bias; -1: it has none
    mounting: Ints  # (k,) likewise its mounting


@part
def row_at(values: Floats, k: int) -> Triple:
    """Return a row of three numbers."""
    return (values[k, 0], values[k, 1], values[k, 2])


@part
def plus(a: Triple, b: Triple) -> Triple:
    """Return a + b."""
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


@part
def is_aside(p: Triple) -> bool:
    """Say whether a place is not P itself."""
    return p[0] != 0.0 or p[1] != 0.0 or p[2] != 0.0


@part
def by_turning(p: Triple, w: Triple, turning: Triple) -> Triple:
    """Return w' x p + w x (w x p)."""
    return plus(cross(turning, p), cross(w, cross(w, p)))


@part
def turn_columns(u: Triple, n: int, scale: float, y: Floats, S: Floats) -> None:
    """Write u x dth of n columns, times ``scale``."""
    for c in range(n):
        k, i = ROWS + place(c), spot(c)
        x = cross(u, (y[k], y[k + LANES], y[k + 2 * LANES]))
        S[i], S[i + LANES], S[i + 2 * LANES] = scale * x[0], scale * x[1], scale * x[2]


@part
def acceleration_columns(
    now: Now, inputs: Inputs, i: int, share: float, p: Triple, w: Triple, work: Work, scale: float,
    S: Floats,
) -> Triple:  # fmt: skip
    """Add what a place p feels of turning to every column, times ``scale``; return w'.

    ``work`` holds the state, its slope and the forcing at ``share`` of step i.
    """
    y, dy, fb, bend = work.at, work.dy, work.fb, inertia_change(inputs, i, share)
    turning = angular_acceleration(now, inputs, i, bend, (dy[4], dy[5], dy[6]), w)
    swept = cross(w, p)
    for c in range(inputs.columns.kinds.shape[0]):
        f, k = place(c), ROWS + place(c) + 3 * LANES
        dw = times(now.inverse, (y[k] - fb[f], y[k + LANES] - fb[f + LANES],
                                 y[k + 2 * LANES] - fb[f + 2 * LANES]))  # fmt: skip
        bent, change = times(bend, dw), forcing_change(inputs, i, share, c, w, turning)
        dturning = times(now.inverse, (dy[k] - bent[0] - change[0],
                                       dy[k + LANES] - bent[1] - change[1],
                                       dy[k + 2 * LANES] - bent[2] - change[2]))  # fmt: skip
        x = plus(cross(dturning, p), plus(cross(dw, swept), cross(w, cross(dw, p))))
        at = spot(c)
        S[at] += scale * x[0]
        S[at + LANES] += scale * x[1]
        S[at + 2 * LANES] += scale * x[2]
    return turning


@part
def mounting_of(vectors: Vectors, k: int, sensor: Floats) -> Triple:
    """Return m of sensor k, rad."""
    first = int(vectors.mounting[k])
    if first < 0:
        return (0.0, 0.0, 0.0)
    return (float(sensor[first]), float(sensor[first + 1]), float(sensor[first + 2]))


@part
def mounted(m: Triple, f: Triple) -> Triple:
    """Return M^T f."""
    once = cross(m, f)
    twice = cross(m, once)
    return (f[0] - once[0] + 0.5 * twice[0], f[1] - once[1] + 0.5 * twice[1],
            f[2] - once[2] + 0.5 * twice[2])  # fmt: skip


@part
def mounted_more(m: Triple, axis: int, f: Triple) -> Triple:
    """Return the change of M^T f by a component of m."""
    e = (1.0 * (axis == 0), 1.0 * (axis == 1), 1.0 * (axis == 2))
    first, one, other = cross(e, f), cross(e, cross(m, f)), cross(m, cross(e, f))
    return (0.5 * (one[0] + other[0]) - first[0], 0.5 * (one[1] + other[1]) - first[1],
            0.5 * (one[2] + other[2]) - first[2])  # fmt: skip


@part
def mounted_columns(m: Triple, n: int, S: Floats) -> None:
    """Turn n columns into a sensor's axes."""
    for c in range(n):
        i = spot(c)
        x = mounted(m, (S[i], S[i + LANES], S[i + 2 * LANES]))
        S[i], S[i + LANES], S[i + 2 * LANES] = x[0], x[1], x[2]


@part
def error_columns(
    vectors: Vectors, k: int, terms: Ints, m: Triple, f: Triple, n: int, scale: float, S: Floats
) -> None:
    """Write the columns of all sensors' coefficients behind n others: those of sensor k, else 0."""
    bias, mounting = vectors.bias[k], vectors.mounting[k]
    for j in range(terms.shape[0]):
        i, axis, turn = spot(n + j), terms[j] - bias, terms[j] - mounting
        x = (0.0, 0.0, 0.0)
        if bias >= 0 and 0 <= axis < 3:
            x = (1.0 * (axis == 0), 1.0 * (axis == 1), 1.0 * (axis == 2))
        elif mounting >= 0 and 0 <= turn < 3:
            x = mounted_more(m, turn, f)
        S[i], S[i + LANES], S[i + 2 * LANES] = scale * x[0], scale * x[1], scale * x[2]


@part
def vector_residual(
    vectors: Vectors, row: int, sensor: Floats, said: Triple, scale: float
) -> Triple:
    """Return a row less what is predicted without bias (``said``), in sd."""
    values, bias = vectors.values, vectors.bias[vectors.sensor[row]]
    b = (sensor[bias], sensor[bias + 1], sensor[bias + 2]) if bias >= 0 else (0.0, 0.0, 0.0)
    return (scale * (values[row, 0] - said[0] - b[0]), scale * (values[row, 1] - said[1] - b[1]),
            scale * (values[row, 2] - said[2] - b[2]))  # fmt: skip


@part
def vector_in_body(vectors: Vectors, row: int, q: Floats) -> Triple:
    """Return u = R^T v_N of the sensor of a row."""
    return to_body(q, row_at(vectors.vector_N, vectors.sensor[row]))
