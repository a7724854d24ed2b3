"""Pure pieces of work for engines, and a program that does ten thousand of them.

`python -m tests.support.many_pieces FOLDER`: two processes, results kept in FOLDER/kept.
"""

import math
import os
import sys
import time
from pathlib import Path

import numpy as np

from equipoise.app.engine.kept_results import KeptResults
from equipoise.app.engine.spread import spread_over
from equipoise.app.engine.worker_processes import worker_processes
from equipoise.model.arrays import Floats
from equipoise.model.errors import InputError

MANY = 10_000
QUESTION = {"function": "sine and cosine", "step": 0.1}


def pair(k: int) -> tuple[float, float]:
    """Two numbers."""
    return math.sin(0.1 * k), math.cos(0.1 * k)


def algebra(seed: int) -> Floats:
    """Singular values and a solution of 40 equations: within one thread of any library."""
    rng = np.random.default_rng(seed)
    matrix, right = rng.normal(size=(40, 40)), rng.normal(size=40)
    return np.append(np.linalg.svd(matrix)[1], np.linalg.solve(matrix, right))


def uneven(k: int) -> int:
    """A square, now and then late: results do not come in order."""
    time.sleep(0.05 if k % 7 == 0 else 1e-3)
    return k * k


def failing(k: int) -> int:
    """Fails from 13 on, the later the sooner."""
    if k >= 13:
        time.sleep(max(0.3 - 0.05 * (k - 13), 0.0))
        raise InputError(f"piece {k}", "an odd one", "none")
    return k


def ending(k: int) -> int:
    """End the process that does it, as where its memory is at its end."""
    os._exit(k)


def lasting(k: int) -> int:
    """Last longer than anybody waits."""
    time.sleep(600)
    return k


def noted(piece: tuple[str, int]) -> tuple[float, float]:
    """A pair, in a fraction of a millisecond, and a line in a file that it was computed."""
    path, k = piece
    with Path(path).open("a") as file:
        file.write(f"{k}\n")
    time.sleep(2e-4)
    return pair(k)


def key(piece: tuple[str, int]) -> str:
    return f"seed {piece[1]}"


def kept_in(folder: Path, notice=print) -> KeptResults:
    return KeptResults(folder / "kept", QUESTION, key, notice)


def pieces_in(folder: Path, name: str) -> list[tuple[str, int]]:
    return [(str(folder / name), k) for k in range(MANY)]


def main(folder: Path) -> None:
    with worker_processes(2) as pool:
        for _ in spread_over(pool, kept=kept_in(folder))(noted, pieces_in(folder, "first.txt")):
            pass


if __name__ == "__main__":
    main(Path(sys.argv[1]))
