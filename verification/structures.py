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
from verification.any_bytes import REPORTED, SLOWEST, late_in, picked, timed
from verification.result import Result, Row, Spread, at_most, in_turn

SHAKES = {**OF_FILES, **OF_DOCUMENTS}
TARGETS = tuple(each for each in (*FILES, *DOCUMENTS) if each.name in SHAKES)
SHARES = {"bag of ROS 2": 0.1, "MAT of version 7.3": 0.03, "Zstandard": 0.5, "gzip": 0.5}  # slow
MOST_MB = 1000.0  # that one input may take


@dataclass(frozen=True, slots=True)
class Tried:
    """What became of a batch."""

    inputs: dict[str, int]  # by target
    raised: tuple[str, ...]
    outside: tuple[str, ...]  # what was written elsewhere, or begun
    slowest: dict[str, float]  # s, by target
    late: tuple[str, ...]  # what took too long
    peak_mb: float  # of the process while it reads


def tried(seed: int) -> Tried:
    """Try a batch, targets by their shares."""
    rng = np.random.default_rng(seed)
    share = np.array([share_of(each) for each in TARGETS])
    inputs, raised, slowest = dict.fromkeys(names(), 0), list[str](), dict.fromkeys(names(), 0.0)
    late = list[str]()
    WATCHER.found.clear()
    peak = 0.0
    for target in picked(TARGETS, share, rng):
        content = SHAKES[target.name](target.valid(), rng)[:REGULAR]
        forget_peak()
        with WATCHER.watching(str(folder()), tempfile.gettempdir()):
            found, seconds = timed(target, content)
        raised += found
        slowest[target.name] = max(slowest[target.name], seconds)
        late += late_in(seed, target, seconds)
        inputs[target.name] += 1
        peak = max(peak, peak_mb())
    return Tried(inputs, tuple(raised), tuple(WATCHER.found), slowest, tuple(late), peak)


def share_of(target: Target) -> float:
    """Return how often a kind of file is tried."""
    return SHARES.get(target.name, 1.0)


def names() -> list[str]:
    """Return the names of all targets."""
    return [each.name for each in TARGETS]


def measure(seeds: Sequence[int], spread: Spread = in_turn) -> Result:
    """Try a batch for each seed."""
    for target in TARGETS:
        target.take(target.valid())
    batches = spread(tried, seeds)
    counts = {name: sum(each.inputs[name] for each in batches) for name in names()}
    slowest = {name: max(each.slowest[name] for each in batches) for name in names()}
    raised = [sentence for each in batches for sentence in each.raised]
    outside = [sentence for each in batches for sentence in each.outside]
    late = [sentence for each in batches for sentence in each.late]
    rows: tuple[Row, ...] = (
        at_most(
            f"of {sum(counts.values())} inputs raised what is not declared", len(raised), 0, "d"
        ),
        at_most("files written elsewhere, programs or connections begun", len(outside), 0, "d"),
        at_most("slowest input, s of processor time", max(slowest.values()), SLOWEST),
        at_most("largest process, MB", max(each.peak_mb for each in batches), MOST_MB),
    )
    claim = (
        f"{len(TARGETS)} kinds of files, of at most 1 MB, are cut into rows and cells, keys and "
        "values, records, members or columns; some of these are changed, lost, repeated or put "
        "elsewhere, and the whole is written anew. Each is read, or refused with a remedy."
    )
    tries = ", ".join(f"{name} {counts[name]} ({slowest[name] * 1e3:.0f})" for name in names())
    note = f"Inputs of each, and the slowest of them in ms: {tries}."
    wrong = *raised[:REPORTED], *outside[:REPORTED], *late[:REPORTED]
    return Result("structures", claim, rows, (note, *wrong))
