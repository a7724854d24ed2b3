"""Hours of keeping through an emulated board and unit: rows lost, memory, and where the com went.

The centre of mass drifts all the time, and no hand helps: the masses' rails are long enough for it.
All rows are written to an MCAP record as they come.
"""

import os
import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from equipoise.app.live.observed_bench import WatchedBench
from equipoise.app.runs.balancing import Goal, Through
from equipoise.app.runs.keeping import Session, options_for, run
from equipoise.app.runs.waiting import as_they_come
from equipoise.io.mcap.live_recording import LiveRecording, Opening
from equipoise.io.testbed.presets import read_preset
from equipoise.model.gravity_torque import GravityTorque
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed
from equipoise.procedure.balancing.hold import HoldOptions
from equipoise.procedure.balancing.motion_budget import MotionBudget
from tests.support.emulated_lab import Lab, lab, over_tcp
from verification.processes import resident
from verification.result import Result, Row, Spread, at_least, at_most, in_turn

Array = NDArray[np.float64]
HOURS, STEP = 8.0, 0.05  # h of bench time; s by which both sides of the wires go on at a time
DRIFT = np.array([0.15, -0.1, 0.05]) * 1e-6 / 60  # m/s: 87 um in 8 h
DAMPED = 2e-5  # N m s: of the air in the gap
GOAL = Goal(np.array([0.0, 0.0, -100e-6]), np.full(3, 3e-6))
EVERY, BEGUN = 60.0, 0.25  # s between looks; h after which memory is looked at first


@dataclass(slots=True)
class Watch:
    """What is counted while rows come."""

    found: Lab
    first: float  # s of bench time after which memory is looked at first
    rows: list[int] = field(default_factory=lambda: [0, 0])
    since: float | None = None
    memory: float = 0.0
    off: list[Array] = field(default_factory=list[Array])
    next: float = 0.0

    def __call__(self, rows: Recording) -> None:
        """Count rows; look at memory once, when what grows at first has grown."""
        now = self.found.emulated.time
        self.since = now if self.since is None else self.since
        for k, channel in enumerate((rows.attitude, rows.rate)):
            self.rows[k] += 0 if channel is None else len(channel)
        if self.memory == 0.0 and now - self.since > self.first:
            self.memory = resident(os.getpid())

    def kept(self, _torque: GravityTorque) -> None:
        """Look at the truth now and then while the balance is kept."""
        if self.found.emulated.time >= self.next:
            self.next = self.found.emulated.time + EVERY
            self.off.append(self.found.emulated.platform.truth().com - GOAL.target)


@dataclass(frozen=True, slots=True)
class Kept:
    """What became of one long keeping."""

    hours: float
    speed: float  # bench time over the clock on the wall
    lost: int
    grown: float  # share of the memory at the beginning
    megabytes: float
    stops: int
    worst: float  # m, true distance of any axis from the target
    moves: int
    sentence: str


def drifting() -> Testbed:
    """Return the preset behind network bridges, with a drift and a little damping."""
    bed = over_tcp(read_preset("nanosat"))
    assert bed.truth is not None
    torque = {f"drift_{axis}": float(v) for axis, v in zip("xyz", DRIFT, strict=True)}
    torque |= {f"viscous_{axis}": DAMPED for axis in "xyz"}
    return replace(bed, truth=replace(bed.truth, torque=torque))


def kept(hours: float) -> Kept:
    """Keep an emulated bench for so many hours."""
    with (
        tempfile.TemporaryDirectory() as folder,
        LiveRecording(Path(folder) / "run.mcap", Opening(time.time_ns())) as record,
        lab(drifting(), tick=STEP) as found,
    ):
        found.keeper.listen(record)
        return _watched(found, hours, Path(folder))


def _watched(found: Lab, hours: float, folder: Path) -> Kept:
    bed, watch = found.bench.testbed, Watch(found, 3600 * min(BEGUN, hours / 2))
    assert bed.attitude is not None
    assert bed.gyro is not None
    options = options_for(GOAL, hours * 3600, HoldOptions(duration=1.0, motion=MotionBudget(2e-6)))
    through = Through(lambda bench: WatchedBench(bench, watch, np.inf), as_they_come)
    begun, start = time.perf_counter(), found.emulated.time
    done = run(found.bench, Session(options, folder=folder, listener=watch.kept), None, through)
    passed = found.emulated.time - start
    wanted = [round(passed * rate) for rate in (bed.attitude.rate, bed.gyro.rate)]
    missing = [w - s for w, s in zip(wanted, watch.rows, strict=True)]
    off = np.abs(np.array(watch.off))
    return Kept(
        passed / 3600, passed / (time.perf_counter() - begun), sum(max(n - 1, 0) for n in missing),
        resident(os.getpid()) / (watch.memory or np.nan) - 1, resident(os.getpid()),
        sum(kind == "interlock" for _, kind, _ in found.events), float(off.max()), done.moves,
        done.verdict.sentence,
    )  # fmt: skip


def measure(seeds: Sequence[int], spread: Spread = in_turn) -> Result:
    """Measure one run; fewer than all seeds are as many eighths of the hours."""
    (done,) = spread(kept, [HOURS * len(seeds) / 8])
    claim = (
        "`keep` of preset nanosat through emulated Grbl and VN-100 over TCP, recorded to MCAP, for "
        f"{done.hours:.1f} h of bench time, while the centre of mass drifts by 0.19 um/min."
    )
    rows: tuple[Row, ...] = (
        at_most("greatest true distance of any axis from the target, um", 1e6 * done.worst, 3.0),
        at_most("rows lost", done.lost, 0, "d"),
        at_most("growth of memory", done.grown, 0.05, ".1%"),
        at_most("stops and silences", done.stops, 0, "d"),
        at_least("bench time over real time", done.speed, 10.0, ".1f"),
    )
    notes = (f"{done.moves} moves; memory at the end: {done.megabytes:.0f} MB.", done.sentence)
    return Result("kept_hours", claim, rows, notes)
