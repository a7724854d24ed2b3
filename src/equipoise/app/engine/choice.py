"""The engine that is named: local, dask-local, or dask://HOST:PORT."""

import re
from functools import partial

from equipoise.app.engine.dask_engine import dask_at, dask_here
from equipoise.app.engine.pool import Engine, in_this_process
from equipoise.app.engine.worker_processes import worker_processes
from equipoise.model.errors import InputError, nearest

LOCAL, DASK_LOCAL, DASK = "local", "dask-local", "dask://"
ADDRESS = re.compile(r"dask://(?P<address>(\[[0-9a-fA-F:.]+\]|[^\s:/\[\]]+):\d{1,5})")


def engine_of(name: str, workers: int) -> Engine:
    """Return an engine; one worker of ``local`` is this process itself.

    ``workers`` is how many processes to begin; of a cluster that runs, all are taken. InputError
    for a name that is none. Nothing is begun or reached before the engine is opened.
    """
    if name == LOCAL:
        return in_this_process if workers == 1 else partial(worker_processes, workers)
    if name == DASK_LOCAL:
        return partial(dask_here, workers)
    if found := ADDRESS.fullmatch(name):
        return partial(dask_at, found["address"])
    if name.startswith(DASK):
        raise InputError("--on", f"'{name}'", "dask://HOST:PORT, such as dask://10.0.0.5:8786")
    raise InputError("--on", f"'{name}'", nearest(name, [LOCAL, DASK_LOCAL, "dask://HOST:PORT"]))
