"""Momentum build-up as a Kalman filter: the momentum that gravity's torque adds to the platform.

In laboratory axes only external torque changes the platform's momentum, whatever wheels and gyros
do:

    L = R (J w + h),      L' = R ( m (r + s(t)) x g_B + sum_k c_k T_k + tau )

s is the shift by the masses, T_k the columns of sag, drift and drag (``dynamics.regressor``), tau
the play of air and bearing, an Ornstein-Uhlenbeck process in body axes. That is linear in
L, tau, r and c along the attitudes that are measured, so a Kalman filter is the least-squares
answer to all samples at once, and needs no stops, starts or windows:

    x = [ L (3)  tau (3)  b (3)  r (3)  c (k) ],      z = R (J (w + b) + h) = L + R J b + noise

b is the remaining bias of the gyro. J enters as J w alone, and is known to ``inertia_sd``: a sample
is weighted as if that error lasted for SAME_TURN, so that mainly samples at rest count. Gravity's
effect during a turn is not lost, since L carries it to the next rest. Samples during mass travel
are rejected: the momentum of the masses is not known.

A move leaves an error: the accuracy of each mass that may have moved, a coarse one from where finer
ones do not go at once (``mass_allocation.least_changes``). The sd of tau and the walk of r are the
testbed's; r walks less where drift is a term. c are constants.

(Wheel momentum build-up: Hatcher and Young 1968 with wheels for jets.)

Without tilt, r along gravity's mean direction is unobservable. A tau that keeps its sign for longer
than the record is taken for r.
"""

from typing import NamedTuple

import numpy as np

from equipoise.actuators.mass_allocation import least_changes, rails_of
from equipoise.control.law import Sample
from equipoise.dynamics.regressor import TORQUE, WIDTH, torque_columns
from equipoise.dynamics.sag_trim import sag_matrix
from equipoise.maths.attitude import to_matrix
from equipoise.maths.kernels.compiled import kernel
from equipoise.maths.linalg import cross, skew
from equipoise.model.arrays import Floats, Matrix3, Square, Vector3
from equipoise.model.testbed import AIR_TIME, SlidingMass, Testbed
from equipoise.model.torque_terms import GROUPS, TERMS, typical_sizes
from equipoise.model.units import MINUTE

L, PLAY, BIAS, COM, TERM = 0, 3, 6, 9, 12  # first row of each part of x

BIAS_SD = 1e-4  # rad/s, chosen: a camera of 0.2 deg and 5 Hz leaves so much after ten seconds
LEFT = 0.2  # of that random walk, chosen: the rest where a constant drift is a term of its own
SAME_TURN = 10.0  # s, chosen: as long as a turn lasts, in which an error of J w keeps its sign
STANDS = 1e-10  # m, chosen: less is no travel


class Book(NamedTuple):
    """The constants of the filter, and its priors."""

    mass: float  # kg
    inertia_P: Matrix3
    inertia_sd: float  # -, relative
    gyro_sd: float  # rad/s sqrt(s): one sd of a mean over a second
    momentum_sd: float  # N m s, of one sample
    creep: float  # m/sqrt(s), by which r walks
    play: float  # N m, one sd of the torque of air and bearing
    terms: tuple[str, ...]
    columns: tuple[int, ...]  # of the regressor, of these terms
    masses: tuple[SlidingMass, ...]
    least: Floats  # (k,) m, changes of the shift from which on each may move


class Ledger(NamedTuple):
    """The estimate of the filter, and the last sample."""

    x: Floats  # (12 + k,)
    P: Square
    rows: Floats  # (3, 4 + k): R applied to the columns of r and c, and to the weight of s, last
    R: Matrix3
    shift: Vector3  # m, by the masses, at the last sample
    stood: Vector3  # m, where the masses stood last
    t: float  # s, of the last sample
    begin: float  # s, of the first


def book_of(testbed: Testbed) -> Book:
    """Return the constants for a testbed; it must have a gyro."""
    assert testbed.gyro is not None
    terms = testbed.disturbances
    quiet = [w.inertia * w.speed_noise for w in testbed.wheels]
    quiet += [g.momentum * g.angle_noise for g in testbed.cmgs]
    return Book(
        testbed.body.mass,
        testbed.body.inertia_P,
        testbed.inertia_sd,
        testbed.gyro.noise / testbed.gyro.rate**0.5,
        max([*quiet, 1e-9]),
        testbed.com_walk
        / MINUTE**0.5
        * (LEFT if any(term.startswith("drift") for term in terms) else 1.0),
        testbed.air_torque,
        terms,
        tuple(TORQUE + TERMS.index(term) for term in terms),
        testbed.masses,
        least_changes(rails_of(testbed.masses, testbed.body.mass)),
    )


@kernel
def torques_at(w: Vector3, g: Vector3, t: float, mass: float) -> Floats:
    """Return the regressor's columns, those of torques filled, (3, 28): as warm as at first."""
    out = np.zeros((3, WIDTH))
    size = (g[0] ** 2 + g[1] ** 2 + g[2] ** 2) ** 0.5
    torque_columns((w[0], w[1], w[2]), (g[0], g[1], g[2]), t, 0.0, mass, size, out)
    return out


def rows_at(sample: Sample, book: Book, begin: float) -> Floats:
    """Return the torque (N m, laboratory axes) of r, of each c, and of the weight at s."""
    g, w = sample.gravity, sample.rate
    regress = torques_at(w, g, sample.t - begin, book.mass)
    weight = -book.mass * skew(g)  # its row i is -m e_i x g
    known = book.mass * cross(sample.shift, g)
    columns = np.column_stack([-weight.T, regress[:, book.columns], known])
    return to_matrix(sample.q) @ columns


def opened(testbed: Testbed, book: Book, sample: Sample) -> Ledger:
    """Return the estimate at the first sample, with the testbed's nominal values as prior."""
    priors = typical_sizes(book.terms)
    sd = np.concatenate(
        [np.full(3, 1.0), np.full(3, book.play), np.full(3, BIAS_SD), testbed.com_sd, priors]
    )
    x = np.zeros(len(sd))
    R = to_matrix(sample.q)
    x[:3] = R @ (book.inertia_P @ sample.rate + sample.momentum)
    x[COM:TERM] = testbed.body.com
    return Ledger(x, np.diag(sd**2), rows_at(sample, book, sample.t), R, sample.shift, sample.shift,
                  sample.t, sample.t)  # fmt: skip


def stop_variance(change: Vector3, book: Book) -> Vector3:
    """Return the variance (m^2) that a change of the shift (m) leaves, per axis."""
    size, variance = float(np.linalg.norm(change)), np.zeros(3)
    for mass, least in zip(book.masses, book.least, strict=True):
        if size > least:
            variance += (mass.mass * mass.accuracy / book.mass * mass.axis) ** 2
    return variance


def predicted(ledger: Ledger, sample: Sample, book: Book) -> Ledger:
    """Return the estimate propagated to a sample."""
    dt = sample.t - ledger.t
    rows, R = rows_at(sample, book, ledger.begin), to_matrix(sample.q)
    mean = 0.5 * dt * (ledger.rows + rows)
    stay = float(np.exp(-dt / AIR_TIME))
    F = np.eye(len(ledger.x))
    F[:3, PLAY:BIAS] = 0.5 * dt * (ledger.R + stay * R)
    F[PLAY:BIAS, PLAY:BIAS] *= stay
    F[:3, COM:] = mean[:, :-1]
    x = F @ ledger.x
    x[:3] += mean[:, -1]
    P = F @ ledger.P @ F.T
    play = np.arange(PLAY, BIAS)
    P[play, play] += book.play**2 * (1 - stay**2)
    com = np.arange(COM, TERM)
    P[com, com] += book.creep**2 * dt
    return ledger._replace(x=x, P=P, rows=rows, R=R, shift=sample.shift, t=sample.t)


def arrived(ledger: Ledger, book: Book) -> Ledger:
    """Return the estimate with the error of a move that has ended, if one has."""
    change: Vector3 = ledger.shift - ledger.stood
    if float(np.linalg.norm(change)) <= STANDS:
        return ledger
    P, com = ledger.P.copy(), np.arange(COM, TERM)
    P[com, com] += stop_variance(change, book)
    return ledger._replace(P=P, stood=ledger.shift)


def noise_of(sample: Sample, R: Matrix3, dt: float, book: Book) -> Matrix3:
    """Return the covariance of z, (N m s)^2."""
    RJ = R @ book.inertia_P
    white = book.gyro_sd**2 / dt * RJ @ RJ.T + 2 * book.momentum_sd**2 * np.eye(3)
    wrong = book.inertia_sd * float(np.linalg.norm(book.inertia_P @ sample.rate))
    return white + wrong**2 * SAME_TURN / dt * np.eye(3)


def corrected(ledger: Ledger, sample: Sample, dt: float, book: Book) -> Ledger:
    """Return the estimate corrected with a sample's momentum."""
    RJ = ledger.R @ book.inertia_P
    H = np.zeros((3, len(ledger.x)))
    H[:, :3], H[:, BIAS:COM] = np.eye(3), RJ
    PHt = ledger.P @ H.T
    S = H @ PHt + noise_of(sample, ledger.R, dt, book)
    K = np.linalg.solve(S, PHt.T).T
    z = RJ @ sample.rate + ledger.R @ sample.momentum
    P = ledger.P - K @ PHt.T
    return ledger._replace(x=ledger.x + K @ (z - H @ ledger.x), P=0.5 * (P + P.T))


def entered(ledger: Ledger, sample: Sample, book: Book) -> Ledger:
    """Return the estimate after one more sample."""
    dt = sample.t - ledger.t
    if dt <= 0:
        return ledger
    still = float(np.linalg.norm(sample.shift - ledger.shift)) <= STANDS
    ahead = predicted(ledger, sample, book)
    return corrected(arrived(ahead, book), sample, dt, book) if still else ahead


def com_map(ledger: Ledger, book: Book, ahead: float = 0.0) -> Floats:
    """Return the map (3, n) from x to the centre of mass, masses at home, ``ahead`` (s) of now."""
    G = np.zeros((3, len(ledger.x)))
    G[:, COM:TERM] = np.eye(3)
    for axis, name in enumerate(GROUPS["drift"]):
        if name in book.terms:
            G[axis, TERM + book.terms.index(name)] = ledger.t - ledger.begin + ahead
    return G


def drift_of(ledger: Ledger, book: Book) -> Vector3:
    """Return the drift of the centre of mass, m/s."""
    return (com_map(ledger, book, 1.0) - com_map(ledger, book)) @ ledger.x


def sag_of(ledger: Ledger, book: Book) -> Matrix3:
    """Return the matrix of sag, m."""
    return sag_matrix(dict(zip(book.terms, ledger.x[TERM:], strict=True)))
