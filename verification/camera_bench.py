"""Balancing the preset `sputnix` through real ports: emulated Grbl boards and a drawn camera.

Judged as on the simulated bench (``verification.balanced``).
"""

from collections.abc import Sequence
from dataclasses import replace

from equipoise.app.emulation import emulate
from equipoise.app.kept_bench import keeper_of
from equipoise.app.lockstep import LockstepClock
from equipoise.hardware.real_bench import RealBench
from equipoise.io.presets import read_preset
from equipoise.model.hardware import Port
from equipoise.model.testbed import Testbed
from equipoise.procedure.balance import balance
from verification.balanced import OPTIONS, Run, notes_of, rows_of
from verification.result import Result, Spread, in_turn


def over_tcp() -> Testbed:
    """Return the preset with its boards behind network bridges: no pauses of pseudo terminals."""
    bed = read_preset("sputnix")
    assert bed.hardware is not None
    boards = tuple(
        replace(board, port=Port(f"tcp:board:{k}")) for k, board in enumerate(bed.hardware.boards)
    )
    return replace(bed, hardware=replace(bed.hardware, boards=boards))


def balanced(seed: int) -> Run:
    """Balance the platform of one seed."""
    emulated = emulate(over_tcp(), seed)
    keeper = keeper_of(emulated.testbed())
    bench = RealBench(keeper, LockstepClock(emulated))
    try:
        bench.start()
        steps = list(balance(bench, OPTIONS))
        off = emulated.platform.truth().com - OPTIONS.target
        moves = sum(step.kind == "move" for step in steps)
        last = steps[-1].verdict
        seconds = emulated.platform.time
        return Run(seed, off, moves, seconds, last.passed, last.sure, steps[-1].sentence)
    finally:
        keeper.close()
        emulated.close()


def measure(seeds: Sequence[int], spread: Spread = in_turn) -> Result:
    """Return the result for seeds."""
    runs = spread(balanced, seeds)
    claim = (
        f"Preset sputnix through its real drivers: emulated Grbl boards and a drawn camera of "
        f"5 pictures a second, in lockstep, {len(runs)} seeds."
    )
    return Result("camera_bench", claim, rows_of(runs), notes_of(runs))
