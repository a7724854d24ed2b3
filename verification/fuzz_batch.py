"""Batches of inputs for parsers: what they raise that is not declared, and how long each takes."""

import faulthandler
import os
import sys
import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from tests.support.fuzz_target import Target

BATCH = 1000  # inputs to a seed
SLOWEST = 5.0  # s of processor time for one input; chosen: nobody waits longer for a sentence
HUNG = 300.0  # s, chosen: a process that takes so long for one input is ended, and all fails
SHOWN, REPORTED = 400, 20  # bytes of an input that is told; errors that are
Found = tuple[list[str], float]  # what an input raised that is not declared; s of processor time


@dataclass(frozen=True, slots=True)
class Tried:
    """What became of a batch, or of several."""

    inputs: dict[str, int]  # by target
    raised: tuple[str, ...]
    slowest: dict[str, float]  # s, by target
    late: tuple[str, ...]  # what took too long, with the seed that makes its batch again


def timed(target: Target, content: bytes) -> Found:
    """Return what ``raised_by`` does, and the processor time that it took with its processes."""
    begun = sum(os.times()[:4])
    faulthandler.dump_traceback_later(HUNG, exit=True, file=sys.__stderr__)
    try:
        return raised_by(target, content), sum(os.times()[:4]) - begun
    finally:
        faulthandler.cancel_dump_traceback_later()


def raised_by(target: Target, content: bytes) -> list[str]:
    """Return what an input raises that is not declared, as a sentence with its beginning."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            target.take(content)
    except Exception as error:  # whatever it is, it is told
        return [f"{target.name}: {error!r}; input {content[:SHOWN].hex()}"]
    return []


def tried_in(
    seed: int,
    shares: Sequence[tuple[Target, float]],
    made: Callable[[Target, np.random.Generator], bytes],
    take: Callable[[Target, bytes], Found] = timed,
) -> Tried:
    """Try a batch, targets by their shares; ``made`` makes an input for one."""
    rng, targets = np.random.default_rng(seed), [target for target, _ in shares]
    share = np.array([share for _, share in shares])
    inputs, slowest = dict.fromkeys(names(targets), 0), dict.fromkeys(names(targets), 0.0)
    raised, late = list[str](), list[str]()
    for k in rng.choice(len(targets), BATCH, p=share / share.sum()):
        target = targets[k]
        found, seconds = take(target, made(target, rng))
        raised += found
        late += [f"{target.name}: {seconds:.1f} s, seed {seed}"] if seconds > SLOWEST else []
        slowest[target.name] = max(slowest[target.name], seconds)
        inputs[target.name] += 1
    return Tried(inputs, tuple(raised), slowest, tuple(late))


def together(batches: Sequence[Tried]) -> Tried:
    """Return what became of all batches."""
    return Tried(
        {name: sum(each.inputs[name] for each in batches) for name in batches[0].inputs},
        tuple(sentence for each in batches for sentence in each.raised),
        {name: max(each.slowest[name] for each in batches) for name in batches[0].slowest},
        tuple(sentence for each in batches for sentence in each.late),
    )


def note_on(tried: Tried) -> str:
    """Return how many inputs each target had, and the slowest."""
    tries = (f"{name} {n} ({tried.slowest[name] * 1e3:.0f})" for name, n in tried.inputs.items())
    return f"Inputs of each, and the slowest of them in ms: {', '.join(tries)}."


def names(targets: Sequence[Target]) -> list[str]:
    """Return the names of targets."""
    return [each.name for each in targets]


def take_valid(targets: Sequence[Target]) -> None:
    """Let every target take what it understands: a check that refuses all would find nothing."""
    for target in targets:
        target.take(target.valid())
