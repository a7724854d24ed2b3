"""The rows of a track of masses that say when and how they travelled.

A record that grows has a row for every look while all masses stand. What a travel leaves open
(``mass_errors``) is in the rows about it, and each stand is as long as the next travel is away: rows
with nothing but standing around them add nothing, and neither does the last one.
"""

from functools import lru_cache

import numpy as np

from equipoise.model.arrays import Floats
from equipoise.model.recording import Samples

KEPT = 4  # rows to either side of a change, chosen: what belongs to a travel looks at two


def changing_rows(track: Samples) -> Samples:
    """Return the first row and those near a change; tracks with the same such rows, the same one.

    So what is kept by identity of a track is kept while masses stand.
    """
    changed = np.any(track.values[1:] != track.values[:-1], axis=1)
    changes, row = np.append(0, np.cumsum(changed)), np.arange(len(track))
    ahead, behind = np.minimum(row + KEPT, row[-1]), np.maximum(row - KEPT, 0)
    rows = track.where((changes[ahead] > changes[behind]) | (row == 0))
    return _one_of(rows.t.tobytes(), rows.values.tobytes(), rows.values.shape[1])


@lru_cache(maxsize=4)
def _one_of(t: bytes, values: bytes, columns: int) -> Samples:
    found: Floats = np.frombuffer(values).reshape(-1, columns)
    return Samples(np.frombuffer(t), found)
