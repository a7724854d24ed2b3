"""A generated program, compiled and run as a board would run it: one row in, one answer out."""

import re
import shutil
import subprocess

import numpy as np
import pytest

COMPILER = shutil.which("gcc") or shutil.which("clang") or shutil.which("cc")
STRICT = [
    "-std=c99",
    "-pedantic",
    "-Wall",
    "-Wextra",
    "-Wconversion",
    "-Werror",
    "-ffp-contract=off",
]
LONGEST = 60.0  # s, of a compilation
needs_compiler = pytest.mark.skipif(COMPILER is None, reason="this machine has no C compiler")


def written(folder, files):
    """Write files into a folder."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in files.items():
        (folder / name).write_text(text, encoding="utf-8")
    return folder


def compiled(folder, program, *flags):
    """Compile one of the programs, without a single warning, and return it."""
    out = folder / f"{program}{''.join(flags)}"
    sources = [folder / "equipoise.c", folder / f"{program}.c"]
    command = [COMPILER, *STRICT, *flags, *sources, "-o", out, "-lm"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=LONGEST, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    return out


def replayed(program):
    """Return what a program says to its test vector: exit code and sentence."""
    done = subprocess.run([program], capture_output=True, text=True, timeout=LONGEST, check=False)
    return done.returncode, done.stdout


def answers(program, rows):
    """Return what a program answers to rows, all at once."""
    text = "\n".join(" ".join(float(x).hex() for x in row) for row in rows) + "\n"
    done = subprocess.run(
        [program], input=text, capture_output=True, text=True, timeout=LONGEST, check=True
    )
    return np.array([[float(x) for x in line.split()] for line in done.stdout.splitlines()])


class Program:
    """A program that runs: called with a row it gives the answer."""

    def __init__(self, program):
        self._process = subprocess.Popen(
            [program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._process.stdin.close()
        self._process.wait(timeout=LONGEST)
        self._process.stdout.close()

    def __call__(self, row):
        self._process.stdin.write(" ".join(float(x).hex() for x in row) + "\n")
        self._process.stdin.flush()
        return np.array([float(x) for x in self._process.stdout.readline().split()])


def stack_bytes(folder, *flags):
    """Return the most stack that a call of equipoise_row takes, by the compiler's call graph."""
    text = call_graph(folder, flags)
    own = {
        name: int(size)
        for name, size in re.findall(r'title: "(?:[^":]*:)?([^":]+)"[^}]*?(\d+) bytes', text)
    }
    calls = re.findall(
        r'sourcename: "(?:[^":]*:)?([^":]+)" targetname: "(?:[^":]*:)?([^":]+)"', text
    )

    def deepest(name):
        below = [deepest(target) for source, target in calls if source == name]
        return own.get(name, 0) + max(below, default=0)

    return deepest("equipoise_row")


def call_graph(folder, flags):
    """Return what gcc says of stack and calls."""
    command = [COMPILER, *STRICT, *flags, "-fcallgraph-info=su", "-c", "equipoise.c"]
    subprocess.run(command, cwd=folder, timeout=LONGEST, check=True)
    return (folder / "equipoise.ci").read_text(encoding="utf-8")
