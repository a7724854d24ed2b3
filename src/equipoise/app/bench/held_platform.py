"""A platform that a person holds still before it is let go: what its sensors see meanwhile.

Caught on its way, it is led back at an even rate about one axis: from q0 to q1, with a share s of
the way left, it is at q1 exp(-s log(q0^-1 q1)).
"""

from dataclasses import replace

import numpy as np

from equipoise.maths.attitude import difference, exponential, multiply
from equipoise.model.arrays import Quaternion, Series1
from equipoise.model.recording import Recording, Samples
from equipoise.simulation.bench import SimulatedBench
from equipoise.simulation.camera_and_gyro import camera_rows, gyro_rows
from equipoise.simulation.clock import samples

RATE = 0.5  # rad/s, chosen: a hand's, slower than what stops a bench
LEAST = 1e-3  # s, chosen: that any way takes


class HeldPlatform:
    """Rows at the attitude at which it will be let go, with the sensors' noise.

    ``caught`` says where it was, and when (s); None: it has been held all the while.
    """

    def __init__(
        self, platform: SimulatedBench, caught: tuple[float, Quaternion] | None = None
    ) -> None:
        self._bed, self._truth = platform.testbed, platform.platform
        since, start = caught or (0.0, self._truth.attitude)
        self._way = difference(self._truth.attitude, start)  # rad
        self._takes = max(float(np.linalg.norm(self._way)) / RATE, LEAST)  # s
        self.still = since + self._takes  # s, from when on
        self._rng = np.random.default_rng(0)  # of no matter: nothing is estimated from these rows

    def read(self, after: float, until: float) -> Recording:
        """Return the rows in (after, until], s."""
        attitude = rate = None
        camera, gyro = self._bed.attitude, self._bed.gyro
        if camera is not None:
            t = samples(camera.rate, after, until)
            left = exponential(-self._share_left(t)[:, None] * self._way)
            q = multiply(self._truth.attitude, left)[:, None]
            attitude = Samples(t, camera_rows(q, camera, self._rng))
        if gyro is not None:
            t = samples(gyro.rate, after, until)
            w = np.where(self._share_left(t)[:, None] > 0, self._way / self._takes, 0.0)
            rows = gyro_rows(w[:, None], gyro, self._truth.truth.gyro_bias, self._rng)
            rate = Samples(t, rows)
        return Recording(attitude, rate)

    def _share_left(self, t: Series1) -> Series1:
        """Return what share of the way back is left at times (s)."""
        return np.clip((self.still - t) / self._takes, 0.0, 1.0)


def later(recording: Recording, by: float) -> Recording:
    """Return a recording's rows of sensors and devices at times greater by so much (s)."""

    def moved(channel: Samples | None) -> Samples | None:
        return None if channel is None else Samples(channel.t + by, channel.values)

    return replace(
        recording,
        attitude=moved(recording.attitude),
        rate=moved(recording.rate),
        devices=moved(recording.devices),
    )
