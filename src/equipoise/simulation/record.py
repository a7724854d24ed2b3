"""A whole recording of a simulated bench whose masses move and devices work at given times."""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from equipoise.model.bench import Bench
from equipoise.model.errors import InputError
from equipoise.model.recording import Recording, join
from equipoise.model.testbed import Testbed
from equipoise.simulation.bench import SimulatedBench

Moves = Sequence[tuple[float, Mapping[str, float]]]


class Command(NamedTuple):
    """What a bench is commanded at a time (s): targets of masses (m), inputs of devices."""

    t: float
    targets: Mapping[str, float]
    inputs: Mapping[str, float]


def record(testbed: Testbed, duration: float, moves: Moves, seed: int) -> Recording:
    """Return ``duration`` seconds with masses sent to targets (m) at times (s) in order."""
    return recorded(SimulatedBench(testbed, seed), duration, moves)


def recorded(bench: Bench, duration: float, moves: Moves) -> Recording:
    """Return the same of a bench that has not been read yet."""
    return commanded(bench, duration, [Command(t, targets, {}) for t, targets in moves])


def commanded(bench: Bench, duration: float, commands: Sequence[Command]) -> Recording:
    """Return ``duration`` seconds of a fresh bench that gets these commands in order."""
    recording = bench.read(0.0)
    for command in commands:
        if not bench.time <= command.t <= duration:
            wanted = f"times in order, from 0 to {duration:g} s"
            raise InputError("moves", f"one at {command.t:g} s", wanted)
        recording = join(recording, bench.read(command.t - bench.time))
        if command.targets:
            bench.move(command.targets)
        if command.inputs:
            bench.drive(command.inputs)
    return join(recording, bench.read(duration - bench.time))
