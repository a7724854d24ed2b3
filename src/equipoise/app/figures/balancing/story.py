"""What a balancing found on its way, as figures show it beside the tracker's curve."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from equipoise.model.arrays import Series1, Series3, Vector3

Marked = tuple[float, Vector3, Vector3]  # s, m, m (one sd)


class Story(NamedTuple):
    """What stands beside the tracker's curve."""

    measurements: Sequence[Marked]
    target: Vector3  # m
    tolerance: Vector3  # m
    truth: tuple[Series1, Series3] | None  # s, m; where the simulated centre really was

    def off_target(self) -> "Story":
        """Return the same of the distance from the target."""
        measurements = [(t, com - self.target, sd) for t, com, sd in self.measurements]
        truth = None if self.truth is None else (self.truth[0], self.truth[1] - self.target)
        return Story(measurements, np.zeros(3), self.tolerance, truth)
