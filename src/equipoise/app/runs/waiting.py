"""How somebody waits for a run: at a terminal with signs of life, or quietly."""

from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, replace

from equipoise.app.engine.spread import IN_TURN, Report, Spread, uncounted
from equipoise.model.step import Step

Share = Callable[[float], None]


@dataclass(frozen=True, slots=True, eq=False)
class Waiting:
    """What goes on while steps, searches and many runs are awaited; texts say what is done."""

    steps: Callable[[Iterator[Step], str], Iterator[Step]]
    doing: Callable[[str], AbstractContextManager[None]]
    search: Callable[[str], AbstractContextManager[Share]]  # yields what takes the share done
    many: Callable[[str], AbstractContextManager[Report]]  # yields what takes how many are done
    spread: Spread = IN_TURN  # by what pieces are done that a step or a search consists of


def as_they_come(steps: Iterator[Step], _what: str) -> Iterator[Step]:
    """Return the steps as they are."""
    return steps


QUIET = Waiting(
    as_they_come,
    doing=lambda _what: nullcontext(),
    search=lambda _what: nullcontext(lambda _share: None),
    many=lambda _what: uncounted(),
)


def shown(steps: Iterator[Step], on_step: Callable[[Step], None] | None) -> Iterator[Step]:
    """Yield steps, each shown as it is done, if there is somebody to show it to."""
    for step in steps:
        if on_step is not None:
            on_step(step)
        yield step


def passing_on(on_step: Callable[[Step], None] | None) -> Waiting:
    """Return how to wait quietly, each step being passed on as it is done."""

    def passed_on(steps: Iterator[Step], _what: str) -> Iterator[Step]:
        return shown(steps, on_step)

    return replace(QUIET, steps=passed_on)
