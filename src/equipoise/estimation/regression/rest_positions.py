"""Equilibrium points: at rest the centre of mass hangs under the centre of rotation.

    (r + dr_i) x n_i = 0,   n_i = g_B / g at rest (or the mean of a swing)
    [n_i x] r = -[n_i x] dr_i       stacked over two or more stops with non-parallel shifts dr_i

(Inertia is not needed.) Each stop of the masses in the record gives one n_i, the mean of
gravity's direction over the later half of the stop, with an sd s_i of its direction that knows how
long rows hang together (``long_run``). The linear rows only begin: their noise is |r + dr_i| s_i,
which r itself scales. Minimised is

    sum_i |u_i - n_i|^2 / s_i^2,        u_i = (r + dr_i) / |r + dr_i|
    du_i/dr = (E - u_i u_i^T) / |r + dr_i|

Cannot see anything from one stop but the direction of r; is no use near balance, where a swing
takes minutes and its mean is not a rest: the outcome says so. Directions that are known roughly
agree with a centre of mass at any distance, and the minimum runs away: where the largest sd of r
is longer than the longest arm |r + dr_i|, r is not reported.
"""

from typing import NamedTuple

import numpy as np

from equipoise.actuators.sliding_masses import com_shift, mass_maps
from equipoise.actuators.stops import travels
from equipoise.dynamics.timeline import straight_lines
from equipoise.estimation.method_contract import Options, origin_of
from equipoise.maths.attitude import to_matrix
from equipoise.maths.chi_square import chi_square_limit
from equipoise.maths.levenberg_marquardt import FIRST, judge, promise
from equipoise.maths.linalg import inverse_spd
from equipoise.maths.sampled.long_run import long_run_covariance, memory
from equipoise.maths.scaled_solve import scaled_solve
from equipoise.model.arrays import Floats, Matrix3, Series1, Vector3
from equipoise.model.estimate import COM, Estimate, Parameter
from equipoise.model.outcome import Outcome, outcome
from equipoise.model.reasons.data_reasons import Unobservable
from equipoise.model.reasons.estimate_reasons import EstimateReason as Why
from equipoise.model.reasons.reason import Reason
from equipoise.model.recording import Recording, arranged
from equipoise.model.testbed import Testbed
from equipoise.sensors.timing import measured_at

METHOD = "equilibrium"
FEWEST = 10  # rows in a stop
SETTLING = 0.5  # chosen: of a stop, until the platform rests
SWING = np.radians(0.5)  # chosen: a platform that swings more does not rest
SURE = 0.999  # of a chi-square
SHORTEST = 1e-9  # m, chosen: no lever arm
MOST, LEAST = 100, 1e-10  # chosen: steps of a search; of twice the cost, that one may promise
WEAKEST = 1e-4  # smallest usable eigenvalue of the mean of [n x]^T [n x], two being near 1


class Rest(NamedTuple):
    """What one stop of the masses shows."""

    down: Vector3  # unit vector of gravity, body axes
    sd: float  # rad, of that direction
    shift: Vector3  # m, dr
    swing: float  # rad rms of the rows about it, an axis


def quiet_spans(recording: Recording, testbed: Testbed) -> list[tuple[float, float]]:
    """Return the spans (s) in which no mass travelled."""
    (quiet, end), track = recording.span, recording.masses
    moves = list[tuple[float, float]]()
    for i, mass in enumerate(testbed.masses if track is not None else ()):
        assert track is not None
        ways = travels(track.t, track.values[:, i], mass.speed)
        moves += [(float(track.t[first]), float(track.t[last])) for first, last in ways]
    spans = list[tuple[float, float]]()
    for leaves, arrives in (*sorted(moves), (end, end)):
        if leaves > quiet:
            spans.append((quiet, leaves))
        quiet = max(quiet, arrives)
    return spans


def rest_of(n: Floats, shift: Vector3) -> Rest:
    """Return the rest that rows of gravity's direction are of."""
    mean = n.mean(axis=0)
    off: Floats = n - mean
    variance = float(np.trace(long_run_covariance(off, memory(off)))) / 2 / len(n) ** 2
    swing = float(np.sum(off**2)) ** 0.5 / (2 * len(n)) ** 0.5
    return Rest(mean / float(np.linalg.norm(mean)), max(variance**0.5, 1e-9), shift, swing)


def stops(recording: Recording, testbed: Testbed) -> list[Rest]:
    """Return the rest at every stop of the masses that is long enough to count."""
    attitude = recording.attitude
    if attitude is None:
        return []
    t: Series1 = measured_at(attitude.t, testbed.attitude)
    down = -to_matrix(attitude.values)[:, 2, :]
    maps, found = mass_maps(testbed.masses), list[Rest]()
    for start, end in quiet_spans(recording, testbed):
        rows = (t >= start + SETTLING * (end - start)) & (t <= end)
        if rows.sum() < FEWEST:
            continue
        middle = np.array([0.5 * (start + end)])
        d = straight_lines(recording.masses, middle, len(testbed.masses))[0]
        found.append(rest_of(down[rows], com_shift(maps, testbed.body.mass, d)))
    return found


def across(n: Vector3) -> Matrix3:
    """Return [n x]^T [n x] = E - n n^T of a unit vector: what is across it."""
    return np.eye(3) - np.outer(n, n)


def along(lever: Vector3) -> tuple[Vector3, Matrix3]:
    """Return the direction of a lever arm and how it turns with the arm, 1/m."""
    length = max(float(np.linalg.norm(lever)), SHORTEST)
    u: Vector3 = lever / length
    return u, across(u) / length


def rest_information(rests: list[Rest]) -> Matrix3:
    """Return the normal matrix of the linear rows."""
    return sum((across(rest.down) for rest in rests), np.zeros((3, 3)))


def local_model(rests: list[Rest], com: Vector3) -> tuple[Matrix3, Vector3, float]:
    """Return information, descent (half of the cost's, downwards) and twice the cost at r."""
    information, descent, cost = np.zeros((3, 3)), np.zeros(3), 0.0
    for rest in rests:
        u, slope = along(com + rest.shift)
        left = (rest.down - u) / rest.sd
        information += slope.T @ slope / rest.sd**2
        descent += slope.T @ left / rest.sd
        cost += float(left @ left)
    return information, descent, cost


def solve(rests: list[Rest]) -> tuple[Vector3, Matrix3, float]:
    """Return r, its information, and twice the cost there."""
    right = -sum((across(rest.down) @ rest.shift for rest in rests), np.zeros(3))

    com: Vector3 = inverse_spd(rest_information(rests)) @ right
    information, descent, cost = local_model(rests, com)
    damping, growth = FIRST, 2.0
    for _ in range(MOST):
        step = scaled_solve(information, descent, damping)
        promised = promise(information, descent, step)
        if promised < LEAST:
            break
        trial = local_model(rests, com + step)
        taken, damping, growth = judge(cost - trial[2], promised, damping, growth)
        if taken:
            com, (information, descent, cost) = com + step, trial
    return com, information, cost


def doubts(rests: list[Rest], misfit: float) -> tuple[Reason, ...]:
    """Return why the intervals may be wrong, or nothing."""
    swing = max(rest.swing for rest in rests)
    if swing > SWING:
        return (Reason(Why.SWINGS_AT_REST, (), {"swing": swing}),)
    if misfit > chi_square_limit(2 * len(rests) - 3, 1.0 - SURE):
        return (Reason(Why.RESTS_DISAGREE),)
    return ()


def lacking(rests: list[Rest]) -> Outcome | None:
    """Return why rests cannot show the centre of mass; None: they can."""
    if len(rests) >= 2 and np.linalg.eigvalsh(rest_information(rests))[0] >= WEAKEST * len(rests):
        return None
    return outcome(Why.TOO_FEW_RESTS, rests=len(rests))


def too_rough(rests: list[Rest], com: Vector3, information: Matrix3) -> Outcome | None:
    """Return that rests are known too roughly to show the distance of com from P, or None."""
    longest = max(float(np.linalg.norm(com + rest.shift)) for rest in rests)
    if float(np.linalg.eigvalsh(information)[0]) * longest**2 >= 1.0:
        return None
    sd, swing = max(s.sd for s in rests), max(s.swing for s in rests)
    return outcome(Why.RESTS_TOO_ROUGH, sd=sd, swing=swing)


def unseeing(why: Outcome) -> Estimate:
    """Return that nothing was found, and why."""
    unseen = (Reason(Unobservable.DISTANCE),)
    return Estimate(METHOD, why, (), np.zeros((0, 0)), None, unseen)


def estimate(recording: Recording, testbed: Testbed, options: Options) -> Estimate:
    """Return the centre of mass with the masses at home."""
    recording = arranged(recording, testbed.mass_names)
    rests = stops(recording, testbed)
    if lack := lacking(rests):
        return unseeing(lack)
    com, information, misfit = solve(rests)
    if rough := too_rough(rests, com, information):
        return unseeing(rough)
    covariance = inverse_spd(information)
    sd = np.sqrt(np.diag(covariance))
    parameters = tuple(
        Parameter(name, "m", float(com[k]), float(sd[k])) for k, name in enumerate(COM)
    )
    first = Reason(Why.FROM_RESTS, (), {"rests": len(rests)})
    ended, origin = Outcome((first, *doubts(rests, misfit))), origin_of(recording)
    return Estimate(METHOD, ended, parameters, covariance, provenance=origin)
