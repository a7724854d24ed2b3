"""What a bench says when each device is spoken to, one sentence each.

Boards and actuators answer and agree with the testbed; masses go home, and 1 mm out and back where
a person agrees; sensors stream; attitudes are upright and turn as the gyro does; devices follow
what they are driven to.
"""

from collections.abc import Callable, Iterator

import numpy as np

from equipoise.app.bench.check_result import CheckResult
from equipoise.app.bench.device_check import actuators_answer, devices_follow
from equipoise.app.bench.emulation import hardware_of
from equipoise.app.bench.open_bench import keeper_of
from equipoise.app.bench.port_check import unreachable
from equipoise.assessment.findings.record_findings import findings
from equipoise.hardware.bench.bench_controller import Keeper
from equipoise.hardware.bench.open_port import open_port
from equipoise.hardware.bench.real_bench import RealBench
from equipoise.hardware.bench.wall_clock import WallClock
from equipoise.hardware.transport.reconnecting_port import Opener
from equipoise.maths.attitude import tilt
from equipoise.model.errors import BenchStopped, EquipoiseError
from equipoise.model.reasons.finding_reasons import FindingReason
from equipoise.model.recording import Recording
from equipoise.model.testbed import SlidingMass, Testbed
from equipoise.model.units import DEG, MM

A_LITTLE = 1e-3  # m: out and back
UPSIDE = 90.0  # deg, chosen: no bench lets a platform tilt so far
SLOW = 0.7  # of the stated rate of rows, chosen: below it a sensor is slower than stated
ARRIVAL = " Times are those of arrival here; time stamps of the sensor itself would be even."
LISTED = "; `equipoise devices` lists serial ports"
ARRIVE, MEASUREMENT = 1.0, 0.05  # s, chosen: beyond the time that the way takes; between readings


def checked_bench(
    testbed: Testbed, streamed: float, agreed: Callable[[str], bool], opener: Opener = open_port
) -> Iterator[CheckResult]:
    """Return what each device says; ``agreed`` asks a person before masses move."""
    missing = unreachable(hardware_of(testbed))
    if missing:
        yield from (CheckResult(False, f"{sentence}{LISTED}") for sentence in missing)
        return
    keeper = keeper_of(testbed, opener)
    bench = RealBench(keeper, WallClock())
    try:
        yield from _started(keeper, bench, agreed)
        if keeper.links.sensors:
            bench.watch()
            recording = bench.read(streamed)
            yield from _streams(keeper, recording, streamed)
            yield from frame_results(keeper, recording)
        else:
            yield CheckResult(True, "no sensor is declared: nothing to stream")
        if keeper.links.ready:
            moved = keeper.links.positions
            for mass in (each for each in testbed.masses if each.name in moved):
                yield from _moved(bench, keeper, mass, agreed)
            yield from devices_follow(bench, keeper, agreed)
    except EquipoiseError as error:
        yield CheckResult(False, f"{error}")
    finally:
        keeper.close()


def _started(
    keeper: Keeper, bench: RealBench, agreed: Callable[[str], bool]
) -> Iterator[CheckResult]:
    if keeper.links.boards and not agreed("The masses will go home. Is their way free?"):
        yield CheckResult(False, "masses stay where they are; their position is unknown")
        return
    bench.start()
    for link in keeper.links.boards:
        names = ", ".join(axis.mass for axis in link.board.axes)
        yield CheckResult(
            True, f"board {link.board.name}: answers, settings agree, {names} at home"
        )
        for remark in link.driver.remarks:
            yield CheckResult(False, f"board {link.board.name}: {remark.sentence}")
    yield from actuators_answer(keeper.links.actuators)


def _streams(keeper: Keeper, recording: Recording, streamed: float) -> Iterator[CheckResult]:
    """Report for each sensor how many rows came, what was wrong with them, how its clock goes."""
    for link in keeper.links.sensors:
        for channel in link.unit.gives:
            rows = recording.attitude if channel == "attitude" else recording.rate
            stated = keeper.testbed.attitude if channel == "attitude" else keeper.testbed.gyro
            count = 0 if rows is None else len(rows)
            wanted = 0.0 if stated is None else stated.rate * streamed
            text = f"sensor {link.unit.name}: {count} rows of {channel} in {streamed:g} s"
            slow = count < SLOW * wanted
            yield CheckResult(not slow, f"{text}, {wanted:.0f} are stated" if slow else text)
        health = link.health
        hint = "; check cable and baud rate" if health.counts.corrupt else ""
        yield CheckResult(not health.wrong, health.sentence + hint)


def frame_results(keeper: Keeper, recording: Recording) -> Iterator[CheckResult]:
    """Report whether the platform is upright, and what else its rows show to be wrong.

    Rows without stamps of their device are stamped as they arrive: how evenly they do is said, and
    is no fault of a device.
    """
    testbed, stamped = keeper.testbed, any(link.clocks for link in keeper.links.sensors)
    if recording.attitude is not None:
        leaning = float(np.median(tilt(recording.attitude.values, testbed.up))) / DEG
        text = f"the axis that should point up is {leaning:.1f} deg from up"
        wrong = "; check alignment and laboratory in [[hardware.sensor]]"
        yield CheckResult(leaning < UPSIDE, text + ("" if leaning < UPSIDE else wrong))
    for finding in findings(recording, testbed):
        if finding.kind in ("problem", "wrong"):
            arrival = finding.code is FindingReason.UNEVEN_INTERVALS and not stamped
            yield CheckResult(arrival, finding.sentence + (ARRIVAL if arrival else ""))


def _moved(
    bench: RealBench, keeper: Keeper, mass: SlidingMass, agreed: Callable[[str], bool]
) -> Iterator[CheckResult]:
    """Move a mass out and back, and report whether its board says that it went."""
    if not agreed(f"Move mass {mass.name} by {A_LITTLE / MM:g} mm and back?"):
        yield CheckResult(True, f"mass {mass.name}: not moved")
        return
    way = A_LITTLE if mass.travel[1] >= A_LITTLE else -A_LITTLE
    for goal in (way, 0.0):
        bench.move({mass.name: goal})
        latest = bench.time + A_LITTLE / mass.speed + ARRIVE
        while not keeper.links.ready and bench.time < latest:
            bench.read(MEASUREMENT)
        at = keeper.links.positions[mass.name]
        if abs(at - goal) > A_LITTLE / 2:
            found = f"sent to {goal / MM:g} mm, its board reports {at / MM:.2f} mm"
            raise BenchStopped(f"mass {mass.name}: {found}")
    yield CheckResult(
        True, f"mass {mass.name}: moved 1 mm and back, as its board reports; check it by eye"
    )
