"""The rows of a platform as a sensor measures them, those of one time together."""

from collections.abc import Sequence

from equipoise.hardware.links.frame_transform import as_sensed
from equipoise.model.arrays import Floats
from equipoise.model.hardware import Gives, SensorUnit
from equipoise.model.recording import Recording


def sensed_rows(unit: SensorUnit, rows: Recording) -> Sequence[tuple[float, dict[Gives, Floats]]]:
    """Return each time (s), in order, with the rows of the unit's channels in the unit's axes."""
    found: dict[float, dict[Gives, Floats]] = {}
    for channel in ("attitude", "rate"):
        samples = rows.attitude if channel == "attitude" else rows.rate
        if samples is not None and channel in unit.gives:
            sensed = as_sensed(unit, channel, samples.values)
            for t, row in zip(samples.t, sensed, strict=True):
                found.setdefault(float(t), {})[channel] = row
    return sorted(found.items())
