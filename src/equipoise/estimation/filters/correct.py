"""Correcting the estimate by a row, which measures the first three elements of the error state.

    z = w_meas - w_pred,  or  z = log( q_pred^-1 (x) q_meas ),    H = [E 0],    R = sd^2 E
    S = H P H^T + R,   K = P H^T S^-1,  rows behind the estimated ones nought,   x = K z
    A = P - K H P,     P+ = A + (K R - A H^T) K^T         Joseph's form, for any gain
    q+ = q (x) exp(dth),   w+ = w + dw,   r+ = r + axes dc,   J+ = J + dJ,   H+ = J+(d) w+ + h

Of the simplified model P = P_0 + b b^T, b = P_s: as s = 0 +- 1 is never corrected, b is what
leaving out does to the estimate. The gain is the published one, from P_0, and b its bias.

(Ivanov section 5 with I11: R is the variance of the whole angle; review Eq. 30.) A row is linear in
the error state, so an unscented filter corrects by the same.
"""

from equipoise.dynamics.rigid_body import Now, rate_of, times
from equipoise.estimation.filters.model import Model
from equipoise.estimation.filters.predict import COM, INERTIA, Work
from equipoise.estimation.tracker.predict_correct import invert3
from equipoise.maths.kernels.compiled import part
from equipoise.maths.turns import turn, turned
from equipoise.model.arrays import Floats, Triple


@part
def innovation(model: Model, now: Now, mean: Floats, q: Floats, observed: Floats) -> Triple:
    """Return measured minus predicted."""
    if model.attitude:
        return turn(mean, q)
    w = rate_of(now, mean)
    return (observed[0] - w[0], observed[1] - w[1], observed[2] - w[2])


@part
def expect(noise: float, P: Floats, aside: int, work: Work) -> None:
    """Write S and its inverse, without what an error set aside adds to P."""
    S = work.S
    for r in range(3):
        for c in range(3):
            S[r, c] = P[r, c] + (noise if r == c else 0.0)
            if aside >= 0:
                S[r, c] -= P[r, aside] * P[c, aside]
    invert3(S, work.inverse)


@part
def surprise_of(z: Triple, work: Work) -> float:
    """Return the squared innovation over its covariance."""
    V, total = work.inverse, 0.0
    for r in range(3):
        for c in range(3):
            total += z[r] * V[r, c] * z[c]
    return total


@part
def weigh(estimated: int, z: Triple, P: Floats, aside: int, work: Work) -> None:
    """Write K and x = K z."""
    V, K, x = work.inverse, work.K, work.x
    for i in range(P.shape[0]):
        a, b, d = P[i, 0], P[i, 1], P[i, 2]
        if aside >= 0:
            s = P[i, aside]
            a, b, d = a - s * P[0, aside], b - s * P[1, aside], d - s * P[2, aside]
        for c in range(3):
            K[i, c] = a * V[0, c] + b * V[1, c] + d * V[2, c] if i < estimated else 0.0
        x[i] = K[i, 0] * z[0] + K[i, 1] * z[1] + K[i, 2] * z[2]


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
def apply(model: Model, now: Now, mean: Floats, x: Floats) -> None:
    """Write the estimate moved by the error state."""
    n, row = x.shape[0], 3 if model.attitude else 0
    w, a = rate_of(now, mean), now.inertia
    w = (w[0] + x[row], w[1] + x[row + 1], w[2] + x[row + 2])
    if model.attitude:
        mean[0], mean[1], mean[2], mean[3] = turned(mean, x[0], x[1], x[2])
    for k in range(min(3, n - row - 3)):
        for j in range(3):
            mean[COM + j] += model.axes[j, k] * x[row + 3 + k]
    if n >= row + 12:
        for j in range(6):
            mean[INERTIA + j] += x[row + 6 + j]
        k = row + 6
        a = (a[0] + x[k], a[1] + x[k + 1], a[2] + x[k + 2],
             a[3] + x[k + 3], a[4] + x[k + 4], a[5] + x[k + 5])  # fmt: skip
    H = times(a, w)
    for j in range(3):
        mean[4 + j] = H[j] + now.momentum[j]


@part
def correct(
    model: Model, now: Now, q: Floats, observed: Floats, mean: Floats, P: Floats, work: Work
) -> float:
    """Correct mean and covariance by a row; return the squared innovation over its covariance."""
    z = innovation(model, now, mean, q, observed)
    expect(model.noise, P, -1, work)
    surprise, aside = surprise_of(z, work), -1
    if not model.gyroscopic:
        aside = P.shape[0] - 1
        expect(model.noise, P, aside, work)
    weigh(model.estimated, z, P, aside, work)
    shrink(model.noise, P, work)
    apply(model, now, mean, work.x)
    return surprise
