"""`python -m verification.mutants [WORD ...]`: break the code in one place after another.

Each mutant is made in a copy of the tree, and its tests are run there; one that they pass has
survived. Words choose mutants by a part of their path. Exit code 1 if any survived.
"""

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from queue import SimpleQueue

from rich.console import Console

from equipoise.maths.kernels.kernel_cache import kernels_folder
from verification.mutants.catalogue import MUTANTS, Mutant

ROOT = Path(__file__).parents[2]
COPIED = ("src", "tests", "verification", "docs", "pyproject.toml", "README.md")
LONGEST = 600.0  # s; a mutant that never ends is noticed too
FAILED, PASSED = 1, 0  # exit codes of pytest
console = Console()


@dataclass(frozen=True, slots=True)
class Outcome:
    """What became of a mutant."""

    mutant: Mutant
    word: str  # killed, survived, or not run
    seconds: float
    output: str


def copy_tree(to: Path) -> Path:
    """Copy what the tests need."""
    for name in COPIED:
        source, target = ROOT / name, to / name
        if source.is_dir():
            shutil.copytree(source, target, ignore=shutil.ignore_patterns("__pycache__"))
        else:
            shutil.copy(source, target)
    return to


def run_tests(
    tree: Path, kernels: Path, tests: Sequence[str], longest: float | None = None
) -> tuple[int, str]:
    """Run some tests of a tree; return the exit code of pytest and what it said."""
    own = {
        "PYTHONPATH": str(tree / "src"),
        "PYTHONDONTWRITEBYTECODE": "1",  # a mutant may be as long as what it replaces
        "NUMBA_CACHE_DIR": str(kernels),
    }
    words = [sys.executable, "-m", "pytest", "-q", "-x", "-p", "no:cacheprovider"]
    try:
        run = subprocess.run(
            [*words, *(f"tests/{each}" for each in tests)], cwd=tree, env=os.environ | own,
            capture_output=True, text=True, timeout=longest, check=False,
        )  # fmt: skip
    except subprocess.TimeoutExpired:
        return FAILED, f"no end within {longest} s"
    return run.returncode, run.stdout + run.stderr


def tried(tree: Path, kernels: Path, mutant: Mutant) -> Outcome:
    """Break one place, run its tests, and mend it."""
    path, began = tree / "src" / "equipoise" / mutant.path, time.monotonic()
    whole = path.read_text(encoding="utf-8")
    path.write_text(whole.replace(mutant.old, mutant.new), encoding="utf-8")
    try:
        code, output = run_tests(tree, kernels, mutant.tests.split(), LONGEST)
    finally:
        path.write_text(whole, encoding="utf-8")
    word = {FAILED: "killed", PASSED: "survived"}.get(code, "not run")
    return Outcome(mutant, word, time.monotonic() - began, output)


@contextmanager
def trees(count: int) -> Iterator[tuple[SimpleQueue[Path], Path]]:
    """Lend copies of the tree, and a place for kernels in which ours are at the beginning."""
    with tempfile.TemporaryDirectory() as folder:
        free: SimpleQueue[Path] = SimpleQueue()
        for k in range(count):
            (Path(folder) / f"tree{k}").mkdir()
            free.put(copy_tree(Path(folder) / f"tree{k}"))
        kernels, ours = Path(folder) / "kernels", kernels_folder()
        if ours.is_dir():
            shutil.copytree(ours, kernels / ours.name)
        yield free, kernels


def outcomes(chosen: Sequence[Mutant], workers: int) -> Iterator[Outcome]:
    """Try mutants side by side; first all their tests have to pass on the code as it is."""
    with trees(workers) as (free, kernels), ThreadPoolExecutor(workers) as pool:
        wanted = sorted({each for mutant in chosen for each in mutant.tests.split()})
        tree = free.get()
        code, output = run_tests(tree, kernels, wanted)
        if code != PASSED:
            raise SystemExit(f"{output}\nThe tests have to pass before anything is broken.")
        free.put(tree)

        def one(mutant: Mutant) -> Outcome:
            tree = free.get()
            try:
                return tried(tree, kernels, mutant)
            finally:
                free.put(tree)

        yield from pool.map(one, chosen)


def main(words: Sequence[str]) -> int:
    """Try the mutants that were asked for; print one line each, and what let one survive."""
    parser = argparse.ArgumentParser(prog="python -m verification.mutants", description=__doc__)
    parser.add_argument("words", nargs="*", help="parts of paths")
    parser.add_argument("--workers", type=int, default=2, help="processes (2)")
    requested = parser.parse_args(words)
    chosen = [
        m for m in MUTANTS if not requested.words or any(w in m.path for w in requested.words)
    ]
    missed = 0
    for found in outcomes(chosen, requested.workers):
        change = f"{found.mutant.path}: {found.mutant.old}  ->  {found.mutant.new}"
        console.print(f"{found.word:8} {found.seconds:5.0f} s  {change}", markup=False)
        if found.word != "killed":
            missed += 1
            console.print(found.output[-2000:], markup=False)
    console.print(f"{len(chosen) - missed} of {len(chosen)} mutants were killed.")
    return 1 if missed or not chosen else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
