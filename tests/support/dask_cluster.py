"""A Dask scheduler and its workers as processes of their own, as a laboratory would start them."""

import json
import os
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from equipoise.app.engine.worker_processes import ONE_THREAD

PATIENCE = 120.0  # s: a busy computer starts them slowly
SOON = 0.02  # s


@dataclass(frozen=True)
class Cluster:
    """Its scheduler's address, and the worker processes."""

    address: str  # HOST:PORT
    workers: list[subprocess.Popen[bytes]]

    @property
    def on(self) -> str:
        return f"dask://{self.address}"


@contextmanager
def cluster(folder: Path, count: int = 2) -> Iterator[Cluster]:
    """Start a scheduler and workers, and end those of them that are left."""
    file = folder / "scheduler.json"
    plain = ("--scheduler-file", str(file), "--dashboard-address", "127.0.0.1:0")
    scheduler = started("scheduler", "--host", "127.0.0.1", "--port", "0", *plain, within=folder)
    workers = [
        started("worker", *plain, "--nthreads", "1", "--no-nanny", within=folder)
        for _ in range(count)
    ]
    try:
        until(lambda: file.exists() and file.stat().st_size > 0)
        address = json.loads(file.read_text())["address"].removeprefix("tcp://")
        wait_for_workers(address, count)
        yield Cluster(address, workers)
    finally:
        for process in (*workers, scheduler):
            process.kill()
        for process in (*workers, scheduler):
            process.wait()


def started(kind: str, *words: str, within: Path) -> subprocess.Popen[bytes]:
    environment = {**os.environ, **ONE_THREAD, "PYTHONPATH": os.pathsep.join(sys.path)}
    command = [sys.executable, "-m", f"distributed.cli.dask_{kind}", *words]
    quiet = subprocess.DEVNULL
    return subprocess.Popen(command, cwd=within, env=environment, stdout=quiet, stderr=quiet)


def wait_for_workers(address: str, count: int) -> None:
    from distributed import Client

    with Client(f"tcp://{address}", set_as_default=False) as client:
        client.wait_for_workers(count, timeout=PATIENCE)


def until(is_so) -> None:
    """Wait until something is so, and no longer than ``PATIENCE``."""
    for _ in range(int(PATIENCE / SOON)):
        if is_so():
            return
        time.sleep(SOON)
    raise TimeoutError(f"it did not come about in {PATIENCE:g} s")


def is_alive(process: int) -> bool:
    """Say whether a process runs; one that has ended and awaits its parent does not."""
    try:
        state = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0]
    except FileNotFoundError:
        return False
    return state != "Z"
