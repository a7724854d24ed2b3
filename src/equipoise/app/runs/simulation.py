"""A simulated platform: the bench that a balancing gets, and the recording of a free swing."""

from equipoise.model.manoeuvre import Manoeuvre
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed
from equipoise.simulation.bench import SimulatedBench
from equipoise.simulation.carried_out import bench_for, carried_out
from equipoise.simulation.record import Moves, recorded


def bench_of(testbed: Testbed, seed: int, manoeuvre: Manoeuvre | None = None) -> SimulatedBench:
    """Return the simulated platform, let go as planned if there is a manoeuvre."""
    if manoeuvre is None:
        return SimulatedBench(testbed, seed)
    return bench_for(testbed, manoeuvre, seed)


def free_swing(testbed: Testbed, duration: float, moves: Moves, seed: int) -> Recording:
    """Return ``duration`` seconds with masses sent to targets (m from home) at times (s)."""
    return recorded(bench_of(testbed, seed), duration, moves)


def planned_swing(testbed: Testbed, manoeuvre: Manoeuvre, seed: int) -> Recording:
    """Return what the simulated bench records of a manoeuvre."""
    return carried_out(bench_of(testbed, seed, manoeuvre), manoeuvre)
