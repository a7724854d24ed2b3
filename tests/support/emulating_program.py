"""`equipoise emulate` in a program of its own."""

import signal
import subprocess
from contextlib import contextmanager

from tests.support.pseudo_terminal import PROGRAM


@contextmanager
def emulating(folder, testbed, ended_with=signal.SIGINT):
    """Let a bench be there as long as the block lasts; its testbed file is ``there.toml``.

    It ends by a signal, and with the account of the truth.
    """
    words = [*PROGRAM, "emulate", testbed, "--out", "there.toml", "--max-time-s", "600"]
    with subprocess.Popen(words, cwd=folder, stdout=subprocess.PIPE, text=True) as there:
        assert next(line for line in there.stdout if "wrote" in line)
        yield
        there.send_signal(ended_with)
        assert "the true centre of mass" in there.stdout.read()
