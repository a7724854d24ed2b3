"""A command at a pseudo terminal of some size: what it wrote there, and what is left to be seen."""

import fcntl
import os
import pty
import re
import select
import signal
import struct
import subprocess
import sys
import termios
import threading
import time

PROGRAM = [sys.executable, "-m", "equipoise.app.cli"]
ESCAPE = re.compile(r"\x1b\[(\??)([0-9;]*)([A-Za-z])")
HIDE, SHOW = "\x1b[?25l", "\x1b[?25h"
PATIENCE = 120.0  # s


class AtTerminal:
    """A command whose stderr, and stdout unless that goes elsewhere, is a pseudo terminal."""

    program = PROGRAM

    def __init__(self, folder, words, size=(80, 24), environment=None, stdout=None):
        ours, theirs = pty.openpty()
        fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", size[1], size[0], 0, 0))
        free = {name: value for name, value in os.environ.items() if name not in NOT_OURS}
        environment = {"TERM": "xterm-256color", "EQUIPOISE_RUNS": ""} | (environment or {})
        self._process = subprocess.Popen(
            [*self.program, *map(str, words)], cwd=folder, env=free | environment,
            stdin=theirs, stderr=theirs, stdout=theirs if stdout is None else stdout,
            start_new_session=True,
        )  # fmt: skip
        os.close(theirs)
        self.stdout = self._process.stdout  # None at the terminal
        self._ours, self._received, self._gone = ours, bytearray(), False
        self._listener = threading.Thread(target=self._listen)
        self._listener.start()

    def _listen(self):
        try:
            while not self._gone:
                if select.select([self._ours], [], [], 0.05)[0]:
                    self._received += os.read(self._ours, 1 << 16)
        except OSError:  # who had the other end is gone
            pass
        os.close(self._ours)

    @property
    def written(self):
        """All bytes so far, as text."""
        return bytes(self._received).decode(errors="replace")

    @property
    def over(self):
        """Whether the command has ended."""
        return self._process.poll() is not None

    def wait_for(self, text):
        """Wait until something has been written."""
        end = time.monotonic() + PATIENCE
        while text not in self.written:
            if time.monotonic() > end:
                raise TimeoutError(self.written)
            assert self._process.poll() is None, self.written
            time.sleep(0.02)

    def type(self, text):
        """Type a text."""
        os.write(self._ours, text.encode())

    def ctrl_c(self):
        """Do as a terminal does."""
        self.send_all(signal.SIGINT)

    def send_all(self, number):
        """Send all processes of the command a signal."""
        os.killpg(self._process.pid, number)

    def hang_up(self):
        """Do as a terminal that is closed, and its shell: the end of all writing, told twice."""
        self._gone = True
        self._listener.join(PATIENCE)
        for _ in range(0 if self.over else 2):
            self.send_all(signal.SIGHUP)
            time.sleep(0.05)

    def ended(self):
        """Return the exit code."""
        code = self._process.wait(PATIENCE)
        self._listener.join(PATIENCE)
        return code


# What others say of terminals and of the user's customs.
NOT_OURS = {"COLUMNS", "LINES", "NO_COLOR", "FORCE_COLOR", "COLORTERM", "PYTHONIOENCODING"}


def stripped(written):
    """Return what was written without escape sequences."""
    return ESCAPE.sub("", written)


def screen(written):
    """Return the lines left to be seen, by the few sequences that are used; nothing scrolls off.

    What was written must end at the beginning of an empty line, the first below all others.
    """
    lines, row, column, at = [""], 0, 0, 0
    while at < len(written):
        if escape := ESCAPE.match(written, at):
            _, number, verb = escape.groups()
            row -= int(number or 1) if verb == "A" else 0
            assert row >= 0, "above the first line"
            lines[row] = "" if (verb, number) == ("K", "2") else lines[row]
            at = escape.end()
            continue
        letter, at = written[at], at + 1
        if letter == "\r":
            column = 0
        elif letter == "\n":
            row, column = row + 1, 0
            lines += [""] * (row + 1 - len(lines))
        else:
            lines[row] = lines[row][:column].ljust(column) + letter + lines[row][column + 1 :]
            column += 1
    assert not any(lines[row:]), "the cursor is left in the middle"
    return [line.rstrip() for line in lines[:row]]
