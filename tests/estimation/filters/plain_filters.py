"""The filters once more, in plain NumPy and as a textbook has them: whole matrices, no kernels.

They share with the library what a filter is (`Kind`, `Walks`) and its rows, nothing else: masses
come from their rails, Jacobians from skew matrices. `acceleration` takes complex numbers.
"""

from typing import NamedTuple

import numpy as np

from equipoise.dynamics.rigid_body import KNOWN_D
from equipoise.estimation.filters.model import FIRST_RATE, Kind, Walks
from equipoise.maths.attitude import difference, exponential, multiply, to_matrix
from equipoise.model.testbed import Testbed

PAIRS = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))


class Plain(NamedTuple):
    """What does not change."""

    kind: Kind
    testbed: Testbed
    axes: np.ndarray
    noise: float  # rad or rad/s, one sd of a row
    walks: Walks


class Posterior(NamedTuple):
    q: np.ndarray
    H: np.ndarray
    com: np.ndarray
    J: np.ndarray
    P: np.ndarray


class Here(NamedTuple):
    """The platform at one moment."""

    J: np.ndarray
    mu: np.ndarray
    h: np.ndarray
    tau: np.ndarray


def cross(a):
    return np.array([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])


def full(six):
    xx, yy, zz, xy, xz, yz = six
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def six(J):
    return np.array([J[i, j] for i, j in PAIRS])


def momentum_map(w):
    """W(w), so that J w = W(w) p."""
    return np.column_stack([full(e) @ w for e in np.eye(6)])


def platform_at(testbed, com, J, step, share) -> Here:
    """The platform at a share of a step: known inputs at both ends, seconds."""
    a, b, dt = step
    known, rate = a + share * (b - a), (b - a) / dt
    mu, h = testbed.body.mass * com, known[:3].copy()
    for mass, d, v in zip(testbed.masses, known[KNOWN_D:], rate[KNOWN_D:], strict=True):
        there, home = mass.home + d * mass.axis, mass.home
        J = J + mass.mass * (there @ there * np.eye(3) - np.outer(there, there))
        J = J - mass.mass * (home @ home * np.eye(3) - np.outer(home, home))
        mu = mu + mass.mass * d * mass.axis
        h = h + mass.mass * v * np.cross(home, mass.axis)
    return Here(J, mu, h, known[3:6])


def gravity_of(q, g):
    return to_matrix(q).T @ [0, 0, -g]


def acceleration(here: Here, change, w, g, gyroscopic):
    """J w' = mu x g + tau - w x (J w + h) - h' - J' w."""
    bend, h_dot = change
    swirl = np.cross(w, here.J @ w + here.h) if gyroscopic else 0 * w
    push = np.cross(here.mu, g) + here.tau - swirl - h_dot - bend @ w
    return np.linalg.solve(here.J, push)


def jacobian(plain: Plain, here: Here, change, w, g):
    """F: of attitude, rate, com, inertia and what is left out."""
    kind, invert = plain.kind, np.linalg.inv(here.J)
    o, gyroscopic = (3 if kind.attitude else 0), kind.gyroscopic
    a = acceleration(here, change, w, g, gyroscopic)
    F = np.zeros((o + 13, o + 13))
    swirl = cross(here.J @ w + here.h) - cross(w) @ here.J if gyroscopic else np.zeros((3, 3))
    F[o : o + 3, o : o + 3] = invert @ (swirl - change[0])
    F[o : o + 3, o + 3 : o + 6] = -plain.testbed.body.mass * invert @ cross(g) @ plain.axes
    whole = here
    if not gyroscopic:
        tensor = plain.testbed.body.inertia_P
        whole = here._replace(J=here.J + tensor - np.diag(np.diag(tensor)))
    truly = acceleration(whole, change, w, g, True)
    Y = momentum_map(truly) + cross(w) @ momentum_map(w)
    F[o : o + 3, o + 6 : o + 12] = -np.linalg.inv(whole.J) @ Y
    F[o : o + 3, o + 12] = truly - a
    if o:
        F[:3, :3], F[:3, 3:6] = -cross(w), np.eye(3)
        F[3:6, :3] = invert @ cross(here.mu) @ cross(g)
    return F


def slope(plain, here, y, g):
    w = np.linalg.solve(here.J, y[4:] - here.h)
    turn = 0.5 * multiply(y[:4], np.append(0, w))
    swirl = np.cross(w, y[4:]) if plain.kind.gyroscopic else 0
    return np.append(turn, np.cross(here.mu, g) + here.tau - swirl)


def stride(plain, drive, i, body, y):
    """Runge-Kutta over step i; the state and the platform at both ends."""
    t, a, b, (com, J) = drive.t, drive.known[i], drive.known[i + 1], body
    dt, g = t[i + 1] - t[i], plain.testbed.gravity
    heres = [platform_at(plain.testbed, com, J, (a, b, dt), s) for s in (0, 0.5, 1)]
    observed = [gravity_of(drive.q[i], g), gravity_of(drive.q[i + 1], g)]

    def at(y, share):
        given = (1 - share) * observed[0] + share * observed[1]
        weight = gravity_of(y[:4], g) if plain.kind.attitude else given
        return slope(plain, heres[int(2 * share)], y, weight)

    k1 = at(y, 0)
    k2 = at(y + dt / 2 * k1, 0.5)
    k3 = at(y + dt / 2 * k2, 0.5)
    k4 = at(y + dt * k3, 1)
    y = y + dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
    y[:4] /= np.linalg.norm(y[:4])
    return y, heres[0], heres[2]


def rate(here, H):
    return np.linalg.solve(here.J, H - here.h)


def noise_of(plain, here, dt, n):
    o, Q = (3 if plain.kind.attitude else 0), np.zeros((n, n))
    invert = np.linalg.inv(here.J)
    Q[o : o + 3, o : o + 3] = plain.walks.torque**2 * dt * invert @ invert
    Q[range(o + 3, min(o + 6, n)), range(o + 3, min(o + 6, n))] = plain.walks.com**2 * dt
    return Q


def transition(plain, drive, i, posterior: Posterior):
    """Phi over a step, the state behind it and the platform there."""
    q, H, com, J, P = posterior
    n, dt, g = len(P), drive.t[i + 1] - drive.t[i], plain.testbed.gravity
    y, here, end = stride(plain, drive, i, (com, J), np.append(q, H))
    change = (end.J - here.J) / dt, (end.h - here.h) / dt
    first, last = (q, y[:4]) if plain.kind.attitude else (drive.q[i], drive.q[i + 1])
    F0 = jacobian(plain, here, change, rate(here, H), gravity_of(first, g))[:n, :n]
    F1 = jacobian(plain, end, change, rate(end, y[4:]), gravity_of(last, g))[:n, :n]
    return np.eye(n) + dt / 2 * (F0 + F1) + dt**2 / 2 * F1 @ F0, last, y[4:], end


def extended(plain, drive, i, posterior: Posterior) -> Posterior:
    """One step by the linearised model."""
    phi, q, H, end = transition(plain, drive, i, posterior)
    Q = noise_of(plain, end, drive.t[i + 1] - drive.t[i], len(phi))
    return Posterior(q, H, posterior.com, posterior.J, phi @ posterior.P @ phi.T + Q)


def moved(plain, posterior, x):
    """Parameters and attitude after an error, and the rate's part of it."""
    o = 3 if plain.kind.attitude else 0
    x = np.append(x, np.zeros(o + 13 - len(x)))
    q = multiply(posterior.q, exponential(x[:3])) if o else posterior.q
    com, J = posterior.com + plain.axes @ x[o + 3 : o + 6], posterior.J + full(x[o + 6 : o + 12])
    return q, x[o : o + 3], com, J


def unscented(plain, drive, i, posterior: Posterior) -> Posterior:
    """One step by 2n points."""
    n, dt, g = len(posterior.P), drive.t[i + 1] - drive.t[i], plain.testbed
    a, b = drive.known[i], drive.known[i + 1]
    o = 3 if plain.kind.attitude else 0
    here, end = (platform_at(g, posterior.com, posterior.J, (a, b, dt), s) for s in (0, 1))
    root = np.linalg.cholesky(n * posterior.P)
    points = np.hstack([root, -root]).T
    carried, turned = [], []
    for x in points:
        q, dw, com, J = moved(plain, posterior, x)
        now = platform_at(g, com, J, (a, b, dt), 0)
        H = now.J @ (rate(here, posterior.H) + dw) + now.h
        y, _, then = stride(plain, drive, i, (com, J), np.append(q, H))
        carried.append(rate(then, y[4:]))
        turned.append(y[:4])
    w, e = np.mean(carried, axis=0), points.copy()
    e[:, o : o + 3] = np.array(carried) - w
    q = drive.q[i + 1]
    if o:
        off = difference(np.array(turned), turned[0])
        q = multiply(turned[0], exponential(np.mean(off, axis=0)))
        e[:, :3] = difference(np.array(turned), q)
    P = e.T @ e / (2 * n) + noise_of(plain, end, dt, n)
    return Posterior(q, end.J @ w + end.h, posterior.com, posterior.J, P)


def correct(plain, here, q, observed, posterior: Posterior) -> tuple[Posterior, float]:
    """Joseph's form with the gain of what is not estimated nought."""
    n, o = len(posterior.P), 3 if plain.kind.attitude else 0
    w = rate(here, posterior.H)
    z = difference(q, posterior.q) if o else observed - w
    H, R = np.eye(3, n), plain.noise**2 * np.eye(3)
    S = H @ posterior.P @ H.T + R
    separation = 0 if plain.kind.gyroscopic else np.outer(posterior.P[-1], posterior.P[-1])
    alone = posterior.P - separation  # as if nothing were left out
    K = alone @ H.T @ np.linalg.inv(H @ alone @ H.T + R)
    K[plain.kind.estimated :] = 0
    left = np.eye(n) - K @ H
    P = left @ posterior.P @ left.T + K @ R @ K.T
    q, dw, com, J = moved(plain, posterior, K @ z)
    momentum = (here.J + J - posterior.J) @ (w + dw) + here.h
    return Posterior(q, momentum, com, J, P), float(z @ np.linalg.solve(S, z))


def restart(plain, here, q, posterior: Posterior) -> Posterior:
    P, rows = posterior.P.copy(), 6 if plain.kind.attitude else 3
    P[:rows], P[:, :rows] = 0, 0
    P[:rows, :rows] = np.diag([plain.noise**2] * (rows - 3) + [FIRST_RATE**2] * 3)
    return Posterior(q, here.h, posterior.com, posterior.J, P)


def run(plain: Plain, rows, posterior: Posterior):
    """Estimates after every row."""
    drive, found, here = rows.drive, [], 0
    ahead = unscented if plain.kind.unscented else extended
    for node, fresh, observed in zip(rows.node, rows.fresh, rows.observed, strict=True):
        a, o = drive.known[node], 6 if plain.kind.attitude else 3
        if fresh:
            P = posterior.P.copy()
            P[range(o, o + 3), range(o, o + 3)] += plain.walks.com**2 * (
                drive.t[node] - drive.t[here]
            )
            now = platform_at(plain.testbed, posterior.com, posterior.J, (a, a, 1), 0)
            posterior = restart(plain, now, drive.q[node], posterior._replace(P=P))
            if not plain.kind.attitude:
                posterior, _ = correct(plain, now, drive.q[node], observed, posterior)
        else:
            for i in range(here, node):
                posterior = ahead(plain, drive, i, posterior)
            step = drive.known[node - 1], a, drive.t[node] - drive.t[node - 1]
            now = platform_at(plain.testbed, posterior.com, posterior.J, step, 1)
            posterior, _ = correct(plain, now, drive.q[node], observed, posterior)
        found.append(posterior)
        here = node
    return found


def begun(plain: Plain) -> Posterior:
    """The prior."""
    kind, testbed = plain.kind, plain.testbed
    o, tensor = 3 if kind.attitude else 0, testbed.body.inertia_P
    J = tensor if kind.gyroscopic else np.diag(np.diag(tensor))
    size = np.sqrt(np.diag(tensor))
    P = np.zeros((o + 13, o + 13))
    P[o + 3 : o + 6, o + 3 : o + 6] = plain.axes.T @ np.diag(testbed.com_sd**2) @ plain.axes
    P[o + 6 : o + 12, o + 6 : o + 12] = np.diag(
        (six(np.outer(size, size)) * testbed.inertia_sd) ** 2
    )
    P[o + 12, o + 12] = 1.0
    known = testbed.inertia_sd == 0 and kind.estimated < 12
    n = o + 13 if not kind.gyroscopic else o + 6 if known else o + 12
    return Posterior(np.array([1.0, 0, 0, 0]), np.zeros(3), testbed.body.com, J, P[:n, :n])
