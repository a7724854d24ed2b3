"""Momentum integral: angular momentum balanced between the start and every sample.

The rows are linear in inertia, first moment and torque coefficients.

Body axes (da Silva 2021 Eqs. 16-21 with the t0 terms restored; Kim and Agrawal 2009; Lee Eq. 6):

    W(w) p + int w x W(w) p - int G mu - int T c - H0 = -k - int w x k + int dmu x g_B + int tau

Laboratory axes, where no gyroscopic term is left:

    R W(w) p - int R G mu - int R T c - H0_N = -R k + int R (dmu x g_B + tau)

k = dJ(d) w + h: momentum that is known once w is (masses off home, masses travelling, wheels).
H0 is three free constants: taking the first noisy rate for it would cost a factor 13 to 22 in sd.

Assumes rates good enough to stand in the regressor: their noise biases J towards zero, and the
stated sd does not know of that. Cannot see the common scale of J and mu without a known change,
nor J_33 and the products without spin about more than one axis.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np
from scipy.integrate import cumulative_simpson

from equipoise.actuators.sliding_masses import inertia_shift, mass_maps
from equipoise.dynamics.regressor import MOMENT, TORQUE, WIDTH, regressor
from equipoise.dynamics.timeline import straight_lines
from equipoise.estimation.unknowns import Layout
from equipoise.maths.attitude import to_matrix
from equipoise.maths.compiled import kernel
from equipoise.maths.linalg import unpack_symmetric
from equipoise.model.arrays import Floats, Series1, Series3, Series4
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import Testbed

Axes = Literal["body", "laboratory"]


@dataclass(frozen=True, slots=True, eq=False)
class Balance:
    """Rows of the linear problem: regressor @ [J6, mu3, torques, H0] = known."""

    regressor: Floats  # (3 n, 12 + terms)
    known: Floats  # (3 n,)


@kernel
def regressor_rows(
    w: Floats, g: Floats, t: Floats, mass: float, gravity: float, out: Floats
) -> None:
    """Write the regressor of every sample, shape (n, 3, 25)."""
    for i in range(t.shape[0]):
        wi, gi = (w[i, 0], w[i, 1], w[i, 2]), (g[i, 0], g[i, 1], g[i, 2])
        regressor(wi, gi, t[i] - t[0], mass, gravity, True, out[i])


def integral(t: Series1, rate: Floats) -> Floats:
    """Return the running integral of a series along its first axis."""
    if len(t) < 3:
        return np.concatenate([[0 * rate[0]], np.cumsum(np.diff(t) * rate[:-1].T, axis=-1).T])
    return np.asarray(cumulative_simpson(rate, x=t, axis=0, initial=np.zeros_like(rate[:1])))


def known_momentum(
    recording: Recording, testbed: Testbed, t: Series1, w: Series3
) -> tuple[Series3, Series3]:
    """Return k (N m s) and the known change of first moment dmu (kg m) at times t."""
    maps = mass_maps(testbed.masses)
    d = straight_lines(recording.masses, t, len(testbed.masses))
    travel = Samples(t, np.gradient(d, t, axis=0)) if len(t) > 1 else Samples(t, 0 * d)
    bend = unpack_symmetric(inertia_shift(maps, d).T)  # (3, 3, n)
    k = np.einsum("ijn,nj->ni", bend, w) + travel.values @ maps.momentum
    return k + straight_lines(recording.momentum, t, 3), d @ maps.first_moment


def balance(
    recording: Recording,
    testbed: Testbed,
    layout: Layout,
    t: Series1,
    q: Series4,
    w: Series3,
    axes: Axes,
) -> Balance:
    """Return the rows for attitudes q and rates w (rad/s) at times t (s)."""
    R = to_matrix(q)
    g = -testbed.gravity * R[:, 2, :]
    full = np.zeros((len(t), 3, WIDTH))
    regressor_rows(w, np.ascontiguousarray(g), t, testbed.body.mass, testbed.gravity, full)
    momentum = full[:, :, :MOMENT]
    columns = [*range(MOMENT, TORQUE), *(TORQUE + k for k in layout.torque_index)]
    torque = full[:, :, columns]
    k, dmu = known_momentum(recording, testbed, t, w)
    push = np.cross(dmu, g) + straight_lines(recording.torque, t, 3)
    if axes == "laboratory":
        momentum, torque = R @ momentum, R @ torque
        k, push = np.einsum("nij,nj->ni", R, k), np.einsum("nij,nj->ni", R, push)
        left, right = momentum, -k + integral(t, push)
    else:
        spun = np.cross(w[:, :, None], momentum, axis=1)
        left, right = momentum + integral(t, spun), -k + integral(t, push - np.cross(w, k))
    constants = -np.broadcast_to(np.eye(3), (len(t), 3, 3))
    rows = np.concatenate([left, -integral(t, torque), constants], axis=2)
    return Balance(rows.reshape(3 * len(t), -1), right.reshape(-1))
