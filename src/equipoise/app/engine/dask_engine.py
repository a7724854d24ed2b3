"""A Dask cluster as an engine: one that is running somewhere, or one begun here.

Workers hold the same version of the program (``chunks.chunk_done``) and one thread each: kernels
and processor times are those of a whole process. A worker that is lost has its chunks done by
another; one that comes later gets its share.
"""

import time
from collections.abc import Callable, Generator
from contextlib import contextmanager
from typing import Any

from equipoise.app.engine.pool import Pool
from equipoise.model.errors import InputError
from equipoise.model.optional_libraries import extra_library

DEADLINE = 10.0  # s, chosen: a scheduler that runs answers within one
RECOUNTED = 1.0  # s, chosen: workers come and go slowly
ONE_THREAD = "`dask worker ADDRESS --nworkers COUNT --nthreads 1`"


@contextmanager
def dask_at(address: str) -> Generator[Pool]:
    """Lend the workers of a scheduler; ``address``: HOST:PORT.

    InputError where none answers, and where a worker has several threads.
    """
    distributed = _distributed(f"dask://{address}")
    try:
        client = distributed.Client(f"tcp://{address}", timeout=DEADLINE, set_as_default=False)
    except (OSError, ValueError) as error:
        found = f"no Dask scheduler that answers within {DEADLINE:g} s"
        wanted = "the address that `dask scheduler` prints, as dask://HOST:PORT"
        raise InputError(f"--on dask://{address}", found, wanted) from error
    with client:
        _check_threads(address, client.nthreads())
        with _lent(client) as pool:
            yield pool


@contextmanager
def dask_here(count: int) -> Generator[Pool]:
    """Lend a cluster on this computer, begun for it, of so many workers."""
    distributed = _distributed("dask-local")
    with (
        distributed.LocalCluster(
            n_workers=count, threads_per_worker=1, processes=True, dashboard_address="127.0.0.1:0"
        ) as cluster,
        distributed.Client(cluster, set_as_default=False) as client,
        _lent(client) as pool,
    ):
        yield pool


@contextmanager
def _lent(client: Any) -> Generator[Pool]:
    executor = client.get_executor(pure=False)
    try:
        yield Pool(executor, _counted(client))
    finally:
        executor.shutdown(wait=False)


def _distributed(where: str) -> Any:
    """Return the library; InputError says how to have it."""
    return extra_library("distributed", "--on", f"'{where}'", "cluster")


def _check_threads(address: str, threads: dict[str, int]) -> None:
    for worker, count in threads.items():
        if count > 1:
            found = f"a worker with {count} threads, {worker}"
            raise InputError(f"--on dask://{address}", found, f"one thread each: {ONE_THREAD}")


def _counted(client: Any) -> Callable[[], int]:
    """Return what counts the workers, at most once in a while; where there is none yet: one."""
    count, at = 1, -RECOUNTED

    def workers() -> int:
        nonlocal count, at
        if time.monotonic() - at >= RECOUNTED:
            count, at = max(len(client.nthreads()), 1), time.monotonic()
        return count

    return workers
