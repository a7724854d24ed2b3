"""Several recordings of one platform by MuJoCo, each with a start, noise and moves of its own."""

from dataclasses import dataclass, replace

import numpy as np

from equipoise.estimation.joint.joint_estimate import Run
from equipoise.estimation.model_selection.reference_fit import modelled
from equipoise.estimation.output_error.trajectory import Params
from equipoise.maths.linalg import pack_symmetric
from equipoise.model.recording import Recording
from equipoise.model.testbed import AttitudeSensor, Testbed
from tests.oracle import mujoco_bench as oracle

MASS = 14.0  # kg


@dataclass(frozen=True, eq=False)
class PlatformRuns:
    """What was recorded, and the truth."""

    recordings: tuple[Recording, ...]
    testbed: Testbed
    truth: np.ndarray  # J_P (6) and com (3) of the first run

    def alone(self, params: Params | None = None) -> list[Run]:
        """Return each run surveyed by itself."""
        requested = Params() if params is None else params
        return [Run(r.source, "", *modelled(r, self.testbed, requested)) for r in self.recordings]


def platform_runs(
    seed: int,
    moves: tuple[bool, ...],
    shift: tuple[float, float, float] = (0.0, 0.0, 0.0),
    duration: float = 40.0,
) -> PlatformRuns:
    """Return runs in which masses move or not; before the last one, com is moved by ``shift``."""
    rng = np.random.default_rng(seed)
    platform = oracle.random_platform(rng, mass=MASS, masses_per_axis=1)
    camera = AttitudeSensor(5.0, np.deg2rad(0.2), plumb_sd=0.0)
    testbed, recordings = oracle.testbed_for(platform, rng, 0.10, camera), []
    for k, moved in enumerate(moves):
        q, rate = oracle._random_start(rng, np.deg2rad(rng.uniform(3.0, 8.0)))
        com = platform.com + np.array(shift) * (k == len(moves) - 1)
        own = replace(platform, q=q, rate=rate, com=com)
        schedule = oracle.random_schedule(rng, own, duration) if moved else ()
        log = oracle.sensor_log(oracle.simulate(own, schedule, duration), rng)
        recordings.append(replace(log, source=f"run {k + 1}"))
    truth = np.append(pack_symmetric(platform.inertia_P), platform.com)
    return PlatformRuns(tuple(recordings), testbed, truth)
