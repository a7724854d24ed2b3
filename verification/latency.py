"""From a sample on the wire to the estimate that counts it: real time, real port, real processes.

An emulated VN-100 of 200 Hz writes to a pseudo terminal, in a process of its own; the keeper's
process reads, checks the interlocks and writes an MCAP record; this process takes the rows and lets
the tracker go on by them. All times are of the system's one clock that never steps back.
"""

import multiprocessing
import tempfile
import time
from collections.abc import Sequence
from dataclasses import replace
from functools import cache
from multiprocessing.connection import Connection as Pipe
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from equipoise.app.bench.open_bench import KeptBench, Wanted
from equipoise.estimation.tracker.tracker import Params, State, first_state, track
from equipoise.hardware.bench.controller_process import DistantKeeper
from equipoise.hardware.bench.real_bench import RealBench
from equipoise.hardware.emulated.counterpart import PtyCounterpart
from equipoise.hardware.emulated.vectornav import EmulatedVectorNav
from equipoise.io.testbed.presets import read_preset
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed
from equipoise.simulation.bench import SimulatedBench
from verification.result import Result, Row, Spread, at_most, in_turn

RATE, SECONDS = 200.0, 20.0  # Hz, s
SETTLED = 200  # rows, chosen: the first second, in which ports are opened and caches are cold
WANTED = 5.0  # ms
Floats = NDArray[np.float64]


@cache
def testbed() -> Testbed:
    """Return the preset with its IMU at 200 Hz, no boards, and a platform that may swing."""
    bed = read_preset("nanosat")
    assert bed.attitude is not None
    assert bed.gyro is not None
    assert bed.hardware is not None
    return replace(
        bed,
        attitude=replace(bed.attitude, rate=RATE),
        gyro=replace(bed.gyro, rate=RATE),
        tilt_limit=3.0,
        hardware=replace(bed.hardware, boards=()),
    )


def speak(pipe: Pipe, messages: Sequence[bytes]) -> None:
    """Write a message each 5 ms once told to; tell the port first and the times (s) at last."""
    wire = PtyCounterpart()
    pipe.send(wire.address)
    pipe.recv()
    begun, times = time.monotonic(), list[float]()
    for k, message in enumerate(messages):
        while (left := begun + k / RATE - time.monotonic()) > 0:
            time.sleep(left)
        wire.receive()
        times.append(time.monotonic())
        wire.send(message)
    pipe.recv()
    pipe.send(times)
    wire.close()


def latencies(seed: int) -> tuple[Floats, int]:
    """Return the latency of each row, ms, and how many rows never came."""
    bed = testbed()
    observed = SimulatedBench(bed, seed).read(SECONDS)
    assert bed.hardware is not None
    (unit,) = bed.hardware.sensors
    here, there = multiprocessing.get_context("spawn").Pipe()
    messages = EmulatedVectorNav(unit).messages(observed)
    speaker = multiprocessing.get_context("spawn").Process(target=speak, args=(there, messages))
    speaker.start()
    try:
        port = replace(unit.port, address=here.recv())
        wired = replace(bed, hardware=replace(bed.hardware, sensors=(replace(unit, port=port),)))
        with tempfile.TemporaryDirectory() as folder:
            known = _followed(wired, observed, here, Path(folder) / "run.mcap")
        here.send("end")
        sent = np.array(here.recv())
    finally:
        speaker.join()
    came = ~np.isnan(known)
    first = int(np.argmax(came))  # rows of before the bench was watched are nobody's
    return 1e3 * (known - sent)[came][SETTLED:], int((~came[first:]).sum())


def _followed(bed: Testbed, observed: Recording, speaker: Pipe, record: Path) -> Floats:
    """Return when the tracker knew each row (s); NaN for one that it never saw."""
    assert observed.rate is not None
    known, state = np.full(len(observed.rate), np.nan), _warm(bed, observed)
    keeper = DistantKeeper(bed, KeptBench, Wanted(bed, record))
    try:
        speaker.send("begin")
        RealBench(keeper, keeper).watch()
        while np.isnan(known[-1]):
            keeper.wait()
            keeper.turn(keeper.now)
            rows = keeper.taken()
            if rows.attitude is None or rows.rate is None:
                continue
            begin = rows.attitude.values[0]
            state = state or first_state(float(rows.attitude.t[0]) - 1e-3, begin, bed)
            state = track(rows, bed, Params(), state).end
            known[_numbers(observed, rows.rate.values)] = time.monotonic()
    finally:
        keeper.close()
    return known


def _warm(bed: Testbed, observed: Recording) -> State | None:
    """Compile what tracking needs; return that nothing is known yet."""
    assert observed.attitude is not None
    track(observed, bed, Params(), first_state(-1e-3, observed.attitude.values[0], bed))
    return None


def _numbers(observed: Recording, rates: Floats) -> NDArray[np.intp]:
    """Return which rows these are: a gyro with noise never says the same twice."""
    assert observed.rate is not None
    return np.array([int(np.argmin(np.abs(observed.rate.values - w).sum(axis=1))) for w in rates])


def measure(seeds: Sequence[int], spread: Spread = in_turn) -> Result:
    """Measure one run for each seed, one after the other: they share the two cores."""
    runs = in_turn(latencies, seeds)
    spread(len, [])
    ms, lost = np.concatenate([run[0] for run in runs]), sum(run[1] for run in runs)
    claim = (
        f"Rows of a VN-100 at {RATE:g} Hz, each with attitude and rate, from the wire through the "
        f"keeper's process, which records, to the tracker's estimate; {len(ms)} rows."
    )
    rows: tuple[Row, ...] = (
        at_most("latency, median, ms", float(np.median(ms)), WANTED, ".2f"),
        at_most("latency, 99 of 100 rows, ms", float(np.quantile(ms, 0.99)), WANTED, ".2f"),
        at_most("rows lost", lost, 0, "d"),
    )
    jitter, worst = float(np.std(ms)), float(ms.max())
    note = f"Jitter (sd) {jitter:.2f} ms, quickest {ms.min():.2f} ms, slowest {worst:.2f} ms."
    return Result("latency", claim, rows, (note,))
