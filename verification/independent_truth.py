"""Our equations of motion against MuJoCo's, masses moving: no line of code in common.

The oracle's displacements, at 1 kHz, go into our propagator; the attitudes are compared.
"""

from collections.abc import Sequence

import numpy as np

from equipoise.actuators.sliding_masses import mass_maps
from equipoise.dynamics.propagation import body_of, propagate
from equipoise.dynamics.timeline import timeline
from equipoise.maths.linalg import pack_symmetric
from equipoise.model.recording import Samples
from tests.oracle import mujoco_bench as oracle
from verification.result import Result, Spread, at_most, in_turn

SECONDS = 120.0
LIMIT = 5e-6  # rad


def greatest_angle(seed: int) -> tuple[float, float]:
    """Return the greatest angle (rad) between MuJoCo and us with a random platform, and the same
    with the masses taken to stay at home (which shows that the moves matter)."""
    rng = np.random.default_rng(seed)
    platform = oracle.random_platform(rng)
    run = oracle.simulate(platform, oracle.random_schedule(rng, platform, SECONDS), SECONDS)
    observed = run.t[::200]

    def ours(track: Samples | None) -> float:
        line = timeline(observed, np.zeros(0), track, len(platform.slides), 0.01)
        moment = platform.mass * platform.com
        inertia = pack_symmetric(platform.inertia_P)
        body = body_of(platform.mass, platform.gravity, inertia, moment)
        masses = oracle.testbed_for(platform, rng).masses
        motion = propagate(body, mass_maps(masses), line, platform.q, platform.rate)
        return float(oracle.angle_between(motion.q[line.attitude_node], run.q[::200]).max())

    return ours(Samples(run.t, run.displacement)), ours(None)


def measure(seeds: Sequence[int], spread: Spread = in_turn) -> Result:
    """Compare one random platform for each seed."""
    found = np.array(spread(greatest_angle, seeds))
    rows = [
        at_most(f"platform {seed}: greatest angle, rad", angle, LIMIT)
        for seed, angle in zip(seeds, found[:, 0], strict=True)
    ]
    claim = (
        f"Over {SECONDS:.0f} s, with masses moved on the way, the propagator agrees with MuJoCo "
        f"within {LIMIT:g} rad on {len(seeds)} random platforms of 4-40 kg."
    )
    note = (
        f"Without the moves the two would part by {np.degrees(found[:, 1].min()):.2g} deg or more."
    )
    return Result("independent_truth", claim, tuple(rows), (note,))
