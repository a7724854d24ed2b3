"""Correcting a belief by a row, which sees the first three elements of the error state.

    z = w_meas - w_pred,  or  z = log( q_pred^-1 (x) q_meas ),    H = [E 0],    R = sd^2 E
    S = H P H^T + R,   K = P H^T S^-1,  rows behind the told ones nought,   x = K z
    A = P - K H P,     P+ = A + (K R - A H^T) K^T         Joseph's form, for any gain
    q+ = q (x) exp(dth),   w+ = w + dw,   r+ = r + axes dc,   J+ = J + dJ,   H+ = J+(d) w+ + h

(Ivanov section 5 with I11: R is the variance of the whole angle; review Eq. 30.) A row is linear in
the error state, so an unscented filter corrects by the same.
"""

from equipoise.dynamics.rigid_body import Now, rate_of, times
from equipoise.estimation.filters.model import Model
from equipoise.estimation.filters.predict import COM, INERTIA, Work
from equipoise.estimation.tracker_step import invert3
from equipoise.maths.compiled import part
from equipoise.maths.turns import Triple, turn, turned
from equipoise.model.arrays import Floats


@part
def innovation(model: Model, now: Now, belief: Floats, q: Floats, seen: Floats) -> Triple:
    """Return measured minus predicted."""
    if model.attitude:
        return turn(belief, q)
    w = rate_of(now, belief)
    return (seen[0] - w[0], seen[1] - w[1], seen[2] - w[2])


@part
def weigh(told: int, noise: float, z: Triple, P: Floats, work: Work) -> float:
    """Write K and x = K z; return the squared innovation over its covariance."""
    S, V, K, x, n = work.S, work.inverse, work.K, work.x, P.shape[0]
    for r in range(3):
        for c in range(3):
            S[r, c] = P[r, c] + (noise if r == c else 0.0)
    invert3(S, V)
    surprise = 0.0
    for r in range(3):
        for c in range(3):
            surprise += z[r] * V[r, c] * z[c]
    for i in range(n):
        for c in range(3):
            gain = P[i, 0] * V[0, c] + P[i, 1] * V[1, c] + P[i, 2] * V[2, c]
            K[i, c] = gain if i < told else 0.0
        x[i] = K[i, 0] * z[0] + K[i, 1] * z[1] + K[i, 2] * z[2]
    return surprise


@part
def shrink(noise: float, P: Floats, work: Work) -> None:
    """Write P+, symmetric to the last digit."""
    A, K, left, n = work.B, work.K, work.left, P.shape[0]
    for i in range(n):
        for j in range(n):
            A[i, j] = P[i, j] - (K[i, 0] * P[0, j] + K[i, 1] * P[1, j] + K[i, 2] * P[2, j])
    for i in range(n):
        for c in range(3):
            left[i, c] = noise * K[i, c] - A[i, c]
    for i in range(n):
        for j in range(i + 1):
            P[i, j] = P[j, i] = (
                A[i, j] + left[i, 0] * K[j, 0] + left[i, 1] * K[j, 1] + left[i, 2] * K[j, 2]
            )


@part
def apply(model: Model, now: Now, belief: Floats, x: Floats) -> None:
    """Write the belief moved by the error state."""
    n, row = x.shape[0], 3 if model.attitude else 0
    w, a = rate_of(now, belief), now.inertia
    w = (w[0] + x[row], w[1] + x[row + 1], w[2] + x[row + 2])
    if model.attitude:
        belief[0], belief[1], belief[2], belief[3] = turned(belief, x[0], x[1], x[2])
    for k in range(min(3, n - row - 3)):
        for j in range(3):
            belief[COM + j] += model.axes[j, k] * x[row + 3 + k]
    if n >= row + 12:
        for j in range(6):
            belief[INERTIA + j] += x[row + 6 + j]
        k = row + 6
        a = (a[0] + x[k], a[1] + x[k + 1], a[2] + x[k + 2],
             a[3] + x[k + 3], a[4] + x[k + 4], a[5] + x[k + 5])  # fmt: skip
    H = times(a, w)
    for j in range(3):
        belief[4 + j] = H[j] + now.momentum[j]


@part
def correct(
    model: Model, now: Now, q: Floats, seen: Floats, belief: Floats, P: Floats, work: Work
) -> float:
    """Correct belief and covariance by a row; return the squared innovation over its covariance."""
    z = innovation(model, now, belief, q, seen)
    surprise = weigh(model.told, model.noise, z, P, work)
    shrink(model.noise, P, work)
    apply(model, now, belief, work.x)
    return surprise
