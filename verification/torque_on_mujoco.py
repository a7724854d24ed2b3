"""Torque by cause on platforms of MuJoCo bodies: moved once, and kept in an experiment."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from equipoise.model.recording import Recording, window
from equipoise.model.testbed import AttitudeSensor, Gyro, Testbed
from equipoise.model.torque_terms import expand
from equipoise.procedure.balancing.hold import HoldOptions, begun, hold
from equipoise.procedure.identification.attribute_torque import attribute_torque
from equipoise.procedure.identification.identify import IdentifyOptions, identify
from tests.oracle import mujoco_bench as oracle
from tests.oracle.mujoco_torque import WatchedBench, gusts, torque_of
from verification import keep
from verification.judged_torque import Judged, judged_by
from verification.mujoco_platforms import BIAS, SHARP

Array = NDArray[np.float64]
MOVED, KEPT = "MuJoCo, moved once", "MuJoCo, kept"
SECONDS = {MOVED: 60.0, KEPT: 150.0}
AIR, LASTS = 3e-6, 20.0  # N m, s
LIT = ((30.0, 90.0),)  # s after the experiment begins
STOPS = 1e-7  # m, one sd: the servos of the masses lag by as much


def moved_platform(seed: int) -> tuple[Recording, Testbed, oracle.OracleRun, Array]:
    """Return what a platform of 14 kg shows that moves its masses once, and its truth."""
    rng = np.random.default_rng([seed, 43])
    platform = oracle.random_platform(rng, mass=14.0)
    t = oracle.middles(SECONDS[MOVED], 2e-3)
    schedule = oracle.random_schedule(rng, platform, SECONDS[MOVED], 1)
    air = gusts(rng, t, AIR, LASTS)
    run = oracle.driven(platform, oracle.command(platform, schedule, t), air, 2e-3, in_body=True)
    recording = oracle.sensor_log(run, rng, 10.0, SHARP, 50.0, 1e-4, BIAS)
    camera, gyro = AttitudeSensor(10.0, SHARP), Gyro(50.0, 1e-4, np.radians(1.0))
    testbed = oracle.testbed_for(platform, rng, attitude=camera, gyro=gyro)
    return recording, testbed, run, air


def moved(seed: int) -> Judged | None:
    """Return the ledger of such a platform against its truth; None without a usable estimate."""
    recording, testbed, run, air = moved_platform(seed)
    *_, last = identify(recording, testbed, IdentifyOptions("trajectory"))
    if last.estimate is None or not last.estimate.outcome.usable:
        return None
    found = attribute_torque(recording, testbed, last.estimate)
    edges = np.append(found.t, found.t[-1] + found.interval)
    return judged_by(MOVED, found, torque_of(run, air, edges))


def kept_platform(seed: int, lasts: float = SECONDS[KEPT]) -> WatchedBench:
    """Return a bench after its platform was kept balanced in an experiment, in moving air."""
    testbed, platform, around = keep.drawn(seed)
    bench = WatchedBench(testbed, platform, replace(around, lamp=LIT), seed)
    bench.blow(AIR, LASTS)
    options = HoldOptions(
        keep.TARGET, np.full(3, keep.LIMIT), duration=lasts, every=1.0, motion=keep.BUDGET
    )
    _, knowledge = keep.balanced(bench, options)
    bench.begin()
    for _ in hold(bench, begun(knowledge, bench.testbed), options):
        pass
    return bench


def kept(seed: int) -> Judged | None:
    """Return the ledger of a kept platform against its truth; None without a usable estimate.

    Wheels point the platform, masses follow slowly, a lamp warms it, its centre of mass drifts.
    """
    bench = kept_platform(seed)
    assert bench.observed is not None
    recording = window(bench.observed, bench.kept_from, bench.observed.span[1])
    masses = tuple(replace(mass, accuracy=STOPS) for mass in bench.testbed.masses)
    testbed = replace(bench.testbed, masses=masses, disturbances=expand(("drift", "thermal")))
    *_, last = identify(recording, testbed, IdentifyOptions("trajectory"))
    if last.estimate is None or not last.estimate.outcome.usable:
        return None
    found = attribute_torque(recording, testbed, last.estimate)
    ends = found.t + found.interval
    edges = np.append(found.t[:1], ends[ends <= bench.kept_until])
    return judged_by(KEPT, found, bench.torque_by_cause(edges))
