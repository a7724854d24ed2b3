"""A lamp that warms the platform: found from its switch by `identify`, foreseen by the tracker.

The lamp goes on twice; its time constant is stated wrong to `identify`, and right to the tracker.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from equipoise.estimation.model_selection.reference_fit import estimate
from equipoise.estimation.output_error.trajectory import Params
from equipoise.estimation.tracker import tracker
from equipoise.estimation.tracker.predict_correct import WARM
from equipoise.io.testbed.presets import read_preset
from equipoise.maths.linalg import element_sizes, pack_symmetric, unpack_symmetric
from equipoise.model.defects import TrueLamp
from equipoise.model.devices import Lamp
from equipoise.model.estimate import COM
from equipoise.model.reasons.estimate_reasons import EstimateReason
from equipoise.model.recording import Recording, join
from equipoise.model.testbed import Testbed
from equipoise.model.torque_terms import GROUPS
from equipoise.simulation.bench import SimulatedBench
from verification.chance import share_band
from verification.efficiency import COVER
from verification.result import Result, Row, Spread, at_least, at_most, between, in_turn

ON = np.array([[100.0, 250.0], [400.0, 500.0]])  # s
WARMER, SLOW, STATED = 3.0, 60.0, 100.0  # K; s, as it is and as it is stated to identify
THERMAL = 1e-6  # m/K, in a random direction
SECONDS, EVERY = 600.0, 5.0  # s
COM_P = np.array([5e-6, -8e-6, -60e-6])  # m, of a platform that hangs
STILL = 1e-9, 1e-8  # m/sqrt(s), N m sqrt(s), chosen: nothing but warmth moves it
ROUGH = 0.02  # of a moment, one sd of what is stated to identify
TERMS = GROUPS["thermal"]
Array = NDArray[np.float64]


class Logged(NamedTuple):
    """A record, and what is true of it."""

    testbed: Testbed
    recording: Recording
    t: Array  # s, of what follows
    com: Array  # (n, 3) m
    thermal: Array  # m/K


class Run(NamedTuple):
    """One platform under the lamp."""

    z: Array  # (6,) errors of the coefficients and of com that identify found, in sd; NaN: not
    slow: float  # s, the time constant that it found
    tracked: Array  # (3,) rms error of com, m: lamp recorded; not; recorded, and known before
    tracked_z: Array  # errors of com and of the coefficients in the tracker's sd, where nothing
    # else moves it


def logged(seed: int) -> Logged:
    """Return what a platform did under the lamp, its inertia known to the tracker."""
    preset, way = read_preset("sputnix"), np.random.default_rng([seed, 3]).normal(size=3)
    way /= np.linalg.norm(way)
    thermal = THERMAL * way
    truth = replace(
        preset.truth, com=COM_P + 5.0 * thermal, tilt=0.05, rate_limit=0.004, lamp=TrueLamp(ON),
        inertia_P=preset.body.inertia_P, torque=dict(zip(TERMS, map(float, thermal), strict=True)),
    )  # fmt: skip
    testbed = replace(preset, lamp=Lamp(WARMER, SLOW), inertia_sd=0.0, truth=truth)
    bench = SimulatedBench(testbed, seed)
    recording, t, com = bench.read(0.0), [], []
    while bench.time < SECONDS:
        recording = join(recording, bench.read(EVERY))
        t.append(bench.time)
        com.append(bench.com)
    return Logged(testbed, recording, np.array(t), np.array(com), thermal)


def tracked(
    log: Logged, recording: Recording, params: tracker.Params, known: Array
) -> tuple[Array, Array, tracker.Track]:
    """Return errors of com from the first switch on, m, their sd, and the end of the track."""
    attitude = recording.attitude
    first = tracker.first_state(0.0, attitude.values[0], log.testbed)
    track = tracker.track(recording, log.testbed, params, replace(first, thermal=known))
    rows = np.searchsorted(track.t, log.t[log.t > ON[0, 0]], side="right") - 1
    return track.com[rows] - log.com[log.t > ON[0, 0]], track.com_sd[rows], track


def run(seed: int) -> Run:
    """Identify and track one record."""
    log, nothing = logged(seed), np.zeros(3)
    dark = replace(log.recording, lamp=None)
    cases = ((log.recording, nothing), (dark, nothing), (log.recording, log.thermal))
    rms = [np.sqrt(np.mean(tracked(log, r, tracker.Params(), k)[0] ** 2)) for r, k in cases]
    error, sd, track = tracked(log, log.recording, tracker.Params("fed", *STILL), nothing)
    of_k = (track.thermal[-1] - log.thermal) / track.sd[-1, WARM]
    z, slow = identified(log)
    return Run(z, slow, np.array(rms), np.concatenate([(error / sd)[-1], of_k]))


def identified(log: Logged) -> tuple[Array, float]:
    """Return errors of coefficients and com in sd, and the time constant that was found, s."""
    testbed = replace(roughly_known(log), lamp=Lamp(WARMER, STATED))
    found = estimate(log.recording, testbed, Params(use_prior=True))
    if not found.has(TERMS[0]):
        return np.full(6, np.nan), np.nan
    names, true = (*TERMS, *COM), np.concatenate([log.thermal, log.testbed.truth.com])
    z = (found.values(names) - true) / np.sqrt(np.diag(found.covariance_of(names)))
    reasons = [r for r in found.outcome.reasons if r.code is EstimateReason.LAMP_RESPONSE]
    return z, reasons[0].numbers["found"] if reasons else STATED


def roughly_known(log: Logged) -> Testbed:
    """Return the testbed with an inertia that is off by as much as is stated."""
    body, testbed = log.testbed.body, replace(log.testbed, inertia_sd=ROUGH)
    off = np.random.default_rng([int(1e9 * log.thermal[0]) % 2**32, 5]).normal(size=6)
    inertia = pack_symmetric(body.inertia_P) + ROUGH * off * element_sizes(body.inertia_P)
    return replace(testbed, body=replace(body, inertia_P=unpack_symmetric(inertia)))


def rows_of(runs: Sequence[Run]) -> tuple[Row, ...]:
    """Return the rows."""
    n, z = len(runs), np.array([each.z for each in runs])
    supported = z[np.isfinite(z[:, 0])]
    slow = np.array([each.slow for each in runs])
    rms, of_track = np.array([each.tracked for each in runs]), np.array([r.tracked_z for r in runs])
    ratio = np.median(rms[:, 1] / rms[:, 0])
    before = np.median(rms[:, 1] / rms[:, 2])
    band = share_band(COVER, 0.95, n, 3)
    share = [float(np.mean(np.abs(part) < 1.96)) for part in (supported, of_track)]
    return (
        at_least("identify: records that support the term", len(supported) / n, 0.95, ".1%"),
        between("identify: 95 % intervals hold coefficients and com", share[0], band, ".1%"),
        at_most(f"identify: time constant of {SLOW:g} s, stated {STATED:g} s; rms error, s",
                float(np.sqrt(np.nanmean((slow - SLOW) ** 2))), 6.0),
        at_least("tracker: error of com without the switch / with it, median", float(ratio), 1.5),
        at_least("the same, coefficients known before", float(before), 2.0),
        between("tracker: 95 % intervals hold com and coefficients at the end", share[1], band,
                ".1%"),
    )  # fmt: skip


def measure(seeds: Sequence[int], spread: Spread = in_turn) -> Result:
    """Record, identify and track one platform for each seed."""
    runs = spread(run, seeds)
    claim = (
        f"Preset sputnix under a lamp that goes on twice in {SECONDS:g} s and moves the centre of "
        f"mass by {1e6 * THERMAL * WARMER:g} um in the end, only its switch recorded: `identify` "
        "finds coefficients and time constant within their intervals, and the tracker follows."
    )
    return Result("lamp", claim, rows_of(runs))
