"""Unit quaternions, scalar first, that turn body components into laboratory components.

Every function takes one quaternion or a series of them along the first axis.
"""

import numpy as np

from equipoise.model.arrays import Bools, Floats, Quaternion, Series4, Vector3


def normalise(q: Floats) -> Floats:
    """Return q / |q|."""
    return q / np.linalg.norm(q, axis=-1, keepdims=True)


def conjugate(q: Floats) -> Floats:
    """Return the inverse rotation of a unit quaternion."""
    return q * np.array([1.0, -1.0, -1.0, -1.0])


def multiply(p: Floats, q: Floats) -> Floats:
    """Return p (x) q: first q, then p."""
    # By components: a general cross product takes ten times as long for one row.
    pw, px, py, pz = p[..., 0], p[..., 1], p[..., 2], p[..., 3]
    qw, qx, qy, qz = q[..., 0], q[..., 1], q[..., 2], q[..., 3]
    return np.stack(
        [
            pw * qw - (px * qx + py * qy + pz * qz),
            pw * qx + qw * px + (py * qz - pz * qy),
            pw * qy + qw * py + (pz * qx - px * qz),
            pw * qz + qw * pz + (px * qy - py * qx),
        ],
        axis=-1,
    )


def to_matrix(q: Floats) -> Floats:
    """Return R(q), so that v_N = R v_B."""
    w, x, y, z = q[..., 0], q[..., 1], q[..., 2], q[..., 3]
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    turn = np.array(rows)
    return turn.transpose(*range(2, turn.ndim), 0, 1)


def from_matrix(turn: Floats) -> Floats:
    """Return the unit quaternion of a rotation matrix, nearest to one that is none exactly.

    It is the eigenvector, for the greatest eigenvalue, of Bar-Itzhack's symmetric 4 x 4 matrix.
    """
    twice = turn - turn.swapaxes(-1, -2)
    skew = np.stack([twice[..., 2, 1], twice[..., 0, 2], twice[..., 1, 0]], axis=-1)
    trace = np.trace(turn, axis1=-2, axis2=-1)[..., None, None]
    square = np.empty((*turn.shape[:-2], 4, 4))
    square[..., :1, :1] = trace
    square[..., 0, 1:] = square[..., 1:, 0] = skew
    square[..., 1:, 1:] = turn + turn.swapaxes(-1, -2) - trace * np.eye(3)
    return np.linalg.eigh(square)[1][..., -1]


def exponential(vector: Floats) -> Floats:
    """Return the quaternion of a rotation vector (rad)."""
    angle = np.linalg.norm(vector, axis=-1, keepdims=True)
    half_sine = 0.5 * np.sinc(angle / (2 * np.pi))
    return np.concatenate([np.cos(angle / 2), half_sine * vector], axis=-1)


def turned_on(q: Floats, rate: Floats, seconds: float) -> Floats:
    """Return the attitude (body to laboratory) after so long at a rate (rad/s, body axes)."""
    return multiply(q, exponential(seconds * rate))


def logarithm(q: Floats) -> Floats:
    """Return the rotation vector (rad) of the shorter way round."""
    q = np.where(q[..., :1] < 0, -q, q)
    sine = np.linalg.norm(q[..., 1:], axis=-1, keepdims=True)
    angle = 2 * np.arctan2(sine, q[..., :1])
    small = sine < 1e-12
    return np.where(small, 2.0, angle / np.where(small, 1.0, sine)) * q[..., 1:]


def difference(q: Floats, reference: Floats) -> Floats:
    """Return the rotation vector, in body axes, that leads from ``reference`` to ``q``."""
    return logarithm(multiply(conjugate(reference), q))


def sign_changes(q: Series4) -> Bools:
    """Say of each attitude but the first whether its sign is not that of the one before."""
    return np.einsum("ij,ij->i", q[1:], q[:-1]) < 0


def continuous(q: Series4) -> Series4:
    """Return the same attitudes with signs chosen so that neighbours agree."""
    flips = sign_changes(q)
    signs = np.where(np.cumsum(flips) % 2 == 1, -1.0, 1.0)
    return q * np.concatenate([[1.0], signs])[:, None]


def from_euler321(roll: Floats, pitch: Floats, yaw: Floats) -> Floats:
    """Return the attitude reached by yaw about z, then pitch about y, then roll about x (rad)."""
    roll, pitch, yaw = np.broadcast_arrays(roll, pitch, yaw)
    zero = np.zeros_like(roll)

    def turn(x: Floats, y: Floats, z: Floats) -> Floats:
        return exponential(np.stack([x, y, z], axis=-1))

    pitched = multiply(turn(zero, pitch, zero), turn(roll, zero, zero))
    return multiply(turn(zero, zero, yaw), pitched)


def to_euler321(q: Floats) -> tuple[Floats, Floats, Floats]:
    """Return roll, pitch and yaw (rad), the way back from ``from_euler321``; pitch within 90 deg.

    At a pitch of 90 deg only the difference of roll and yaw is defined: any two that have it come
    out.
    """
    w, x, y, z = np.moveaxis(q, -1, 0)
    roll = np.arctan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))
    pitch = np.arcsin(np.clip(2 * (w * y - x * z), -1.0, 1.0))
    yaw = np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))
    return roll, pitch, yaw


def level(up: Vector3) -> Quaternion:
    """Return an attitude with the body axis ``up`` along the laboratory's vertical."""
    axis = np.cross(up, [0.0, 0.0, 1.0])
    return normalise(np.concatenate([[1.0 + up[2]], axis])) if up[2] > -0.999 else np.eye(4)[1]


def leaning(up: Vector3, low_side: Vector3, angle: float) -> Quaternion:
    """Return ``level`` tilted by an angle (rad) so that the body's direction ``low_side`` sinks.

    Both are unit vectors at right angles. A turn about n moves d by n x d, which is -up for
    n = up x d.
    """
    return multiply(level(up), exponential(angle * np.cross(up, low_side)))


def tilt(q: Floats, up: Floats) -> Floats:
    """Return the angle (rad) between the body axis ``up`` and the laboratory's vertical."""
    return np.arccos(np.clip((to_matrix(q) @ up)[..., 2], -1.0, 1.0))


def tilted_at_most(q: Quaternion, up: Vector3, limit: float) -> Quaternion:
    """Return an attitude turned back about its level axis of tilt to a limit (rad), if beyond."""
    excess = float(tilt(q, up)) - limit
    if excess <= 0:
        return q
    across = np.cross(to_matrix(q)[2], up)
    return multiply(q, exponential(-excess * across / np.linalg.norm(across)))


def euler321_sd(pitch: Floats, sd: float) -> tuple[Floats, Floats, Floats]:
    """Return the sd of roll, pitch and yaw (rad) of an attitude with one ``sd`` about each axis.

    With d the error about the body axes, of first order (``from_euler321`` differentiated):

        d roll  = dx + (dy sin roll + dz cos roll) tan pitch      sd / cos pitch
        d pitch = dy cos roll - dz sin roll                       sd
        d yaw   = (dy sin roll + dz cos roll) / cos pitch         sd / cos pitch
    """
    slanted = sd / np.cos(pitch)
    return slanted, np.full_like(slanted, sd), slanted
