"""Balancing through emulated devices, their real protocols and ports between, from random starts.

The same numbers as of the simulated bench (``balanced``), on the same random platforms. What the
simulated bench lets swing beyond its tilt limit is stopped here, and counts as not balanced.
"""

from collections.abc import Callable, Sequence
from functools import partial

from equipoise.app.runs.balancing import until_stopped
from equipoise.io.testbed.presets import read_preset
from equipoise.procedure.balancing.balance import balance
from tests.support.emulated_lab import lab, over_tcp
from verification.balanced import OPTIONS, Run, notes_of, rows_of
from verification.result import Result, Spread, in_turn


def balanced_through(preset: str, seed: int) -> Run:
    """Balance the platform of one seed through its preset's emulated devices."""
    with lab(over_tcp(read_preset(preset)), seed) as found:
        let_go = found.emulated.time
        steps = list(until_stopped(found.bench, balance(found.bench, OPTIONS)))
        off = found.emulated.platform.truth().com - OPTIONS.target
        seconds = found.bench.time - let_go
    moves, last = sum(step.kind == "move" for step in steps), steps[-1].verdict
    assert last is not None
    return Run(seed, off, moves, seconds, last.outcome, steps[-1].sentence)


def of(preset: str, devices: str) -> Callable[[Sequence[int], Spread], Result]:
    """Return the check of a preset."""

    def measure(seeds: Sequence[int], spread: Spread = in_turn) -> Result:
        """Balance one random platform for each seed."""
        runs = spread(partial(balanced_through, preset), seeds)
        claim = (
            f"Preset {preset} through emulated {devices}, each behind a real port, in lockstep; "
            f"target (0, 0, -100) um, {len(runs)} seeds."
        )
        return Result(f"emulated_{preset}", claim, rows_of(runs), notes_of(runs))

    return measure
