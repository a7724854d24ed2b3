"""`python -m tests.schema_change.run --source SRC --out FOLDER [NAME ...]`: write the documents.

To be called in the root of the repository.

A case is carried out by a program of its own, in a folder of its own, on the source tree that is
named; so trees of two revisions can be run from one environment. One thread for linear algebra,
since the order of its sums depends on their number. The folder `before` was written so, with the
source tree of the revision before the restructuring.
"""

import argparse
import json
import os
import shlex
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from rich.console import Console

from equipoise.app.engine.worker_processes import ONE_THREAD
from tests.schema_change.inputs import Case, chosen

Document = dict[str, Any]

PROGRAM = "equipoise.app.cli"
CONSOLE = Console(stderr=True, highlight=False, soft_wrap=True)
COMPLETED = (0, 1)  # done, and the answer is good or not


class RunFailed(Exception):
    """A command did not end as its case expects."""


@dataclass(frozen=True, slots=True)
class Program:
    """Equipoise from a source tree, run in a folder."""

    source: Path
    folder: Path

    def python(self, *words: str) -> subprocess.CompletedProcess[str]:
        """Run Python on the source tree; no run is kept."""
        own = {"PYTHONPATH": str(self.source.resolve()), "EQUIPOISE_RUNS": ""}
        return subprocess.run(
            [sys.executable, *words],
            cwd=self.folder,
            env=os.environ | ONE_THREAD | own,
            capture_output=True,
            encoding="utf-8",
            check=False,
        )

    def command(self, line: str) -> subprocess.CompletedProcess[str]:
        """Carry out a command line; raise RunFailed unless it is completed."""
        done = self.python("-m", PROGRAM, *shlex.split(line))
        if done.returncode not in COMPLETED:
            raise RunFailed(f"equipoise {line}: ended with {done.returncode}\n{done.stderr}")
        return done


def check_source(source: Path) -> None:
    """Raise RunFailed unless Python takes Equipoise from this source tree."""
    found = Program(source, Path.cwd()).python("-c", "import equipoise; print(equipoise.__file__)")
    if not found.stdout or not Path(found.stdout.strip()).is_relative_to(source.resolve()):
        raise RunFailed(f"{source}: Equipoise is not there\n{found.stdout}{found.stderr}")


def document_of(case: Case, source: Path) -> Document:
    """Return what a case prints, and under ``exit_code`` how it ends."""
    with TemporaryDirectory() as folder:
        program = Program(source, Path(folder))
        if case.added_truth:
            program.command("new sputnix --out my.toml")
            with (Path(folder) / "my.toml").open("a", encoding="utf-8") as testbed:
                testbed.write(case.added_truth)
        for line in case.recordings:
            program.command(line)
        done = program.command(f"{case.arguments} --json")
    return json.loads(done.stdout) | {"exit_code": done.returncode}


def documents_of(cases: Sequence[Case], source: Path) -> Iterator[tuple[str, Document]]:
    """Yield the name and the document of each case; tell how long each took."""
    check_source(source)
    for number, case in enumerate(cases, 1):
        began = time.perf_counter()
        document = document_of(case, source)
        took = time.perf_counter() - began
        CONSOLE.print(f"{number:2d}/{len(cases)} {case.name:30s} {took:6.1f} s", markup=False)
        yield case.name, document


def write(document: Document, path: Path) -> None:
    """Write a document as one line of JSON."""
    text = json.dumps(document, ensure_ascii=False, separators=(",", ":"))
    path.write_text(text + "\n", encoding="utf-8")


def read(path: Path) -> Document:
    """Return a document that was written."""
    return json.loads(path.read_text(encoding="utf-8"))


def main(words: Sequence[str]) -> None:
    """Run the cases that are named, or all, and write their documents."""
    parser = argparse.ArgumentParser(prog="python -m tests.schema_change.run")
    parser.add_argument("names", nargs="*", metavar="NAME", help="cases to run (all)")
    parser.add_argument("--source", type=Path, required=True, help="folder that holds equipoise/")
    parser.add_argument("--out", type=Path, required=True, help="folder for the documents")
    options = parser.parse_args(words)
    options.out.mkdir(parents=True, exist_ok=True)
    for name, document in documents_of(chosen(options.names), options.source):
        write(document, options.out / f"{name}.json")


if __name__ == "__main__":
    main(sys.argv[1:])
