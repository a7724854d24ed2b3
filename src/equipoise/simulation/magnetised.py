"""The motion of a platform whose coils are on: their torque turns with the attitude.

tau = m x R(q)^T B_N is laid over the nodes from the attitude and rate at the beginning of each
short piece; what the rate changes within a piece, 0.05 s, turns the torque by less than 1e-5 rad.
"""

from collections.abc import Sequence

import numpy as np

from equipoise.dynamics.modal_motion import Modes
from equipoise.dynamics.rigid_body import KNOWN_D, ROWS, Body
from equipoise.maths.attitude import exponential, multiply, to_matrix
from equipoise.maths.linalg import unpack_symmetric
from equipoise.model.arrays import Floats, Quaternion, Series1, Series3, Vector3
from equipoise.model.defects import ComStep, Contact
from equipoise.simulation.clock import tick
from equipoise.simulation.events import run_through
from equipoise.simulation.motion import Path, in_pieces
from equipoise.simulation.stop import Stop

PIECE = 0.05  # s, chosen: see above


def magnetic_torque(
    dipole: Series3, field_N: Series3, t: Series1, q: Quaternion, rate: Vector3
) -> Series3:
    """Return m x B (n, 3) N m at times (s), attitude and rate being given at the first."""
    turned = multiply(q, exponential((t - t[0])[:, None] * rate))
    field_B: Series3 = np.einsum("ni,nij->nj", field_N, to_matrix(turned))
    return np.cross(dipole, field_B)


def rate_at(body: Body, maps: Floats, y: Floats, known: Floats) -> Vector3:
    """Return J(d)^-1 (H - h), rad/s, without the momentum of modes and of masses on their way."""
    d = known[KNOWN_D:]
    inertia = np.array(body.inertia) + d @ maps[:, 3:9] + d**2 @ maps[:, 9:15]
    rate: Vector3 = np.linalg.inv(unpack_symmetric(inertia)) @ (y[4:ROWS] - known[:3])
    return rate


def run_magnetised(
    body: Body,
    maps: Floats,
    y: Floats,
    t: Series1,
    known: Floats,
    stop: Stop,
    contacts: Sequence[Contact],
    steps: Sequence[ComStep],
    dipole: Series3,
    field_N: Series3,
    modes: Modes | None = None,
) -> Path:
    """Return the motion as ``events.run_through`` does, with dipoles (n, 3) in fields (n, 3) T."""
    whole = np.flatnonzero(tick(t - PIECE * np.round(t / PIECE)) == 0)
    edges = np.unique(np.concatenate([[0], whole, [len(t) - 1]]))

    def follow(here: Floats, piece: slice) -> Path:
        torqued = known[piece].copy()
        rate = rate_at(body, maps, here, torqued[0])
        torqued[:, 3:6] += magnetic_torque(dipole[piece], field_N[piece], t[piece], here[:4], rate)
        return run_through(body, maps, here, t[piece], torqued, stop, contacts, steps, modes)

    return in_pieces(edges.tolist(), y, follow)
