"""Help is there for every command, without the numerical libraries."""

import subprocess
import sys

import pytest

COMMANDS = (
    "demo",
    "new",
    "inertia",
    "plan",
    "simulate",
    "inspect",
    "observe",
    "ledger",
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
    "export",
    "import",
    "repair",
    "replay",
    "track",
    "print-board",
    "calibrate-camera",
    "dashboard",
    "report",
    "logbook",
    "precompile",
)
HEAVY = ("numpy", "scipy", "numba", "matplotlib", "pydantic", "pyarrow", "jaxtyping", "cv2")
HELP = """
import contextlib, io, sys
from equipoise.app.cli import run
for name in sys.argv[1:]:
    with contextlib.redirect_stdout(io.StringIO()) as printed:
        code = run([name, "--help"])
    print(name, code, name in printed.getvalue(), *sys.modules)
"""


def started(*words: str) -> str:
    """Return what a fresh interpreter prints."""
    run = subprocess.run([sys.executable, *words], capture_output=True, text=True, check=True)
    return run.stdout


def test_help_imports_no_heavy_library():
    """So it is there at once: `make bench` says how soon."""
    lines = [line.split() for line in started("-c", HELP, *COMMANDS).splitlines()]
    assert [line[:3] for line in lines] == [[name, "0", "True"] for name in COMMANDS]
    assert {line[0]: heavy for line in lines if (heavy := set(HEAVY) & set(line[3:]))} == {}


def test_no_heavy_library_is_imported_before_a_command_runs():
    code = "import sys, equipoise.app.cli; print(*sys.modules)"
    assert not set(HEAVY) & set(started("-c", code).split())


def test_every_command_is_listed():
    listed = started("-m", "equipoise.app.cli", "--help")
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
