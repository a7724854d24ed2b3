"""The program with a command more, which fails in a way that nobody has foreseen."""

import threading
from pathlib import Path

from numpy.linalg import LinAlgError

from equipoise.app.cli import app, main
from equipoise.app.engine.spread import spread_over
from equipoise.app.engine.worker_processes import worker_processes


class Panic(BaseException):
    """As a library in Rust ends: no Exception."""


def deep(n: int) -> int:
    return deep(n + 1)


def work(cell: str) -> None:
    raise ValueError(f"could not convert {cell}")


def end_thread(cell: str) -> None:
    thread = threading.Thread(target=work, args=(cell,))
    thread.start()
    thread.join()


def at_worker(cell: str) -> None:
    with worker_processes(1) as pool:
        list(spread_over(pool)(work, [cell]))


def raised(kind: type[BaseException], cell: str) -> None:
    raise kind(f"cell {cell}")


def chained(cell: str) -> None:
    try:
        work(cell)
    except ValueError as error:
        raise TypeError(cell) from error


WAYS = {
    "value": work,
    "type": chained,
    "memory": lambda cell: raised(MemoryError, cell),
    "recursion": lambda cell: deep(0),
    "algebra": lambda cell: raised(LinAlgError, cell),
    "overflow": lambda cell: raised(OverflowError, cell),
    "panic": lambda cell: raised(Panic, cell),
    "group": lambda cell: (_ for _ in ()).throw(ExceptionGroup(cell, [ValueError(cell)])),
    "thread": end_thread,
    "worker": at_worker,
}


@app.command
def fail(file: Path, /, *, way: str, to: str = "") -> int:
    """Read a file, and fail with a cell of it."""
    cell = file.read_text().split(",")[1]
    WAYS[way](cell)
    return 0


if __name__ == "__main__":
    main()
