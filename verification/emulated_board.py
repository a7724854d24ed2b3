"""A bench of emulated devices in a program of its own, and what its board says when it is asked."""

import os
import re
import signal
import subprocess
import sys
import termios
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from equipoise.io.testbed.testbed_file import read_testbed

TESTBED = "there.toml"
SETTLED = 0.5  # s, chosen: for a deceleration, and between two answers about masses that stand
ANSWERS = 4  # chosen: a leg that were still to come takes a quarter second
POSITION = re.compile(rb"<(\w+)[^|>]*\|MPos:([^|>]+)[^>]*>")  # Grbl's answer to a question mark


@contextmanager
def emulating(folder: Path, seed: int) -> Iterator[None]:
    """Let a bench be there while the block lasts; its testbed file is ``there.toml``."""
    words = ("emulate", "nanosat", "--out", TESTBED, "--seed", str(seed))
    program = [sys.executable, "-m", "equipoise.app.cli", *words]
    with subprocess.Popen(program, cwd=folder, stdout=subprocess.PIPE, text=True) as there:
        try:
            assert there.stdout is not None
            assert any("wrote" in line for line in there.stdout)
            yield
        finally:
            there.send_signal(signal.SIGTERM)


def answers_of(folder: Path) -> tuple[str, ...]:
    """Return several answers of the board, one after the other: state and where its masses are."""
    hardware = read_testbed(folder / TESTBED).hardware
    assert hardware is not None
    kind, _, port = hardware.boards[0].port.address.partition(":")
    assert kind == "serial"
    return tuple(_answer(port) for _ in range(ANSWERS))


def goes_on(answers: tuple[str, ...]) -> bool:
    """Say whether a mass moves."""
    return len({answer.split()[-1] for answer in answers}) > 1


def _answer(port: str) -> str:
    """Ask a Grbl board, a while later, for its state and where its masses are.

    What it had answered to the command that was interrupted is thrown away.
    """
    time.sleep(SETTLED)
    board, received = os.open(port, os.O_RDWR | os.O_NOCTTY), b""
    try:
        termios.tcflush(board, termios.TCIFLUSH)
        os.write(board, b"?")
        while not (found := POSITION.search(received)):
            received += os.read(board, 4096)
    finally:
        os.close(board)
    return b" ".join(found.groups()).decode()
