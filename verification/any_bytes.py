"""Inputs with something wrong in them, for every parser: does one raise, or take too long?"""

import faulthandler
import os
import sys
import warnings
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tests.support.driver_fuzz_targets import TARGETS as DEVICES
from tests.support.file_fuzz_targets import TARGETS as FILES
from tests.support.fuzz_target import Target
from tests.support.mutated_bytes import mutated
from verification.result import Result, Row, Spread, at_most, in_turn

TARGETS = (*DEVICES, *FILES)
BATCH = 1000  # inputs to a seed
SLOWEST = 5.0  # s of processor time for one input; chosen: nobody waits longer for a sentence
HUNG = 300.0  # s, chosen: a process that takes so long for one input is ended, and all fails
SHOWN, REPORTED = 400, 20  # bytes of an input that is told; errors that are


@dataclass(frozen=True, slots=True)
class Tried:
    """What became of a batch."""

    inputs: dict[str, int]  # by target
    raised: tuple[str, ...]
    slowest: dict[str, float]  # s, by target
    late: tuple[str, ...]  # what took too long


def tried(seed: int) -> Tried:
    """Try a batch, targets by their shares."""
    rng = np.random.default_rng(seed)
    share = np.array([each.share for each in TARGETS])
    inputs, raised, slowest = dict.fromkeys(names(), 0), [], dict.fromkeys(names(), 0.0)
    late = list[str]()
    for target in picked(TARGETS, share, rng):
        content = mutated(target.valid(), rng)
        found, seconds = timed(target, content)
        raised += found
        late += late_in(seed, target, seconds)
        slowest[target.name] = max(slowest[target.name], seconds)
        inputs[target.name] += 1
    return Tried(inputs, tuple(raised), slowest, tuple(late))


def picked(
    targets: Sequence[Target], share: NDArray[np.float64], rng: np.random.Generator
) -> Iterator[Target]:
    """Yield the targets of a batch, by their shares."""
    return (targets[k] for k in rng.choice(len(targets), BATCH, p=share / share.sum()))


def names() -> list[str]:
    """Return the names of all targets."""
    return [each.name for each in TARGETS]


def timed(target: Target, content: bytes) -> tuple[list[str], float]:
    """Return what ``raised_by`` does, and the processor time that it took with its processes."""
    begun = sum(os.times()[:4])
    faulthandler.dump_traceback_later(HUNG, exit=True, file=sys.__stderr__)
    try:
        return raised_by(target, content), sum(os.times()[:4]) - begun
    finally:
        faulthandler.cancel_dump_traceback_later()


def late_in(seed: int, target: Target, seconds: float) -> list[str]:
    """Return a sentence on an input of a batch that took too long, which its seed makes again."""
    return [f"{target.name}: {seconds:.1f} s, seed {seed}"] if seconds > SLOWEST else []


def raised_by(target: Target, content: bytes) -> list[str]:
    """Return what an input raises that is not declared, as a sentence with its beginning."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            target.take(content)
    except Exception as error:  # whatever it is, it is told
        return [f"{target.name}: {error!r}; input {content[:SHOWN].hex()}"]
    return []


def measure(seeds: Sequence[int], spread: Spread = in_turn) -> Result:
    """Try a batch for each seed."""
    for target in TARGETS:
        target.take(target.valid())
    batches = spread(tried, seeds)
    counts = {name: sum(each.inputs[name] for each in batches) for name in names()}
    slowest = {name: max(each.slowest[name] for each in batches) for name in names()}
    total = sum(counts.values())
    raised = [sentence for each in batches for sentence in each.raised]
    late = [sentence for each in batches for sentence in each.late]
    rows: tuple[Row, ...] = (
        at_most(f"of {total} inputs raised what is not declared", len(raised), 0, "d"),
        at_most("slowest input, s of processor time", max(slowest.values()), SLOWEST),
    )
    claim = (
        f"{len(TARGETS)} parsers of files and drivers are given valid bytes with one to four "
        "changes, or junk; tables as people have them are read by column maps that are drawn. "
        "Nothing but the declared error comes out."
    )
    tries = ", ".join(f"{name} {counts[name]} ({slowest[name] * 1e3:.0f})" for name in names())
    note = f"Inputs to each, and the slowest of them in ms: {tries}."
    return Result("any_bytes", claim, rows, (note, *raised[:REPORTED], *late[:REPORTED]))
