"""A whole recording of a simulated bench whose masses move at given times."""

from collections.abc import Mapping, Sequence

from equipoise.model.errors import InputError
from equipoise.model.recording import Recording, join
from equipoise.model.testbed import Testbed
from equipoise.simulation.bench import SimulatedBench

Moves = Sequence[tuple[float, Mapping[str, float]]]


def record(testbed: Testbed, duration: float, moves: Moves, seed: int) -> Recording:
    """Return ``duration`` seconds with masses sent to targets (m) at times (s) in order."""
    return recorded(SimulatedBench(testbed, seed), duration, moves)


def recorded(bench: SimulatedBench, duration: float, moves: Moves) -> Recording:
    """Return the same of a bench that has not been read yet."""
    recording = bench.read(0.0)
    for time, targets in moves:
        if not bench.time <= time <= duration:
            wanted = f"times in order, from 0 to {duration:g} s"
            raise InputError("moves", f"one at {time:g} s", wanted)
        recording = join(recording, bench.read(time - bench.time))
        bench.move(targets)
    return join(recording, bench.read(duration - bench.time))
