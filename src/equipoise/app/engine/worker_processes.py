"""Processes of this computer, each with one thread of linear algebra.

Libraries of linear algebra start a thread for each core, in each process: with as many processes
as cores they would stand in each other's way. They read the number from the environment when they
are loaded, so it is there while a process starts.

A process ends with the program that started it, however that ends, and leaves Ctrl-C to it.
"""

import os
import signal
from collections.abc import Generator
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from multiprocessing import active_children, parent_process
from multiprocessing.context import SpawnContext, SpawnProcess
from threading import Thread

from equipoise.app.engine.pool import Pool

LIMITS = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS")
ONE_THREAD: dict[str, str] = dict.fromkeys(LIMITS, "1")
ORPHANED = 70  # exit code that nobody reads


class OneThreadProcess(SpawnProcess):
    """A process whose libraries of linear algebra use one thread."""

    def start(self) -> None:
        """Start it in an environment that says so."""
        before = {name: os.environ.get(name) for name in ONE_THREAD}
        os.environ.update(ONE_THREAD)
        try:
            super().start()
        finally:
            for name, value in before.items():
                if value is None:
                    del os.environ[name]
                else:
                    os.environ[name] = value


class OneThreadContext(SpawnContext):
    """What starts such processes."""

    Process = OneThreadProcess


def begin_worker() -> None:
    """Leave Ctrl-C to the program that started this process, and end when it is gone.

    A signal that is ignored would be ignored in all programs that are started from here, too.
    """
    signal.signal(signal.SIGINT, lambda _number, _frame: None)
    Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    parent = parent_process()
    if parent is not None:
        parent.join()
        os._exit(ORPHANED)


@contextmanager
def worker_processes(count: int) -> Generator[Pool]:
    """Lend so many processes, which start with the first work; an error here ends them at once."""
    others = set(active_children())
    executor = ProcessPoolExecutor(count, OneThreadContext(), begin_worker)
    try:
        yield Pool(executor, lambda: count)
    except BaseException:
        for process in set(active_children()) - others:
            process.terminate()
        executor.shutdown(cancel_futures=True)
        raise
    executor.shutdown()
