"""Hours of an emulated bench in one process: is a row lost, does memory grow, is it quick enough?

The platform swings as it likes, over the top too, where hours of a wandering torque may bring it;
no limit of tilt or rate stops it. Every ten minutes a mass is sent out or back. All rows are
written to an MCAP record as they come. Memory is what the system counts as resident.
"""

import os
import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from equipoise.io.mcap.live_recording import LiveRecording, Opening
from equipoise.io.testbed.presets import read_preset
from equipoise.model.testbed import Testbed
from tests.support.emulated_lab import Lab, lab, over_tcp
from verification.processes import resident
from verification.result import Result, Row, Spread, at_least, at_most, in_turn

HOURS, BEGUN = 8.0, 0.25  # h of bench time; h after which memory is first looked at
STRETCH, OFTEN = 10.0, 60  # s to a read; stretches between moves
STEP = 0.05  # s by which both sides of the wires go on at a time: two rows of 40 Hz
AWAY = 2e-3  # m


@dataclass(frozen=True, slots=True)
class Soaked:
    """What became of one long run."""

    hours: float
    speed: float  # bench time over the clock on the wall
    lost: int  # rows of attitude or rate
    extra: int
    grown: float  # share of the memory at the beginning
    megabytes: float
    stops: int


def unlimited(bed: Testbed) -> Testbed:
    """Return a testbed that may tilt and turn as it likes."""
    assert bed.hardware is not None
    limits = replace(bed.hardware.limits, rate=np.inf)
    return replace(bed, tilt_limit=np.inf, hardware=replace(bed.hardware, limits=limits))


def soaked(hours: float) -> Soaked:
    """Let an emulated bench go on for so many hours."""
    bed = unlimited(over_tcp(read_preset("nanosat")))
    with (
        tempfile.TemporaryDirectory() as folder,
        LiveRecording(Path(folder) / "run.mcap", Opening(time.time_ns())) as record,
        lab(bed, tick=STEP) as found,
    ):
        found.keeper.listen(record)
        return _watched(found, hours)


def _watched(found: Lab, hours: float) -> Soaked:
    bed, bench = found.bench.testbed, found.bench
    assert bed.attitude is not None
    assert bed.gyro is not None
    stretches, observed, memory = round(hours * 3600 / STRETCH), [0, 0], 0.0
    begun, start = time.perf_counter(), found.emulated.time
    for k in range(stretches):
        if k % OFTEN == 0:
            bench.move({"x": AWAY if k // OFTEN % 2 else 0.0})
        rows = bench.read(STRETCH)
        observed[0] += 0 if rows.attitude is None else len(rows.attitude)
        observed[1] += 0 if rows.rate is None else len(rows.rate)
        if k == round(min(BEGUN, hours / 2) * 3600 / STRETCH):
            memory = resident(os.getpid())
    passed = found.emulated.time - start
    wanted = [round(passed * bed.attitude.rate), round(passed * bed.gyro.rate)]
    missing = [w - s for w, s in zip(wanted, observed, strict=True)]
    return Soaked(
        passed / 3600, passed / (time.perf_counter() - begun),
        sum(max(n - 1, 0) for n in missing), sum(max(-n - 1, 0) for n in missing),
        resident(os.getpid()) / memory - 1, resident(os.getpid()),
        sum(kind == "interlock" for _, kind, _ in found.events),
    )  # fmt: skip


def measure(seeds: Sequence[int], spread: Spread = in_turn) -> Result:
    """Measure one run; fewer than all seeds are as many eighths of the hours."""
    (run,) = spread(soaked, [HOURS * len(seeds) / 8])
    claim = (
        f"Preset nanosat through emulated Grbl and VN-100 over TCP, recorded to MCAP, for "
        f"{run.hours:.1f} h of bench time in steps of {STEP} s, a mass moved every ten minutes."
    )
    rows: tuple[Row, ...] = (
        at_least("bench time over real time", run.speed, 20.0, ".1f"),
        at_most("rows lost", run.lost, 0, "d"),
        at_most("rows too many", run.extra, 0, "d"),
        at_most("growth of memory", run.grown, 0.05, ".1%"),
        at_most("stops and silences", run.stops, 0, "d"),
    )
    return Result("long_emulation", claim, rows, (f"Memory at the end: {run.megabytes:.0f} MB.",))
