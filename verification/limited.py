"""One piece of work within a limit of processor time and memory, in a process of its own.

Whatever the work does, its end is reported: a crash of the interpreter, memory beyond reason, or a
search that does not end are findings about the work, not the end of the check. Of answers that came
before the limit, none is lost.
"""

import resource
import signal
import time
import traceback
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from multiprocessing import get_context
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

MEMORY = 16 * 2**30  # bytes of address space, chosen: far above what a record needs
GRACE = 1.0  # s: the limit counts whole seconds


@dataclass(frozen=True, slots=True)
class Limited:
    """The answers that came, how long each took, and what stopped the work if anything did."""

    answers: tuple[Any, ...]
    seconds: tuple[float, ...]  # s of processor time for each answer, and since the last
    stopped: str  # empty: it came to its end


def _within(seconds: float) -> None:
    """Let this process have so much processor time more."""
    hard = resource.getrlimit(resource.RLIMIT_CPU)[1]
    limit = int(time.process_time() + seconds + GRACE)
    resource.setrlimit(resource.RLIMIT_CPU, (limit, hard))


def _place(error: Exception) -> str:
    """Return what was raised, and in which line."""
    last = traceback.extract_tb(error.__traceback__)[-1]
    return f"{type(error).__name__}: {error} ({Path(last.filename).name}:{last.lineno})"


def _run(pipe: Connection, work: Callable[[Any], Iterator[Any]], item: Any, limit: float) -> None:
    """Send each answer with its time, then what ended the work, with the time since the last."""
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    stopped = ""
    began = time.process_time()
    try:
        _within(limit)
        for answer in work(item):
            pipe.send((answer, time.process_time() - began))
            _within(limit)
            began = time.process_time()
    except Exception as error:  # what is counted here is whatever goes wrong
        stopped = _place(error)
    pipe.send((stopped, time.process_time() - began))


def _received(pipe: Connection) -> Iterator[tuple[Any, float]]:
    """Yield what is sent, until the other end is closed."""
    while True:
        try:
            yield pipe.recv()
        except EOFError:
            return


def limited(work: Callable[[Any], Iterator[Any]], item: Any, limit: float) -> Limited:
    """Return the answers of a generator, each of which may take ``limit`` s of processor time."""
    context = get_context("forkserver")
    context.set_forkserver_preload([work.__module__])  # heeded by the first call alone
    ours, theirs = context.Pipe(duplex=False)
    child = context.Process(target=_run, args=(theirs, work, item, limit))
    child.start()
    theirs.close()
    sent = list(_received(ours))
    child.join()
    if child.exitcode:
        late = child.exitcode == -signal.SIGXCPU
        why = f"no end within {limit:g} s" if late else f"exit code {child.exitcode}"
        sent.append((why, limit if late else 0.0))
    values, seconds = zip(*sent, strict=True)
    return Limited(values[:-1], seconds, values[-1])
