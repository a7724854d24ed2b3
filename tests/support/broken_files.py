"""A reader of recordings, with a file that is changed again and again."""

from collections.abc import Callable
from pathlib import Path

import numpy as np

from equipoise.io.recording.recording_file import read_recording
from equipoise.model.errors import InputError
from tests.support.mutated_bytes import mutated


def as_they_are(content: bytes) -> bytes:
    return content


def times_refused(
    valid: bytes,
    path: Path,
    trials: int,
    packed: Callable[[bytes], bytes] = as_they_are,
) -> int:
    """Return how often a file of changed bytes is refused.

    ``packed`` makes the file of the changed bytes. The reader raises nothing else.
    """
    rng, refused = np.random.default_rng(1), 0
    for _ in range(trials):
        path.write_bytes(packed(mutated(valid, rng)))
        try:
            read_recording(path)
        except InputError:
            refused += 1
    return refused
