"""Equilibrium points: at rest the centre of mass hangs under the centre of rotation.

    (r + dr_i) x n_i = 0,   n_i = g_B / g at rest (or the mean of a swing)
    [n_i x] r = -[n_i x] dr_i       stacked over two or more stops with non-parallel shifts dr_i

(methods 2.5; inertia not needed.) Each stop of the masses in the record gives one n_i, the mean of
gravity's direction, weighted by how much that mean can be off: the scatter about it, over the
root of the number of independent rows.

Cannot see anything from one stop but the direction of r; is no use near balance, where a swing
takes minutes and its mean is not a rest.
"""

import numpy as np

from equipoise import __version__
from equipoise.actuators.sliding_masses import com_shift, mass_maps
from equipoise.actuators.stops import travels
from equipoise.dynamics.timeline import straight_lines
from equipoise.maths.attitude import to_matrix
from equipoise.maths.linalg import lag_one, skew
from equipoise.model.arrays import Floats, Matrix3, Series1, Vector3
from equipoise.model.estimate import COM, Estimate, Parameter
from equipoise.model.outcome import Outcome
from equipoise.model.recording import Recording, arranged
from equipoise.model.testbed import Testbed
from equipoise.sensors.timing import seen_at

METHOD = "equilibrium"
FEWEST = 10  # rows in a stop
WEAKEST = 1e-4  # smallest usable eigenvalue of the mean of [n x]^T [n x], two being near 1


def quiet_spans(recording: Recording, testbed: Testbed) -> list[tuple[float, float]]:
    """Return the spans (s) in which no mass travelled."""
    start, end = recording.span
    edges = [start]
    track = recording.masses
    for i, mass in enumerate(testbed.masses if track is not None else ()):
        assert track is not None
        for first, last in travels(track.t, track.values[:, i], mass.speed):
            edges += [float(track.t[first]), float(track.t[last])]
    edges = sorted([*edges, end])
    return [(a, b) for a, b in zip(edges[::2], edges[1::2], strict=False) if b > a]


def mean_direction(n: Floats) -> tuple[Vector3, float]:
    """Return the mean unit vector and the sd (rad) of its direction."""
    mean = n.mean(axis=0)
    off: Floats = n - mean
    rho = min(max(lag_one(off), 0.0), 0.999)
    independent = max(len(n) * (1 - rho) / (1 + rho), 1.0)
    square: Floats = np.sum(off**2, axis=1)
    spread = float(np.sqrt(np.mean(square) / 2 / independent))
    return mean / float(np.linalg.norm(mean)), max(spread, 1e-9)


def stops(recording: Recording, testbed: Testbed) -> list[tuple[Vector3, float, Vector3]]:
    """Return n, its sd and the shift dr (m) of every stop long enough to count."""
    attitude = recording.attitude
    if attitude is None:
        return []
    t: Series1 = seen_at(attitude.t, testbed.attitude)
    down = -to_matrix(attitude.values)[:, 2, :]
    maps, found = mass_maps(testbed.masses), list[tuple[Vector3, float, Vector3]]()
    for start, end in quiet_spans(recording, testbed):
        rows = (t >= start) & (t <= end)
        if rows.sum() < FEWEST:
            continue
        middle = np.array([0.5 * (start + end)])
        d = straight_lines(recording.masses, middle, len(testbed.masses))[0]
        found.append((*mean_direction(down[rows]), com_shift(maps, testbed.body.mass, d)))
    return found


def solve(rests: list[tuple[Vector3, float, Vector3]]) -> tuple[Vector3, Matrix3]:
    """Return r and its information, weighting twice: lever arms are known only after a first."""
    com = np.zeros(3)
    normal = np.eye(3)
    for _ in range(3):
        normal, right = np.zeros((3, 3)), np.zeros(3)
        for n, sd, shift in rests:
            lever = max(float(np.linalg.norm(com + shift)), 1e-6)
            weight = (sd * lever) ** -2
            across = skew(n).T @ skew(n) * weight
            normal, right = normal + across, right - across @ shift
        com = np.linalg.lstsq(normal, right, rcond=1e-12)[0].astype(np.float64, copy=False)
    return com, normal


def estimate(recording: Recording, testbed: Testbed) -> Estimate:
    """Return the centre of mass with the masses at home."""
    recording = arranged(recording, testbed.mass_names)
    rests = stops(recording, testbed)
    across = sum((skew(n).T @ skew(n) for n, _, _ in rests), np.zeros((3, 3)))
    if len(rests) < 2 or np.linalg.eigvalsh(across)[0] < WEAKEST * len(rests):
        text = (
            f"{len(rests)} distinct rest positions found, two are needed: "
            "move a mass sideways and let the platform settle."
        )
        unseen = ("the data do not see how far the centre of mass is from the centre of rotation",)
        return Estimate(METHOD, Outcome(False, text), (), np.zeros((0, 0)), None, unseen)
    com, normal = solve(rests)
    covariance = np.linalg.inv(normal).astype(np.float64, copy=False)
    sd = np.sqrt(np.diag(covariance))
    parameters = tuple(
        Parameter(name, "m", float(com[k]), float(sd[k])) for k, name in enumerate(COM)
    )
    text = f"The centre of mass from {len(rests)} rest positions; the inertia is not estimated."
    origin = {"version": __version__, "source": recording.source, "sha256": recording.sha256}
    return Estimate(METHOD, Outcome(True, text), parameters, covariance, provenance=origin)
