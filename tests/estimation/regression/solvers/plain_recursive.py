"""Recursive least squares with vector rows as one would write it down, for tests and benchmarks."""

import numpy as np


def plain_step(x, P, H, b, R, lam=1.0):  # noqa: PLR0913, PLR0917 - the letters of the equations
    """Return x and P after one row: K = P H^T (lam R + H P H^T)^-1 and so on."""
    K = P @ H.T @ np.linalg.inv(lam * R + H @ P @ H.T)
    P = (P - K @ H @ P) / lam
    return x + K @ (b - H @ x), 0.5 * (P + P.T)


def plain_rls(recursion, rows):
    """Return the last x and P, free constants restarted in each piece; no guards."""
    n, m, c = rows.A.shape
    free = m if rows.piece is not None else 0
    piece = np.zeros(n, int) if rows.piece is None else rows.piece
    x = np.append(recursion.start, np.zeros(free))
    P = np.diag(np.append(recursion.sd, np.full(free, recursion.free)) ** 2)
    R, constants = np.diag(recursion.noise**2), np.eye(m)[:, :free]
    for k in range(n):
        lam = 1.0 if k == 0 else np.exp((rows.t[k - 1] - rows.t[k]) / recursion.forget)
        if k and piece[k] != piece[k - 1]:
            x[c:], P[c:], P[:, c:] = 0.0, 0.0, 0.0
            P[c:, c:] = lam * recursion.free**2 * np.eye(free)  # divided by lam in the step
        H = np.hstack([rows.A[k], constants])
        x, P = plain_step(x, P, H, rows.b[k], R, lam)
    return x, P
