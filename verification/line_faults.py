"""What goes wrong on the line between a program and a device, and how runs ended that it hit."""

from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np

from equipoise.model.reasons.interlocks import Interlock
from equipoise.model.reasons.verdict_reasons import VerdictReason
from tests.support.emulated_lab import Lab

# It may swing too far while rows are awaited, or where what drives it is lost.
TILT = (VerdictReason.TILTED, Interlock.TILT, Interlock.RATE)


@dataclass(frozen=True, slots=True)
class Fault:
    """Something that goes wrong, and why the bench may be stopped for it."""

    name: str
    strike: Callable[..., None]  # at a Lab, what is struck there, and chance
    causes: tuple[str, ...] = ()  # codes, or the device that is to blame


def spoil(found: Lab, wire: Any, how: Any, for_s: float = np.inf) -> None:
    """Let a wire garble, or lose, what it carries, for so long."""
    wire.spoil = how
    found.clock.at(found.emulated.time + for_s, lambda: setattr(wire, "spoil", None))


def unplug(found: Lab, wire: Any, for_s: float = np.inf) -> None:
    """Pull a plug, and put it back after so long."""
    wire.unplug()
    found.clock.at(found.emulated.time + for_s, wire.plug_in)


def endings(ended: Iterable[str]) -> str:
    """Return how often runs ended in which way."""
    return ", ".join(f"{count} {ending}" for ending, count in sorted(Counter(ended).items()))


def by_fault(pairs: Iterable[tuple[str, str]]) -> tuple[str, ...]:
    """Return a line for each fault of (fault, ending): how its runs ended."""
    found: dict[str, list[str]] = {}
    for fault, ending in pairs:
        found.setdefault(fault, []).append(ending)
    return tuple(f"{fault}: {endings(ended)}." for fault, ended in found.items())
