"""Is the platform beyond its tilt limit? Asked by every procedure after every look."""

import numpy as np

from equipoise.maths.attitude import tilt
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed


def tilted(recording: Recording, testbed: Testbed) -> bool:
    """Say whether the platform tilts beyond its limit; the median of three rows decides."""
    rows = recording.attitude
    if rows is None or not len(rows):
        return False
    return float(np.median(tilt(rows.values[-3:], testbed.up))) > testbed.tilt_limit
