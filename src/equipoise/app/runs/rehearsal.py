"""A balancing on a simulated platform before the real one is let go.

What is compiled once is compiled now: a real platform does not wait for a compiler. And what is
known of the testbed is tried: a law that cannot balance it says so before anything moves.
"""

from collections import deque

from equipoise.app.runs.balancing import Goal, Limits, procedure
from equipoise.model.testbed import Testbed
from equipoise.model.verdict import Verdict
from equipoise.simulation.bench import SimulatedBench

SEED = 0


def practised(testbed: Testbed, goal: Goal, limits: Limits) -> Verdict | None:
    """Return the verdict on a simulated platform; None if the procedure ends without one."""
    steps = procedure(SimulatedBench(testbed, SEED), goal, limits)
    reported = (step.verdict for step in steps if step.verdict is not None)
    return next(iter(deque(reported, maxlen=1)), None)
