"""Every verdict against the truth, and the simple looks of `assess` on MuJoCo's records.

Each verdict that can pass has a trial (``verdict_trials``): how often it passes what is wrong,
fails what is right, and cannot tell. Those of `assess` are judged on poor records besides:

A platform of the preset `sputnix` is drawn with a centre of mass anywhere about P (one in three
above it), such that its true torque, or its true distance, is a drawn multiple of what is required;
requirements run from below the floor of a record of a minute to far above. A second set stands
just beyond the requirement, where every pass is wrong.
"""

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.stats import binom

from equipoise.dynamics.sag_trim import residual_torque
from equipoise.io.testbed.presets import read_preset
from equipoise.maths.attitude import to_matrix
from equipoise.model.estimate import COM
from equipoise.model.mass_properties import MassProperties
from equipoise.model.recording import Recording
from equipoise.model.testbed import AttitudeSensor, Gyro, Testbed
from equipoise.model.verdict import VerdictOutcome
from equipoise.procedure.identification.assess import (
    AssessOptions,
    answers_of,
    bounds_of,
    fit_of,
    pull_of,
)
from equipoise.procedure.identification.swing_metrics import swing_metrics
from equipoise.procedure.steps.tilt_guard import guarded
from equipoise.simulation.bench import SimulatedBench
from tests.oracle import mujoco_bench as oracle
from verification import balanced
from verification.balanced import SILENT
from verification.chance import FULL, RARE
from verification.result import Result, Row, Spread, at_most, in_turn
from verification.verdict_trials import TRIALS

PASSED, UNDECIDED = VerdictOutcome.PASSED, VerdictOutcome.UNDECIDED
FAILED = VerdictOutcome.FAILED
Array = NDArray[np.float64]
SECONDS = 60.0
LIMITS = (3e-6, 3e-3)  # N m: a record of a minute has a floor of some 1e-5
MULTIPLES = (0.2, 5.0)
BEYOND = 1.001
ABOVE = 1 / 3  # of platforms with the centre of mass above P
WRONG = 0.025
MOST_OFF, OUTLYING = 1.15, 4.0  # sd, chosen: stated sd may be too wide, not too narrow


class Answer(NamedTuple):
    """One platform judged twice."""

    beyond: tuple[bool, bool]  # torque, distance: truth beyond what is required
    answers: tuple[VerdictOutcome, VerdictOutcome]


def platform(seed: int, multiple: float | None) -> tuple[Testbed, float, float]:
    """Return a testbed with its truth, and what is required of torque (N m) and distance (m)."""
    rng, bed = np.random.default_rng([77, seed]), read_preset("sputnix")
    assert bed.truth is not None
    way = rng.normal(size=3)
    way[2] = abs(way[2]) * (1 if rng.random() < ABOVE else -1)
    way /= np.linalg.norm(way)
    limit = float(np.exp(rng.uniform(*np.log(LIMITS))))
    low, high = np.log(MULTIPLES)
    drawn = float(np.exp(rng.uniform(low, high))) if multiple is None else multiple
    weight = bed.weight
    per_metre = weight * residual_torque(way, np.zeros((3, 3)), bed.up, AssessOptions().tilt)
    size = drawn * limit / per_metre
    return replace(bed, truth=replace(bed.truth, com=size * way)), limit, size / drawn


def judged(job: tuple[int, float | None]) -> Answer:
    """Return the verdicts on one platform: of torque, and of distance."""
    bed, torque, distance = platform(*job)
    bench = SimulatedBench(bed, job[0])
    record = guarded(bench, SECONDS)
    requested = AssessOptions(require_torque=torque, require_offset=distance)
    estimated = fit_of(record, bed, requested)
    found = answers_of(requested, *bounds_of(requested, pull_of(*estimated[1]), bed))
    true = bench.truth().com
    beyond = bed.weight * residual_torque(true, np.zeros((3, 3)), bed.up, requested.tilt) > torque
    if not estimated[0].outcome.usable:
        return Answer((beyond, beyond), (UNDECIDED, UNDECIDED))
    distant = bool(np.linalg.norm(true) > distance)
    return Answer((beyond, distant), (found[0].outcome, found[1].outcome))


def rates(name: str, found: Sequence[Answer], k: int) -> list[Row]:
    """Return the rates of one kind of verdict (0: torque, 1: distance)."""
    n = len(found)
    bad = np.array([each.beyond[k] for each in found])
    passed = np.array([each.answers[k] == PASSED for each in found])
    failed = np.array([each.answers[k] == FAILED for each in found])
    open_to = float(np.mean(~passed & ~failed))
    return [
        at_most(f"{name}: wrong pass, of all", float(np.mean(passed & bad)), most(n), ".1%"),
        at_most(f"{name}: wrong fail, of all", float(np.mean(failed & ~bad)), most(n), ".1%"),
        Row(f"{name}: rightly passed", f"{passed[~bad].sum()} of {np.sum(~bad)} good", "", True),
        Row(f"{name}: rightly failed", f"{failed[bad].sum()} of {bad.sum()} bad", "", True),
        Row(f"{name}: cannot tell", f"{open_to:.1%}", "", True),
    ]


def most(runs: int) -> float:
    """Return the greatest share of wrong passes that agrees with 2.5 % of many."""
    return WRONG if runs >= FULL else float(binom.ppf(1 - RARE, runs, WRONG) / runs)


def trial_rows(name: str, seeds: Sequence[int], spread: Spread = in_turn) -> list[Row]:
    """Return how often the verdict of one trial is wrong, and how often it cannot tell."""
    trial = TRIALS[name]
    found = spread(trial.judge, list(seeds)[: max(len(seeds) // trial.cost, 1)])
    n = len(found)
    true = np.array([each.true for each in found])
    passed = np.array([each.outcome == PASSED for each in found])
    open_to = np.array([each.outcome == UNDECIDED for each in found])
    failed = ~passed & ~open_to
    what = f"{name}, {n} seeds"
    return [
        at_most(f"{what}: passes what is wrong", float(np.mean(passed & ~true)), most(n), ".1%"),
        at_most(f"{what}: fails what is right", float(np.mean(failed & true)), most(n), ".1%"),
        at_most(f"{what}: cannot tell", float(open_to.mean()), balanced.most(SILENT, n), ".1%"),
        Row(f"{what}: true", f"{true.sum()} of {n}", "", True),
    ]


def swing(seed: int) -> tuple[oracle.OracleRun, Recording, Testbed]:
    """Return two minutes of a random platform's free swing in MuJoCo; every second has a gyro."""
    rng = np.random.default_rng(seed)
    run = oracle.simulate(oracle.random_platform(rng), dt=2e-3, locked=True)
    camera, gyro = AttitudeSensor(5.0, np.radians(0.2), plumb_sd=0.0), None
    log = partial(oracle.sensor_log, run, rng)
    if seed % 2:
        gyro = Gyro(50.0, 1e-3, np.radians(1.0))
        recording = log(gyro_rate=50.0, gyro_noise=1e-3, gyro_bias=rng.normal(0, 1e-3, 3))
    else:
        recording = log()
    return run, recording, oracle.testbed_for(run.platform, rng, 0.0, camera, gyro)


def measurements(seed: int) -> dict[str, list[float]]:
    """Return the errors of the simple looks at a free swing, in their own sd; J known."""
    run, recording, testbed = swing(seed)
    platform = run.platform
    body = MassProperties(platform.mass, platform.com, platform.inertia_P)
    observed = swing_metrics(recording, replace(testbed, body=body))
    weight, com = platform.mass * testbed.gravity, platform.com
    assert observed.torque is not None
    assert observed.energy is not None
    n = -np.array([to_matrix(q)[2] for q in run.q])
    off = {"height by the period": [
        (each.moment - weight * np.linalg.norm(com)) / each.sd for each in observed.hanging
    ]}  # fmt: skip
    at = [np.interp(observed.torque.t, run.t, column) for column in n.T]
    response = weight * np.linalg.norm(np.cross(com, np.column_stack(at)), axis=1)
    off["torque felt, rms"] = [(observed.torque.rms - rms(response)) / observed.torque.rms_sd]
    at = [np.interp(observed.energy.t, run.t, column) for column in n.T]
    work = weight * (np.column_stack(at) @ com)
    off["energy, rms"] = [(observed.energy.rms - rms(work - work.mean())) / observed.energy.rms_sd]
    for name, fit in (("torque", observed.torque_fit), ("energy", observed.energy_fit)):
        assert fit is not None
        if fit.outcome.usable:
            sd = np.sqrt(np.diag(fit.covariance_of(COM)))
            off[f"centre of mass by {name}"] = list((fit.com - com) / sd)
    return off


def rms(values: Array) -> float:
    """Return the root mean square."""
    return float(np.sqrt(np.mean(values**2)))


def measurement_rows(found: Sequence[dict[str, list[float]]]) -> list[Row]:
    """Return how far the looks are off, in their own sd."""
    rows = list[Row]()
    for name in found[0]:
        off = np.array([z for each in found for z in each.get(name, [])])
        what = f"MuJoCo, {name}: rms error in its own sd, of {len(off)}"
        rows.append(at_most(what, rms(off), MOST_OFF * (1 + 2 / np.sqrt(len(off))), ".2f"))
        rows.append(
            at_most(f"MuJoCo, {name}: greatest error", float(np.abs(off).max()), OUTLYING, ".1f")
        )
    return rows


def drawn_rows(seeds: Sequence[int], spread: Spread = in_turn) -> list[Row]:
    """Return the rates of verdicts on platforms anywhere about what is required."""
    found = spread(judged, [(seed, None) for seed in seeds])
    return rates("torque", found, 0) + rates("distance", found, 1)


def edge_rows(seeds: Sequence[int], spread: Spread = in_turn) -> list[Row]:
    """Return how often platforms pass that stand just beyond what is required."""
    found = spread(judged, [(seed, BEYOND) for seed in seeds])
    return rates("torque just beyond", found, 0)[:1] + rates("distance just beyond", found, 1)[:1]


def measure(seeds: Sequence[int], spread: Spread = in_turn) -> Result:
    """Judge platforms, and look at records."""
    edge, few = list(seeds)[: max(len(seeds) * 2 // 5, 1)], list(seeds)[: max(len(seeds) // 20, 3)]
    rows = (
        [row for name in TRIALS for row in trial_rows(name, seeds, spread)]
        + drawn_rows(seeds, spread)
        + edge_rows(edge, spread)
        + measurement_rows(spread(measurements, few))
    )
    claim = (
        "Every verdict that can pass, in uses with records that can decide. Verdicts of `assess` "
        f"on {len(seeds)} more simulated platforms of the preset sputnix, each "
        f"recorded for a minute or until it tilts beyond its limit, inertia known to 10 %; "
        f"required: {LIMITS[0] * 1e6:g} to {LIMITS[1] * 1e6:g} uN m, truth {MULTIPLES[0]:g} to "
        f"{MULTIPLES[1]:g} times that; {len(edge)} more stand just beyond. Looks: "
        f"{len(few)} free swings of two minutes in MuJoCo, camera of 0.2 deg and 5 Hz, every "
        "second with a gyro of 1e-3 rad/s and 50 Hz, inertia known."
    )
    return Result("verdicts", claim, tuple(rows))
