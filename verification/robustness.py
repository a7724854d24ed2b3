"""Gross outliers, dropouts and a long gap at once, for the robust fit and the tracker.

Each record (``method_records``, regime moved) is estimated as it is, and with 5 % of rows of camera
and gyro grossly off, 10 % missing and nothing seen for 30 s.
"""

from collections.abc import Sequence
from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray
from scipy.stats import f

from equipoise.model.arrays import Floats
from equipoise.model.estimate import COM, END, INERTIA, Estimate
from equipoise.model.recording import Recording, Samples
from equipoise.procedure.identification.identify import IdentifyOptions, identify
from tests.oracle import mujoco_bench as oracle
from verification.chance import RARE
from verification.method_records import Record, regime
from verification.result import Result, Row, Spread, at_least, at_most, in_turn

Array = NDArray[np.float64]
ODD, MISSING, GAP = 0.05, 0.10, (55.0, 85.0)  # shares of rows; s
TURNED, SPUN = np.radians(5.0), np.radians(5.0)  # rad, rad/s, rms of gross outliers per axis
FACTOR, USABLE = 2.0, 0.9
STATED = 20  # records for which the claim is stated
HOW = {
    "trajectory": IdentifyOptions("trajectory", robust=True),
    "tracker": IdentifyOptions("tracker"),
}


def thinned(channel: Samples, values: Floats, rng: np.random.Generator) -> Samples:
    """Return a channel without what is missing."""
    t = channel.t
    keep = (rng.random(len(t)) > MISSING) & ((t < GAP[0]) | (t > GAP[1]))
    return Samples(t[keep], values[keep])


def spoiled(recording: Recording, seed: int) -> Recording:
    """Return a record with outliers, dropouts and a gap."""
    rng = np.random.default_rng([seed, 7])
    camera, gyro = recording.attitude, recording.rate
    assert camera is not None
    assert gyro is not None
    off = [(rng.random((len(c), 1)) < ODD) * rng.normal(size=(len(c), 3)) for c in (camera, gyro)]
    q = oracle.product(camera.values, oracle.rotation(TURNED * off[0]))
    return replace(
        recording,
        attitude=thinned(camera, q, rng),
        rate=thinned(gyro, gyro.values + SPUN * off[1], rng),
    )


def errors(estimate: Estimate, record: Record) -> Array:
    """Return the errors of com and J (9,); com as it stands at the end where that is told."""
    com = COM if estimate.has(COM[0]) else END
    if not estimate.has(com[0]):
        return np.full(9, np.nan)
    true = record.truth
    names = (*com, *INERTIA)
    return estimate.values(names) - np.array([true[name] for name in names])


def pair(name: str, seed: int) -> tuple[Array, Array, bool]:
    """Return the errors as recorded and spoiled, and whether the latter are called usable."""
    record, found = regime("moved", seed), list[Estimate]()
    for recording in (record.recording, spoiled(record.recording, seed)):
        *_, last = identify(recording, record.testbed, HOW[name])
        assert last.estimate is not None
        found.append(last.estimate)
    size = np.append(np.full(3, 1e-6), np.full(6, float(np.trace(record.inertia_P)) / 3))
    before, after = (errors(each, record) / size for each in found)
    return before, after, found[1].outcome.usable


def limit_of(records: int) -> float:
    """Return the limit of a ratio of RMSE: as stated, or with fewer records wider by chance."""
    return FACTOR if records >= STATED else FACTOR * float(f.isf(RARE, records, records)) ** 0.5


def rows_of(name: str, runs: Sequence[tuple[Array, Array, bool]]) -> tuple[Row, ...]:
    """Return the rows of one method."""
    clean, spoilt = (np.array([run[k] for run in runs]) for k in (0, 1))
    rms = [np.sqrt(np.mean(e**2, axis=0)) for e in (clean, spoilt)]
    ratio = [float(np.sqrt(np.sum(rms[1][p] ** 2) / np.sum(rms[0][p] ** 2)))
             for p in (slice(0, 3), slice(3, 9))]  # fmt: skip
    usable, limit = float(np.mean([run[2] for run in runs])), limit_of(len(runs))
    return (
        at_most(f"{name}: RMSE of com, times that of the sound record", ratio[0], limit),
        at_most(f"{name}: RMSE of J, times that of the sound record", ratio[1], limit),
        at_least(f"{name}: share of spoiled records called usable", usable, USABLE),
    )


def measure(seeds: Sequence[int], spread: Spread = in_turn) -> Result:
    """Estimate each record twice, by the robust fit and by the tracker."""
    rows = [row for name in HOW for row in rows_of(name, spread(partial(pair, name), seeds))]
    claim = (
        f"Over {len(seeds)} MuJoCo records (two minutes, two moves, camera 0.05 deg and gyro, both "
        "50 Hz) with 5 % gross outliers (5 deg, 5 deg/s rms), 10 % dropouts and a gap of 30 s, the "
        "robust trajectory fit and the tracker err at most twice as much as on the sound records."
    )
    return Result("robustness", claim, tuple(rows))
