"""What a camera says of an attitude, compiled.

    q_said = exp( phi ) (x) q( t - delay ) (x) exp( eta(psi) ),      phi = [plumb_x, plumb_y, 0]
    eta(psi) = sum_k ( c_k cos k psi + s_k sin k psi ),   k = 2, 3

``plumb``, in laboratory axes: the camera's vertical is not that of gravity. The harmonics, in body
axes: an error that depends on the heading psi of the platform, as cameras stand around it and see
its markers from one side; psi is that of a body axis f that is level when the platform is. A first
harmonic would be no more than a wrong mounting of the markers, which is another choice of body
axes; in laboratory axes the errors of one order k would be of orders k - 1 and k + 1.

A small change dth of the attitude (body axes), dphi and deta appear as

    x - eta x x,   x = dth + R^T ( dphi - phi x dphi / 2 )    and    deta - eta x deta / 2
    d psi = (R^T da).dth,   da = ( -p_z p_x / h^2, -p_z p_y / h^2, 1 ),   p = R f,
    h^2 = p_x^2 + p_y^2
"""

from typing import NamedTuple

from equipoise.maths.kernels.compiled import kernel, part
from equipoise.maths.turns import to_body, to_laboratory, turned
from equipoise.model.arrays import Floats, Triple

# Where a list of coefficients keeps each; those behind the clock are of sensors of vectors.
PLUMB, HEADING, DELAY, GYRO, CLOCK = 0, 2, 14, 15, 24
N_SENSOR = 40


class Seeing(NamedTuple):
    """What the camera adds to an attitude."""

    cos: Triple  # cos k psi for k = 1, 2, 3
    sin: Triple
    turn: Triple  # eta, body axes, rad
    by_heading: Triple  # d eta / d psi
    heading_by_turn: Triple  # da


@part
def heading(q: Floats, forward: Triple) -> tuple[float, float, Triple]:
    """Return cos psi, sin psi, and the derivative da of psi by a turn in laboratory axes."""
    x, y, z = to_laboratory(q, forward)
    square = x * x + y * y + 1e-300
    level = square**0.5
    return x / level, y / level, (-z * x / square, -z * y / square, 1.0)


@part
def seeing(q: Floats, forward: Triple, sensor: Floats) -> Seeing:
    """Return eta and its derivatives at an attitude."""
    c1, s1, da = heading(q, forward)
    c2, s2 = c1 * c1 - s1 * s1, 2.0 * c1 * s1
    c3, s3 = c2 * c1 - s2 * s1, s2 * c1 + c2 * s1
    x, y, z = 0.0, 0.0, 0.0
    u, v, w = 0.0, 0.0, 0.0
    for k, c, s in ((2, c2, s2), (3, c3, s3)):
        at = HEADING + 6 * (k - 2)
        x += c * sensor[at] + s * sensor[at + 3]
        y += c * sensor[at + 1] + s * sensor[at + 4]
        z += c * sensor[at + 2] + s * sensor[at + 5]
        u += k * (c * sensor[at + 3] - s * sensor[at])
        v += k * (c * sensor[at + 4] - s * sensor[at + 1])
        w += k * (c * sensor[at + 5] - s * sensor[at + 2])
    return Seeing((c1, c2, c3), (s1, s2, s3), (x, y, z), (u, v, w), da)


@part
def less_cross(x: Triple, turn: Triple, share: float) -> Triple:
    """Return x - share turn x x: a small rotation behind a turn, in the axes before it."""
    return (x[0] - share * (turn[1] * x[2] - turn[2] * x[1]),
            x[1] - share * (turn[2] * x[0] - turn[0] * x[2]),
            x[2] - share * (turn[0] * x[1] - turn[1] * x[0]))  # fmt: skip


@part
def column(term: int, q: Floats, sensor: Floats, now: Seeing) -> Triple:
    """Return what one unit of plumb or of a harmonic does to the attitude said, body axes."""
    if term < HEADING:
        phi = (sensor[PLUMB], sensor[PLUMB + 1], 0.0)
        x = less_cross((1.0 * (term == 0), 1.0 * (term == 1), 0.0), phi, 0.5)
        return less_cross(to_body(q, x), now.turn, 1.0)
    order, place = (term - HEADING) // 6 + 1, (term - HEADING) % 6
    size, axis = (now.cos[order] if place < 3 else now.sin[order]), place % 3
    x = (size * (axis == 0), size * (axis == 1), size * (axis == 2))
    return less_cross(x, now.turn, 0.5)


@part
def said(q: Floats, sensor: Floats, eta: Triple) -> tuple[float, float, float, float]:
    """Return exp(phi) (x) q (x) exp(eta)."""
    x = to_body(q, (sensor[PLUMB], sensor[PLUMB + 1], 0.0))
    leaning = turned(q, x[0], x[1], x[2])
    return turned(leaning, eta[0], eta[1], eta[2])  # pyright: ignore[reportArgumentType]


@kernel
def said_along(q: Floats, forward: Triple, sensor: Floats, out: Floats) -> None:
    """Write what the camera says of attitudes (n, 4) at the moments of its rows."""
    for i in range(q.shape[0]):
        now = seeing(q[i], forward, sensor)
        out[i, 0], out[i, 1], out[i, 2], out[i, 3] = said(q[i], sensor, now.turn)
