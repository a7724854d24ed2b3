"""Inputs with something wrong in them, for every parser: does one raise, or take too long?"""

from collections.abc import Sequence

import numpy as np

from tests.support.driver_fuzz_targets import TARGETS as DEVICES
from tests.support.file_fuzz_targets import TARGETS as FILES
from tests.support.fuzz_target import Target
from tests.support.mutated_bytes import mutated
from verification.fuzz_batch import (
    REPORTED,
    SLOWEST,
    Tried,
    note_on,
    take_valid,
    together,
    tried_in,
)
from verification.result import Result, Row, Spread, at_most, in_turn

TARGETS = (*DEVICES, *FILES)


def tried(seed: int) -> Tried:
    """Try a batch."""
    return tried_in(seed, [(each, each.share) for each in TARGETS], changed)


def changed(target: Target, rng: np.random.Generator) -> bytes:
    """Return bytes that a target understands, with something wrong in them."""
    return mutated(target.valid(), rng)


def measure(seeds: Sequence[int], spread: Spread = in_turn) -> Result:
    """Try a batch for each seed."""
    take_valid(TARGETS)
    found = together(spread(tried, seeds))
    total = sum(found.inputs.values())
    rows: tuple[Row, ...] = (
        at_most(f"of {total} inputs raised what is not declared", len(found.raised), 0, "d"),
        at_most("slowest input, s of processor time", max(found.slowest.values()), SLOWEST),
    )
    claim = (
        f"{len(TARGETS)} parsers of files and drivers are given valid bytes with one to four "
        "changes, or junk; tables as people have them are read by column maps that are drawn. "
        "Nothing but the declared error comes out."
    )
    wrong = *found.raised[:REPORTED], *found.late[:REPORTED]
    return Result("any_bytes", claim, rows, (note_on(found), *wrong))
