"""Help is there for every command, soon, and without the numerical libraries."""

import os
import subprocess
import sys

import pytest

COMMANDS = (
    "demo",
    "new",
    "plan",
    "simulate",
    "inspect",
    "observe",
    "identify",
    "assess",
    "calibrate",
    "methods",
    "balance",
    "laws",
    "design",
    "compare",
    "reproduce",
    "devices",
    "check",
    "emulate",
    "record",
    "convert",
    "repair",
    "replay",
    "track",
    "print-board",
    "calibrate-camera",
    "dashboard",
    "report",
    "logbook",
)
HEAVY = ("numpy", "scipy", "numba", "matplotlib", "pydantic", "pyarrow", "jaxtyping", "cv2")
PROMPT = 0.5  # s, what the issue asks for
LOADED = 1.6  # a test machine at work is slower than a person's at rest


def helped(*words: str) -> tuple[float, str]:
    """Return its processor time (s), which does not depend on what else runs, and what it says."""
    start = of_children()
    done = subprocess.run(
        [sys.executable, "-m", "equipoise.app.cli", *words, "--help"],
        capture_output=True,
        text=True,
        check=True,
    )
    return of_children() - start, done.stdout


def of_children() -> float:
    """Return the processor time of the programs that have ended, s."""
    spent = os.times()
    return spent.children_user + spent.children_system


@pytest.mark.parametrize("words", [(), *((c,) for c in COMMANDS)], ids=lambda w: w[0] if w else "")
def test_help_is_prompt(words):
    """Best of three, in a fresh interpreter."""
    assert min(helped(*words)[0] for _ in range(3)) < PROMPT * LOADED


def test_no_heavy_library_is_imported_before_a_command_runs():
    code = "import sys, equipoise.app.cli; print(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert not set(HEAVY) & set(done.stdout.split())


def test_every_command_is_listed():
    listed = helped()[1]
    assert all(command in listed for command in COMMANDS)


@pytest.mark.parametrize("command", COMMANDS)
def test_every_option_is_explained(command):
    """A line that names an option goes on with what it does; '*' is a record of shared options."""
    from equipoise.app.cli import app

    arguments = app[command].assemble_argument_collection(parse_docstring=True)
    options = [argument for argument in arguments if argument.name != "*"]
    assert options
    for argument in options:
        assert argument.parameter.help, f"{command} {argument.name} has no help"


def test_version_is_printed(equipoise):
    from equipoise import __version__

    assert equipoise("--version").out.strip() == __version__
