"""One piece of work within a limit of processor time and memory, in a process of its own.

Whatever the work does, its end is told: a crash of the interpreter, memory beyond reason, or a
search that does not end are findings about the work, not the end of the check. Of answers that came
before the limit, none is lost.
"""

import resource
import signal
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from multiprocessing import get_context
from multiprocessing.connection import Connection
from typing import Any

MEMORY = 16 * 2**30  # bytes of address space, chosen: far above what a record needs
GRACE = 1.0  # s: the limit counts whole seconds


@dataclass(frozen=True, slots=True)
class Limited:
    """The answers that came, how long each took, and what stopped the work if anything did."""

    answers: tuple[Any, ...]
    seconds: tuple[float, ...]  # s of processor time for each answer
    stopped: str  # empty: it came to its end


def _within(seconds: float) -> None:
    """Let this process have so much processor time more."""
    hard = resource.getrlimit(resource.RLIMIT_CPU)[1]
    limit = int(time.process_time() + seconds + GRACE)
    resource.setrlimit(resource.RLIMIT_CPU, (limit, hard))


def _run(pipe: Connection, work: Callable[[Any], Iterator[Any]], item: Any, limit: float) -> None:
    """Send each answer with its time, then what ended the work."""
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    stopped = ""
    try:
        _within(limit)
        began = time.process_time()
        for answer in work(item):
            pipe.send((answer, time.process_time() - began))
            _within(limit)
            began = time.process_time()
    except Exception as error:  # what is counted here is whatever goes wrong
        stopped = f"{type(error).__name__}: {error}"
    pipe.send(stopped)


def limited(work: Callable[[Any], Iterator[Any]], item: Any, limit: float) -> Limited:
    """Return the answers of a generator, each of which may take ``limit`` s of processor time."""
    context = get_context("forkserver")
    ours, theirs = context.Pipe(duplex=False)
    child = context.Process(target=partial(_run, theirs, work, item, limit))
    child.start()
    theirs.close()
    answers: list[Any] = []
    seconds: list[float] = []
    stopped = None
    while stopped is None:
        try:
            received = ours.recv()
        except EOFError:
            child.join()
            late = child.exitcode == -signal.SIGXCPU
            stopped = f"no end within {limit:g} s" if late else f"exit code {child.exitcode}"
            break
        if isinstance(received, str):
            stopped = received
        else:
            answers.append(received[0])
            seconds.append(received[1])
    child.join()
    return Limited(tuple(answers), tuple(seconds), stopped)
