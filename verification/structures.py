"""Valid files taken apart, changed, put together: does one raise, take too much or too long?"""

import tempfile
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from tests.support.document_fuzz_targets import SHAKES as OF_DOCUMENTS
from tests.support.document_fuzz_targets import TARGETS as DOCUMENTS
from tests.support.file_fuzz_targets import TARGETS as FILES
from tests.support.fuzz_target import Target, folder
from tests.support.peak_memory import forget_peak, peak_mb
from tests.support.structured_bytes import REGULAR
from tests.support.structured_bytes import SHAKES as OF_FILES
from tests.support.watched_files import WATCHER
from verification.fuzz_batch import (
    REPORTED,
    SLOWEST,
    Found,
    Tried,
    note_on,
    take_valid,
    timed,
    together,
    tried_in,
)
from verification.result import Result, Row, Spread, at_most, in_turn

SHAKES = {**OF_FILES, **OF_DOCUMENTS}
TARGETS = tuple(each for each in (*FILES, *DOCUMENTS) if each.name in SHAKES)
SHARES = {"bag of ROS 2": 0.1, "MAT of version 7.3": 0.03, "Zstandard": 0.5, "gzip": 0.5}  # slow
MOST_MB = 1000.0  # that one input may take


@dataclass(frozen=True, slots=True)
class Watched:
    """What became of a batch, and what it did beside."""

    tried: Tried
    outside: tuple[str, ...]  # what was written elsewhere, or begun
    peak_mb: float  # of the process while it reads


def tried(seed: int) -> Watched:
    """Try a batch."""
    WATCHER.found.clear()
    peaks = list[float]()

    def watched(target: Target, content: bytes) -> Found:
        forget_peak()
        with WATCHER.watching(str(folder()), tempfile.gettempdir()):
            found = timed(target, content)
        peaks.append(peak_mb())
        return found

    of_batch = tried_in(seed, [(each, share_of(each)) for each in TARGETS], shaken, watched)
    return Watched(of_batch, tuple(WATCHER.found), max(peaks))


def shaken(target: Target, rng: np.random.Generator) -> bytes:
    """Return a valid file of a target's kind with its parts changed."""
    return SHAKES[target.name](target.valid(), rng)[:REGULAR]


def share_of(target: Target) -> float:
    """Return how often a kind of file is tried."""
    return SHARES.get(target.name, 1.0)


def measure(seeds: Sequence[int], spread: Spread = in_turn) -> Result:
    """Try a batch for each seed."""
    take_valid(TARGETS)
    batches = spread(tried, seeds)
    found = together([each.tried for each in batches])
    outside = [sentence for each in batches for sentence in each.outside]
    total = sum(found.inputs.values())
    rows: tuple[Row, ...] = (
        at_most(f"of {total} inputs raised what is not declared", len(found.raised), 0, "d"),
        at_most("files written elsewhere, programs or connections begun", len(outside), 0, "d"),
        at_most("slowest input, s of processor time", max(found.slowest.values()), SLOWEST),
        at_most("largest process, MB", max(each.peak_mb for each in batches), MOST_MB),
    )
    claim = (
        f"{len(TARGETS)} kinds of files, of at most 1 MB, are cut into rows and cells, keys and "
        "values, records, members or columns; some of these are changed, lost, repeated or put "
        "elsewhere, and the whole is written anew. Each is read, or refused with a remedy."
    )
    wrong = *found.raised[:REPORTED], *outside[:REPORTED], *found.late[:REPORTED]
    return Result("structures", claim, rows, (note_on(found), *wrong))
