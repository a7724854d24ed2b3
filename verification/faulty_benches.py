"""A fault at a random moment of a balancing through emulated devices: what becomes of it?

It ends well in one of two ways. It balances all the same: the verdict passes and the truth is
within tolerance. Or it is not balanced and says why: the bench was stopped with the sentence that
belongs to the fault, or the verdict on fresh data fails. Either way masses stand within a second.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import numpy as np

from equipoise.app.runs.balancing import until_stopped
from equipoise.io.testbed.presets import read_preset
from equipoise.model.reasons.interlocks import Interlock
from equipoise.model.testbed import Testbed
from equipoise.model.verdict import VerdictOutcome
from equipoise.procedure.balancing.balance import BalanceOptions, balance
from tests.support.emulated_lab import Lab, lab, over_tcp
from tests.support.faulty_wire import covered, garbage, half, noisy, repeated, silent
from verification.line_faults import TILT, Fault, by_fault, endings, spoil, unplug
from verification.result import Result, Row, Spread, at_least, at_most, in_turn

OPTIONS = BalanceOptions()
LATEST = 25.0  # s after the platform is let go, chosen: as long as a balancing takes
SETTLED = 1.0  # s, within which masses stand when all is over
AFTER = 2.0  # s in which no mass may move after that
LOST_SENSOR = ("sensor imu", "sensor camera", Interlock.SILENCE, Interlock.NO_ROWS,
               Interlock.NOT_STREAMING, Interlock.NOT_MOVABLE)  # fmt: skip
LOST_BOARD = ("board masses", Interlock.FAULT, Interlock.POSITION_UNKNOWN,
              Interlock.NOT_ANSWERING)  # fmt: skip
# Grbl's lines bear no checksum.
MISHEARD = (*LOST_BOARD, Interlock.SPEED, Interlock.TRAVEL, Interlock.MISMATCH)

Strike = Callable[[Any, np.random.Generator], None]


@dataclass(frozen=True, slots=True)
class Run:
    """What became of one balancing."""

    seed: int
    fault: str
    ending: str  # balanced, failed, stopped
    good: bool
    sentence: str


def spoilt(where: str, how: Any, for_s: float = np.inf) -> Strike:
    """Return a fault of a wire, for so long."""
    return lambda found, _rng: spoil(found, getattr(found, where).wire, how, for_s)


def unplugged(where: str, for_s: float) -> Strike:
    """Return a plug that is pulled, and put back after so long."""
    return lambda found, _rng: unplug(found, getattr(found, where).wire, for_s)


def moved_in_part(share: float) -> Strike:
    """Return a motor that goes only a share of each way, and its board does not know."""

    def strike(found: Lab, rng: np.random.Generator) -> None:
        found.board.device.done[str(rng.choice(["x", "y", "z"]))] = share

    return strike


def of_board(name: str, *values: Any) -> Strike:
    """Return what somebody does to the board."""
    return lambda found, _rng: getattr(found.board.device, name)(*values)


def clock_jumps(found: Lab, rng: np.random.Generator) -> None:
    """Let the sensor's clock jump, forth or back."""
    found.imu.device.by = float(rng.choice([-5.0, 0.3, 1000.0]))


FAULTS = (
    Fault("IMU unplugged, put back after 3 s", unplugged("imu", 3.0), (*LOST_SENSOR, *TILT)),
    Fault("IMU unplugged for good", unplugged("imu", np.inf), LOST_SENSOR),
    Fault("board unplugged", unplugged("board", np.inf), LOST_BOARD),
    Fault("garbage from the IMU", spoilt("imu", garbage), LOST_SENSOR),
    Fault("garbage from the board", spoilt("board", garbage), MISHEARD),
    Fault("half lines from the IMU", spoilt("imu", half, 2.0), (*LOST_SENSOR, *TILT)),
    Fault("half lines from the board", spoilt("board", half), LOST_BOARD),
    Fault("noise on the IMU's line", spoilt("imu", noisy), (*LOST_SENSOR, *TILT)),
    Fault("noise on the board's line", spoilt("board", noisy), MISHEARD),
    Fault("IMU frozen", spoilt("imu", repeated), LOST_SENSOR),
    Fault("attitude hidden for 10 s", spoilt("imu", silent, 10.0), (*LOST_SENSOR, *TILT)),
    Fault("camera covered for 10 s", spoilt("imu", covered, 10.0), (*LOST_SENSOR, *TILT)),
    Fault("motor stuck", moved_in_part(0.0), TILT),
    Fault("motor slips", moved_in_part(0.7), TILT),
    Fault("board reset", of_board("press_reset"), LOST_BOARD),
    Fault("limit switch hit", of_board("hit_limit"), LOST_BOARD),
    Fault("board without power", of_board("switch", False), LOST_BOARD),
    Fault("the IMU's clock jumps", clock_jumps, TILT),
)


@cache
def bed_for(fault: str) -> Testbed:
    """Return a preset with the device that is struck; a clock is that of a sensor with stamps."""
    if "camera" in fault:
        return over_tcp(read_preset("sputnix"))
    bed = over_tcp(read_preset("nanosat"))
    if "clock" not in fault or bed.hardware is None:
        return bed
    (unit,) = bed.hardware.sensors
    columns = ("t_ms", "qw", "qx", "qy", "qz", "gx_deg_s", "gy_deg_s", "gz_deg_s")
    stamped = replace(unit, driver="lines", settings={"format": "csv", "columns": columns})
    return replace(bed, hardware=replace(bed.hardware, sensors=(stamped,)))


def struck(seed: int) -> Run:
    """Balance a platform to which one fault happens."""
    fault, rng = FAULTS[seed % len(FAULTS)], np.random.default_rng(seed)
    with lab(bed_for(fault.name), seed) as found:
        when = found.emulated.time + float(rng.uniform(0.0, LATEST))
        found.clock.at(when, lambda: fault.strike(found, rng))
        *_, last = until_stopped(found.bench, balance(found.bench, OPTIONS))
        platform = found.emulated.platform
        off = platform.truth().com - OPTIONS.target
        found.wait(SETTLED)
        at = platform.displacements.copy()
        found.wait(AFTER)
        stands = bool(np.all(platform.displacements == at))
    verdict, sentence = last.verdict, last.sentence
    assert verdict is not None
    halted = verdict.outcome is VerdictOutcome.HALTED
    ending = "stopped" if halted else "balanced" if verdict.passed else "failed"
    right = {
        "stopped": bool({verdict.code, *verdict.reasons[0].parameters} & set(fault.causes)),
        "balanced": bool(np.all(np.abs(off) <= OPTIONS.tolerance)),
        "failed": len(sentence) > 0,
    }[ending]
    return Run(seed, fault.name, ending, right and stands, sentence)


def measure(seeds: Sequence[int], spread: Spread = in_turn) -> Result:
    """Let one fault happen in each of as many balancings as there are seeds."""
    runs = spread(struck, seeds)
    claim = (
        "Preset nanosat through emulated Grbl and VN-100 over TCP, and sputnix with its camera "
        f"where that is the matter; one of {len(FAULTS)} faults happens at a random moment of the "
        f"first {LATEST:g} s. The run ends balanced, and truly so, or unbalanced in words that "
        f"belong to the fault; a second later no mass moves. {len(runs)} seeds."
    )
    shared = by_fault((run.fault, run.ending) for run in runs)
    odd = (f"Seed {r.seed}, {r.fault}, {r.ending}: {r.sentence}" for r in runs if not r.good)
    rows: tuple[Row, ...] = (
        at_least("recovered, or stopped in the right words", np.mean([r.good for r in runs]), 1.0,
                 ".1%"),
        at_most("passed and truly out of tolerance",
                sum(r.ending == "balanced" and not r.good for r in runs), 0, "d"),
    )  # fmt: skip
    return Result(
        "faulty_benches",
        claim,
        rows,
        (f"Endings: {endings(run.ending for run in runs)}.", *shared, *odd),
    )
