"""The one regressor: the momentum balance about P is linear in the parameters.

    H = J w + h,      H' = -w x H + mu x g_B + sum_k c_k T_k                         [momentum form]
    J w       = W(w) p_J          p_J = J11 J22 J33 J12 J13 J23 (tensor elements)
    mu x g_B  = -[g_B x] mu       mu = m r

T_k are the torques named in ``model.torque_terms``:

    viscous_i    -w_i e_i                       quadratic   -|w| w
    constant_i    e_i                           swirl        u,  u = -g_B/g, the vertical
    sag_ij        m g (C_ij n) x n,  n = g_B/g; C symmetric, and traceless as C + c E gives none
    drift_i       m (t - t0) e_i x g_B          centre of mass moving at a constant rate
    thermal_i     m (T - T0) e_i x g_B          centre of mass moving with a recorded temperature

The batch methods integrate these columns; the propagator's sensitivities are forced by the same.
(da Silva 2021 Eqs. 13-15 with the signs of a laboratory whose Z points up; Lee Eq. 3.)
"""

from equipoise.maths.kernels.compiled import part
from equipoise.model.arrays import Floats, Triple

INERTIA, MOMENT, TORQUE = 0, 6, 9  # first column of each block
VISCOUS, QUADRATIC, CONSTANT, SWIRL, SAG = 0, 3, 4, 7, 8  # within the torques
DRIFT, THERMAL = 13, 16  # by which the centre of mass moves
N_TORQUES = 19
WIDTH = TORQUE + N_TORQUES


@part
def momentum_columns(w: Triple, out: Floats) -> None:
    """Write W(w) into columns 0 to 5."""
    out[0, 0], out[0, 1], out[0, 2], out[0, 3], out[0, 4], out[0, 5] = w[0], 0, 0, w[1], w[2], 0
    out[1, 0], out[1, 1], out[1, 2], out[1, 3], out[1, 4], out[1, 5] = 0, w[1], 0, w[0], 0, w[2]
    out[2, 0], out[2, 1], out[2, 2], out[2, 3], out[2, 4], out[2, 5] = 0, 0, w[2], 0, w[0], w[1]


@part
def cross_columns(g: Triple, weight: float, first: int, out: Floats) -> None:
    """Write weight e_i x g into three columns: -[g x] times the weight."""
    out[0, first], out[0, first + 1], out[0, first + 2] = 0.0, weight * g[2], -weight * g[1]
    out[1, first], out[1, first + 1], out[1, first + 2] = -weight * g[2], 0.0, weight * g[0]
    out[2, first], out[2, first + 1], out[2, first + 2] = weight * g[1], -weight * g[0], 0.0


@part
def cross_into(s: Triple, n: Triple, weight: float, column: int, out: Floats) -> None:
    """Write weight s x n into one column."""
    out[0, column] = weight * (s[1] * n[2] - s[2] * n[1])
    out[1, column] = weight * (s[2] * n[0] - s[0] * n[2])
    out[2, column] = weight * (s[0] * n[1] - s[1] * n[0])


@part
def torque_columns(
    w: Triple, g: Triple, t: float, warmth: float, mass: float, gravity: float, out: Floats
) -> None:
    """Write the columns T_k behind those of J and mu; ``warmth`` is T - T0, K."""
    speed = (w[0] * w[0] + w[1] * w[1] + w[2] * w[2]) ** 0.5
    for i in range(3):
        for j in range(3):
            out[i, TORQUE + VISCOUS + j] = -w[i] if i == j else 0.0
            out[i, TORQUE + CONSTANT + j] = 1.0 if i == j else 0.0
        out[i, TORQUE + QUADRATIC] = -speed * w[i]
        out[i, TORQUE + SWIRL] = -g[i] / gravity
    sag, weight = TORQUE + SAG, mass / gravity
    cross_into((g[0], 0.0, -g[2]), g, weight, sag, out)
    cross_into((0.0, g[1], -g[2]), g, weight, sag + 1, out)
    cross_into((g[1], g[0], 0.0), g, weight, sag + 2, out)
    cross_into((g[2], 0.0, g[0]), g, weight, sag + 3, out)
    cross_into((0.0, g[2], g[1]), g, weight, sag + 4, out)
    cross_columns(g, mass * t, TORQUE + DRIFT, out)
    cross_columns(g, mass * warmth, TORQUE + THERMAL, out)


@part
def regressor(
    w: Triple, g: Triple, t: float, warmth: float, mass: float, gravity: float, torques: bool,
    out: Floats,
) -> None:  # fmt: skip
    """Write [W(w) | -[g_B x] | T], shape (3, 28); t and warmth count from the record's start."""
    momentum_columns(w, out)
    cross_columns(g, 1.0, MOMENT, out)
    if torques:
        torque_columns(w, g, t, warmth, mass, gravity, out)
