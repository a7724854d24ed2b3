"""Every balancing law on the reference table through ports, and faults of what it drives.

Each law drives emulated devices behind real ports, by the drivers that a laboratory's bench uses,
in lockstep: masses by a Grbl board, wheels, coils and jets by device lines, and in one more run
gyros instead of wheels. What is compared is no law with another (``laws`` does), but whether each
of them runs through ports as it runs in simulation: to its verdict, with nothing stopped by a
driver or an interlock. That a platform tips over is the law's own doing, in either: such an end
counts as halted, whether the law or the bench's tilt limit is the first to stop it.

Faults happen to the electronics of one kind of device, at a random moment while a law drives; the
laws are all those that drive any, laws of masses alone have ``faulty_benches``. Each run ends well
in one of two ways: the law goes on until a person stops it, or everything is stopped with the
reason that belongs to the fault. Either way no mass moves and no device is driven a second later.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from equipoise.app.runs.balancing import until_stopped
from equipoise.io.testbed.presets import read_preset
from equipoise.model.hardware import ActuatorUnit
from equipoise.model.reasons.interlocks import Interlock
from equipoise.model.step import Step
from equipoise.model.testbed import Testbed
from equipoise.model.units import UM
from equipoise.model.verdict import Verdict
from equipoise.procedure.balancing.balance import BalanceOptions
from equipoise.procedure.balancing.catalogue import CARDS, balanced_by
from equipoise.procedure.balancing.hold import FIRST_MOVES
from tests.support.emulated_lab import Lab, lab, over_tcp
from tests.support.faulty_wire import Late, garbage, half, noisy, repeated, silent
from tests.support.gyro_pyramid import pyramid
from verification.line_faults import TILT, Fault, by_fault, endings, spoil, unplug
from verification.result import Result, Row, Spread, at_least, in_turn

TARGET, TOLERANCE = np.zeros(3), np.array([2e-6, 2e-6, 3e-6])  # m, as ``laws`` has them
LONGEST = 600.0  # s
GYROS = "slew_and_measure, gyros"  # for wheels
DRIVEN = {  # a law: the electronics that it needs from its first seconds on
    "momentum_buildup": "wheels",
    "slew_and_measure": "wheels",
    "impulse_feedback": "valves",
    "planar_magnetic": "coils",
    "fully_actuated": "wheels",
    "parameter_adaptive": "wheels",
    GYROS: "gyros",
}
LATEST = 10.0  # s after the platform is let go, chosen: these laws drive from their first second on
OBSERVED = 8.0  # s after a fault, chosen: then a person ends the run, if nothing else has
SETTLED = 1.0  # s, within which all rests
AFTER = 1.0  # s in which nothing moves after that
LOST = (*(f"actuator {unit}" for unit in sorted({*DRIVEN.values()})), Interlock.DEVICE_FAULT)
ASTRAY = (*LOST, Interlock.NOT_FOLLOWING, Interlock.DEVICE_LIMIT)


class Ended(Exception):
    """A person ends the run."""


StrikeAt = Callable[[Lab, str, np.random.Generator], None]  # at which electronics


@dataclass(frozen=True, slots=True)
class LawOnPorts:
    """What one law came to."""

    law: str
    seed: int
    verdict: Verdict
    stopped: bool  # by a driver or an interlock, but for its tilt
    passed_falsely: bool
    left: float  # m, from the target, by the truth
    time: float  # s


@dataclass(frozen=True, slots=True)
class Struck:
    """What became of a law to whose devices a fault happened."""

    seed: int
    law: str
    fault: str
    ending: str  # went on, stopped
    good: bool
    sentence: str


def bed_for(law: str) -> Testbed:
    """Return the reference table behind ports; masses stand at home when its board begins."""
    bed = read_preset("reference-table")
    if law == GYROS:
        cmgs = pyramid(np.radians(54.7), 0.02, 1.0)
        bed = with_gyros(bed, tuple(replace(cmg, name=f"cmg_{k}") for k, cmg in enumerate(cmgs)))
    bed = over_tcp(bed)
    hardware = bed.hardware
    assert hardware is not None
    boards = tuple(replace(board, homing=False) for board in hardware.boards)
    return replace(bed, hardware=replace(hardware, boards=boards))


def with_gyros(bed: Testbed, cmgs: Any) -> Testbed:
    """Return the testbed with gyros for wheels, driven by the same electronics."""
    hardware = bed.hardware
    assert hardware is not None
    wheels, *others = hardware.actuators
    gyros = replace(wheels, name="gyros", drives=tuple(cmg.name for cmg in cmgs))
    hardware = replace(hardware, actuators=(gyros, *others))
    return replace(bed, wheels=(), cmgs=cmgs, hardware=hardware)


def options(longest: float = LONGEST) -> BalanceOptions:
    """Return what is wanted of every law."""
    return BalanceOptions(TARGET, TOLERANCE, FIRST_MOVES, longest)


def steps_of(law: str, found: Lab) -> Iterator[Step]:
    """Return the steps of a law on the bench of a lab."""
    return balanced_by(law.partition(",")[0], found.bench, options(), LONGEST)


def run_on_ports(task: tuple[str, int]) -> LawOnPorts:
    """Run a law on the platform of a seed."""
    law, seed = task
    with lab(bed_for(law), seed) as found:
        let_go = found.emulated.time
        *_, last = until_stopped(found.bench, steps_of(law, found))
        off = found.emulated.platform.truth().com - TARGET
        verdict = last.verdict
        assert verdict is not None
        tipped = bool(causes_of(verdict) & set(TILT))
        stopped = not tipped and any(kind == "interlock" for _, kind, _ in found.events)
        false = verdict.passed and not bool(np.all(np.abs(off) <= TOLERANCE))
        took, left = found.bench.time - let_go, float(np.linalg.norm(off))
    return LawOnPorts(law, seed, verdict, stopped, false, left, took)


def causes_of(verdict: Verdict) -> set[str]:
    """Return the code of a verdict, and what its first reason is about."""
    return {verdict.code, *verdict.reasons[0].parameters}


def spoilt(how: Any, for_s: float = np.inf) -> StrikeAt:
    """Return a fault of the line from the electronics, for so long."""
    return lambda found, unit, _rng: spoil(found, station_of(found, unit).wire, how, for_s)


def late(by: float) -> StrikeAt:
    """Return answers that come later by so much, s."""

    def strike(found: Lab, unit: str, _rng: np.random.Generator) -> None:
        station_of(found, unit).wire.spoil = Late(found.clock, by)

    return strike


def unplugged(for_s: float) -> StrikeAt:
    """Return a plug that is pulled, and put back after so long."""
    return lambda found, unit, _rng: unplug(found, station_of(found, unit).wire, for_s)


def deaf(found: Lab, unit: str, _rng: np.random.Generator) -> None:
    """Let nothing reach the electronics."""
    station_of(found, unit).wire.deaf = True


def done_in_part(share: float) -> StrikeAt:
    """Return devices of which one does only a share of what it is driven to."""

    def strike(found: Lab, unit: str, rng: np.random.Generator) -> None:
        (drives,) = (each.drives for each in units_of(found) if each.name == unit)
        station_of(found, unit).device.done[str(rng.choice(drives))] = share

    return strike


def of_electronics(what: str, *values: Any) -> StrikeAt:
    """Return what somebody does to the electronics."""

    def strike(found: Lab, unit: str, _rng: np.random.Generator) -> None:
        getattr(station_of(found, unit).device, what)(*values, found.emulated.time)

    return strike


def own_fault(found: Lab, unit: str, _rng: np.random.Generator) -> None:
    """Let the electronics find a fault of their own, and rest."""
    device = station_of(found, unit).device
    device.press_reset(found.emulated.time - 1.0)
    device.actuator.fault = 7


def units_of(found: Lab) -> Sequence[ActuatorUnit]:
    """Return what drives devices."""
    hardware = found.emulated.platform.testbed.hardware
    assert hardware is not None
    return hardware.actuators


def station_of(found: Lab, unit: str) -> Any:
    """Return emulated electronics with their wire."""
    names = [each.name for each in units_of(found)]
    return found.emulated.actuators[names.index(unit)]


FAULTS = (
    Fault("unplugged for good", unplugged(np.inf), LOST),
    Fault("unplugged, put back after 3 s", unplugged(3.0), LOST),
    Fault("its line is cut", spoilt(silent), LOST),
    Fault("silent for 0.3 s", spoilt(silent, 0.3), ()),
    Fault("half lines", spoilt(half), LOST),
    Fault("noise on its line", spoilt(noisy), LOST),
    Fault("garbage between its lines", spoilt(garbage), LOST),
    Fault("it says the same for ever", spoilt(repeated), LOST),
    Fault("answers 0.2 s late", late(0.2), LOST),
    Fault("answers 1 s late", late(1.0), LOST),
    Fault("nothing reaches it", deaf, LOST),
    Fault("a device is stuck", done_in_part(0.0), ASTRAY),
    Fault("a device goes the other way", done_in_part(-1.0), ASTRAY),
    Fault("reset", of_electronics("press_reset"), LOST),
    Fault("without power", of_electronics("switch", False), LOST),
    Fault("a fault of its own", own_fault, LOST),
)


def struck(seed: int) -> Struck:
    """Let a law drive, and one fault happen to what it drives."""
    fault, rng = FAULTS[seed % len(FAULTS)], np.random.default_rng(seed)
    law, unit = list(DRIVEN.items())[(seed // len(FAULTS)) % len(DRIVEN)]
    with lab(bed_for(law), seed) as found:
        when = found.emulated.time + float(rng.uniform(1.0, LATEST))
        found.clock.at(when, lambda: fault.strike(found, unit, rng))
        going = [law]
        found.clock.at(when + OBSERVED, lambda: end(going))
        verdict, sentence = worked(found, law)
        going.clear()
        found.wait(SETTLED)
        at = found.emulated.platform.displacements.copy()
        rested = found.at_rest
        found.wait(AFTER)
        rests = rested and found.at_rest
        stands = bool(np.all(found.emulated.platform.displacements == at))
    right = verdict is None or bool(causes_of(verdict) & {*fault.causes, *TILT})
    ending = "went on" if verdict is None else "stopped"
    return Struck(seed, law, fault.name, ending, right and rests and stands, sentence)


def worked(found: Lab, law: str) -> tuple[Verdict | None, str]:
    """Return the verdict of a law that was stopped, with its sentence; None: a person ended it."""
    try:
        *_, last = until_stopped(found.bench, steps_of(law, found))
    except Ended:
        found.bench.stop()
        return None, ""
    return last.verdict, last.sentence


def end(going: Sequence[str]) -> None:
    """End what goes on, as a person does."""
    if going:
        raise Ended


def law_rows(runs: Sequence[LawOnPorts]) -> list[Row]:
    """Return what each law came to."""
    rows: list[Row] = []
    for law in dict.fromkeys(run.law for run in runs):
        own = [run for run in runs if run.law == law]
        left = np.median([run.left for run in own]) / UM
        ending = endings(run.verdict.outcome.value for run in own)
        took = np.median([run.time for run in own])
        rows.append(Row(law, f"{ending}; {left:.2g} um left, {took:.0f} s", "", True))
    return rows


def measure(seeds: Sequence[int], spread: Spread = in_turn) -> Result:
    """Run every law on the platform of each seed."""
    laws = (*CARDS, GYROS)
    runs = list(spread(run_on_ports, [(law, seed + 1) for seed in seeds for law in laws]))
    well = float(np.mean([not run.stopped for run in runs]))
    false = sum(run.passed_falsely for run in runs)
    rows = (
        at_least("run to their verdict, nothing stopped but a platform that tips over", well, 1.0,
                 ".0%"),
        Row("passed and truly outside the tolerance", f"{false}", "0", false == 0),
        *law_rows(runs),
    )  # fmt: skip
    claim = (
        f"Preset reference-table through emulated Grbl, NatNet, a gyro's lines and device lines, "
        f"each behind a real port, in lockstep; every law, and slew_and_measure with four gyros "
        f"for wheels, target (0, 0, 0), 10 min at most, {len(seeds)} platforms."
    )
    return Result("laws_on_ports", claim, rows)


def measure_faults(seeds: Sequence[int], spread: Spread = in_turn) -> Result:
    """Let one fault happen in each of as many runs as there are seeds."""
    runs = list(spread(struck, seeds))
    odd = tuple(f"Seed {r.seed}, {r.fault}, {r.law}, {r.ending}: {r.sentence}"
                for r in runs if not r.good)  # fmt: skip
    notes = by_fault((run.fault, run.ending) for run in runs)
    rows = (
        at_least("went on, or stopped with the right reason, and at rest a second later",
                 float(np.mean([run.good for run in runs])), 1.0, ".1%"),
    )  # fmt: skip
    claim = (
        f"All laws that drive more than masses, on the preset reference-table through ports: "
        f"{'; '.join(DRIVEN)}. One of {len(FAULTS)} faults happens to the electronics of wheels, "
        f"gyros, coils or jets at a random moment of the first {LATEST:g} s; {OBSERVED:g} s later "
        f"a person ends what goes on. {len(seeds)} seeds."
    )
    return Result("faulty_devices", claim, rows, (*notes, *odd))
