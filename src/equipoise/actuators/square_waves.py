"""Square waves as the inputs that a bench is given, one after the other."""

from collections.abc import Sequence

import numpy as np

from equipoise.model.manoeuvre import SquareWave

HAIR = 1e-9  # of a period, chosen: a switch at time zero is the first input, not the second


def switchings(wave: SquareWave, duration: float) -> list[tuple[float, float]]:
    """Return when a wave gives its device another input, before ``duration``: s, and inputs."""
    halves = np.arange(
        np.ceil(2 * wave.phase + HAIR), 2 * (duration / wave.period + wave.phase) - HAIR
    )
    times = [0.0, *(0.5 * halves - wave.phase) * wave.period]
    first = 1.0 if np.floor(2 * wave.phase + HAIR) % 2 == 0 else -1.0
    return [(float(t), first * (-1) ** k * wave.amplitude) for k, t in enumerate(times)]


def inputs_along(
    waves: Sequence[SquareWave], duration: float
) -> list[tuple[float, dict[str, float]]]:
    """Return the inputs of devices and their times (s), in order of time."""
    found: dict[float, dict[str, float]] = {}
    for wave in waves:
        for t, value in switchings(wave, duration):
            found.setdefault(t, {})[wave.device] = value
    return sorted(found.items(), key=lambda pair: pair[0])
