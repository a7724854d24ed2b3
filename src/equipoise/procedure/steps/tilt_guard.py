"""Whether the platform is beyond its tilt limit: checked during and after every record."""

import numpy as np

from equipoise.maths.attitude import tilt
from equipoise.model.bench import Bench
from equipoise.model.recording import Recording, joined
from equipoise.model.testbed import Testbed

OFTEN = 1.0  # s, chosen: how often a long record is checked


def guarded(bench: Bench, duration: float) -> Recording:
    """Return a record of ``duration`` seconds, or up to where it tilts too far and is stopped."""
    parts, end = [bench.read(min(OFTEN, duration))], bench.time + duration - min(OFTEN, duration)
    while bench.time < end - 1e-9 and not tilted(parts[-1], bench.testbed):
        parts.append(bench.read(min(OFTEN, end - bench.time)))
    if tilted(parts[-1], bench.testbed):
        bench.stop()
    return joined(parts)


def tilted(recording: Recording, testbed: Testbed) -> bool:
    """Say whether the platform tilts beyond its limit; the median of three rows decides."""
    rows = recording.attitude
    if rows is None or not len(rows):
        return False
    return float(np.median(tilt(rows.values[-3:], testbed.up))) > testbed.tilt_limit
