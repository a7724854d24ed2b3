"""A platform that a person holds still before it is let go: what its sensors see meanwhile."""

from dataclasses import replace

import numpy as np

from equipoise.model.recording import Recording, Samples
from equipoise.simulation.bench import SimulatedBench
from equipoise.simulation.camera_and_gyro import camera_rows, gyro_rows
from equipoise.simulation.clock import samples


class HeldPlatform:
    """Rows at the attitude at which it will be let go, with the sensors' noise."""

    def __init__(self, platform: SimulatedBench) -> None:
        self._bed, self._truth = platform.testbed, platform.platform
        self._rng = np.random.default_rng(0)  # of no matter: nothing is estimated from these rows

    def read(self, after: float, until: float) -> Recording:
        """Return the rows in (after, until], s."""
        attitude = rate = None
        camera, gyro = self._bed.attitude, self._bed.gyro
        if camera is not None:
            t = samples(camera.rate, after, until)
            q = np.tile(self._truth.attitude, (len(t), 1, 1))
            attitude = Samples(t, camera_rows(q, camera, self._rng))
        if gyro is not None:
            t = samples(gyro.rate, after, until)
            rows = gyro_rows(np.zeros((len(t), 1, 3)), gyro, self._truth.gyro_bias, self._rng)
            rate = Samples(t, rows)
        return Recording(attitude, rate)


def later(recording: Recording, by: float) -> Recording:
    """Return a recording's sensor rows at times that are greater by so much (s)."""

    def moved(channel: Samples | None) -> Samples | None:
        return None if channel is None else Samples(channel.t + by, channel.values)

    return replace(recording, attitude=moved(recording.attitude), rate=moved(recording.rate))
