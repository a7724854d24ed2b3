"""Time and memory of a piece of work.

Time is the processor's, so that other work on the machine does not count. Memory is the peak of
what Python and NumPy allocate meanwhile (``tracemalloc``), which slows the work down: it is watched
in a run of its own, before the timed one. What a process holds (``ru_maxrss``) would mostly be
libraries and compiled kernels, the same for every method, and never falls again.

Cannot see what compiled kernels allocate by themselves.
"""

import time
import tracemalloc
from collections.abc import Callable

from equipoise.study.method_run import Cost, Found


def metered(work: Callable[[], Found], weighed: bool) -> tuple[Found, Cost]:
    """Return what work gives, and what it takes; its memory if it is to be ``weighed``."""
    memory = peak(work) if weighed else None
    start = time.process_time()
    found = work()
    return found, Cost(time.process_time() - start, memory)


def peak(work: Callable[[], object]) -> int:
    """Return by how many bytes the memory of Python and NumPy grows at most during work."""
    tracemalloc.start()
    try:
        work()
        return tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
