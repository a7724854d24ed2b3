"""A start from which a simulated platform meets no stop, where there is one.

What the seed draws may swing too far: a platform that hangs 20 deg aside and is let go level swings
to 40 deg. Then it is let go nearer to where it hangs, step by step, as a person would:

    q = q0 exp(v - u),    v the shortest turn by which r comes to point down
    u                     along v, by shares of the angle that the stop leaves beyond where it hangs

A platform that hangs beyond its stop, or stands above P, meets it from any start; it is let go as
drawn. So it is where the testbed's [truth] gives the attitude.
"""

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import TypeVar

import numpy as np

from equipoise.maths.attitude import exponential, multiply, tilt, to_euler321, to_matrix
from equipoise.model.arrays import Quaternion, Vector3
from equipoise.model.testbed import Testbed
from equipoise.simulation.bench import SimulatedBench
from equipoise.simulation.draw_truth import own_truth

SHARES = (0.9, 0.6, 0.3, 0.0)  # of the angle between where it hangs and the stop, chosen
Done = TypeVar("Done")


def freely(
    testbed: Testbed, seed: int, act: Callable[[SimulatedBench], Done]
) -> tuple[SimulatedBench, Done]:
    """Return a bench and what came of acting on it: without a touch of the stop if that can be."""
    first = SimulatedBench(testbed, seed)
    done = act(first)
    for started in () if not first.touches else nearer(testbed, first):
        bench = SimulatedBench(started, seed)
        tried = act(bench)
        if not bench.touches:
            return bench, tried
    return first, done


def nearer(testbed: Testbed, bench: SimulatedBench) -> Iterator[Testbed]:
    """Yield the testbed, let go nearer and nearer to where the bench's platform hangs."""
    truth, drawn = testbed.truth or own_truth(testbed), bench.platform
    turn = turn_down(drawn.attitude, drawn.body.com)
    swing = float(np.linalg.norm(turn))
    left = testbed.tilt_limit - float(tilt(multiply(drawn.attitude, exponential(turn)), testbed.up))
    if truth.attitude is not None or left <= 0:
        return
    for share in SHARES:
        way = 1.0 - min(share * left / swing, 1.0)
        q = multiply(drawn.attitude, exponential(way * turn))
        euler = np.array([float(angle) for angle in to_euler321(q)])
        yield replace(testbed, truth=replace(truth, attitude=euler))


def turn_down(q: Quaternion, com: Vector3) -> Vector3:
    """Return the shortest turn (rad, body axes) after which the centre of mass points down."""
    down = -to_matrix(q)[2]
    across = np.cross(com, down)
    sine, cosine = float(np.linalg.norm(across)), float(down @ com)
    return across * (np.arctan2(sine, cosine) / max(sine, 1e-300))
