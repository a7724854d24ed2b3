"""Whether the platform has tilted to its limit: checked during and after every record."""

import numpy as np

from equipoise.model.bench import Bench
from equipoise.model.recording import Recording, joined
from equipoise.model.testbed import Testbed
from equipoise.sensors.at_stop import at_stop

OFTEN = 1.0  # s, chosen: how often a long record is checked


def guarded(bench: Bench, duration: float) -> Recording:
    """Return a record of ``duration`` seconds, or up to where it tilts too far and is stopped."""
    parts, end = [bench.read(min(OFTEN, duration))], bench.time + duration - min(OFTEN, duration)
    while bench.time < end - 1e-9 and not tilted(parts[-1], bench.testbed):
        parts.append(bench.read(min(OFTEN, end - bench.time)))
    if tilted(parts[-1], bench.testbed):
        bench.stop()
    return joined(parts)


def tilted(recording: Recording, testbed: Testbed, since: float = -np.inf) -> bool:
    """Say whether the platform has tilted to its limit since a time (s).

    Its stop has pushed it then: no estimate across that is to be relied on.
    """
    rows = recording.attitude
    return rows is not None and bool(at_stop(rows.where(rows.t >= since), testbed).any())
