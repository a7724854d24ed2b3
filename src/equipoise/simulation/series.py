"""A series of runs of one simulated platform: what it is like is drawn once, all else anew.

Run k (from 0) has the seed of the first plus k: start, noise, stops of the masses. What the
testbed's [truth] states of the start, and its events and faults, are the same in every run. The
first run is the one that its seed gives by itself.
"""

from dataclasses import replace

from equipoise.model.testbed import Testbed
from equipoise.simulation.bench import SimulatedBench
from equipoise.simulation.draw_truth import own_truth


def with_drawn_platform(testbed: Testbed, seed: int) -> Testbed:
    """Return the testbed whose simulated platform is the one that a seed draws."""
    body = SimulatedBench(testbed, seed).platform.body
    truth = testbed.truth or own_truth(testbed)
    return replace(testbed, truth=replace(truth, com=body.com, inertia_P=body.inertia_P))


def seeds_of(runs: int, seed: int) -> range:
    """Return the seed of each run."""
    return range(seed, seed + runs)
