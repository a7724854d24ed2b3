"""A command to which something happens at a random moment: by the clock, or at a file operation.

It runs in a group of its own. ``sitecustomize`` gives each of its processes a wall clock that can
be set from here. A full disk is a limit of 0 bytes to which files of these processes may grow.
"""

import mmap
import os
import resource
import select
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from equipoise.model.units import MINUTE

AN_HOUR = 60 * MINUTE  # s
DISK_FULL, FULL_PIPE, KILL = "disk full", "full pipe", "kill -9"
SIGNALS = {KILL: signal.SIGKILL, "SIGTERM": signal.SIGTERM, "SIGHUP": signal.SIGHUP}
JUMPS = {"clock an hour on": AN_HOUR, "clock an hour back": -AN_HOUR}
FAULTS = (DISK_FULL, FULL_PIPE, *SIGNALS, *JUMPS)
HELD = 2.0  # s, chosen: for which nobody reads a pipe that is full
LEFT = 90.0  # s, chosen: for a command to end
LEAVING = 10.0  # s, chosen: for what it began to end with it
BEGUN = "begun"

CLOCK = """
import mmap, os, time
with open(os.environ["STRUCK_CLOCK"], "r+b") as file:
    offset = memoryview(mmap.mmap(file.fileno(), 8)).cast("d")
now, now_ns = time.time, time.time_ns
time.time = lambda: now() + offset[0]
time.time_ns = lambda: now_ns() + int(offset[0]) * 10**9
"""
PROGRAM = """
import os, resource, sys
from pathlib import Path

from equipoise.app.cli import app, main

NUMBERS = {"kill -9": 9, "SIGTERM": 15, "SIGHUP": 1}
JUMPS = {"clock an hour on": 3600.0, "clock an hour back": -3600.0}
CHANGES = ("os.mkdir", "os.rename", "os.remove", "os.rmdir", "sqlite3.connect")


@app.command
def archive(count: int, /):
    '''Keep so many runs.'''
    from equipoise.app.logbook.run_folder import own_folder
    from equipoise.io.files.atomic_file import write_folder

    for k in range(count):
        write_folder(own_folder("balance", "nanosat"), {f"{n}.txt": f"{n} " * 3000
                                                        for n in range(FILES)})
        print(f"kept {k}", flush=True)


FILES = 8


def strike(fault):
    from sitecustomize import offset

    print("struck", flush=True)
    if fault in NUMBERS:
        os.kill(os.getpid(), NUMBERS[fault])
    elif fault in JUMPS:
        offset[0] = JUMPS[fault]
    else:
        resource.setrlimit(resource.RLIMIT_FSIZE, (0, resource.RLIM_INFINITY))


def here(path):
    return isinstance(path, (str, Path)) and (
        not os.path.isabs(path) or str(path).startswith(os.getcwd()))


def counting(at, fault):
    left = [at]

    def hook(event, arguments):
        writes = event == "open" and arguments[2] & (os.O_WRONLY | os.O_RDWR | os.O_CREAT)
        if (writes or event in CHANGES) and here(arguments[0]) and left[0]:
            left[0] -= 1
            if not left[0]:
                strike(fault)

    return hook


if __name__ == "__main__":
    at, fault = int(sys.argv.pop(1)), sys.argv.pop(1)
    print("begun", flush=True)
    if at:
        sys.addaudithook(counting(at, fault))
    main()
"""
FILES = 8  # of each run that the program keeps


@dataclass(frozen=True, slots=True)
class Moment:
    """When something happens: after so many seconds, or at the so manieth file operation."""

    seconds: float = 0.0
    operation: int = 0  # 0: by the clock


class Struck:
    """A command in its folder; ``said`` is what it has written to its pipe."""

    def __init__(self, folder: Path, words: Sequence[str], fault: str, moment: Moment) -> None:
        self.fault, self.moment, self._folder, self.said = fault, moment, folder, ""
        (folder / "site").mkdir(exist_ok=True)
        (folder / "site" / "sitecustomize.py").write_text(CLOCK)
        (folder / "program.py").write_text(PROGRAM)
        (folder / "clock").write_bytes(bytes(8))
        ours, theirs = os.pipe()
        program = [sys.executable, "program.py", str(moment.operation), fault, *words]
        self.process = subprocess.Popen(
            program, cwd=folder, env=environment(folder), stdin=subprocess.DEVNULL, stdout=theirs,
            stderr=theirs, start_new_session=True,
        )  # fmt: skip
        os.close(theirs)
        self._ours, self._reads = ours, True
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()
        self.wait_for(BEGUN)

    def wait_for(self, text: str) -> None:
        """Wait until it has written something, or has ended."""
        while text not in self.said and self.process.poll() is None:
            time.sleep(0.01)

    def strike(self, rng: np.random.Generator) -> None:
        """Let it happen, at its moment; UTC of that is ``at`` then."""
        if self.moment.operation:
            self.wait_for("struck")
        else:
            time.sleep(self.moment.seconds)
            self._happens(rng)
        self.at = time.time()

    def end(self, seconds: float = LEFT) -> bool:
        """Wait until it has ended, and all that it began; kill what has not, and say so."""
        try:
            self.process.wait(seconds)
            until = time.monotonic() + LEAVING
            while group(self.process.pid) and time.monotonic() < until:
                time.sleep(0.05)
        except subprocess.TimeoutExpired:
            pass
        left = group(self.process.pid)
        if left:
            os.killpg(self.process.pid, signal.SIGKILL)
        self.process.wait()
        self._reader.join()  # until nobody has the other end any more
        if self._reads:
            os.close(self._ours)
        return not left

    def _happens(self, rng: np.random.Generator) -> None:
        members = group(self.process.pid)
        if not members:
            return
        if self.fault == KILL:
            os.kill(int(rng.choice(members)), signal.SIGKILL)
        elif self.fault in SIGNALS:
            self.process.send_signal(SIGNALS[self.fault])
        elif self.fault in JUMPS:
            with (self._folder / "clock").open("r+b") as file, mmap.mmap(file.fileno(), 8) as clock:
                clock[:] = np.float64(JUMPS[self.fault]).tobytes()
        elif self.fault == DISK_FULL:
            fill_disk(members)
        else:
            self._fill_pipe()

    def _fill_pipe(self) -> None:
        """Read no more until the pipe is full, for a while, then close it."""
        self._reads = False
        self._reader.join()
        full = os.open(f"/proc/self/fd/{self._ours}", os.O_WRONLY | os.O_NONBLOCK)
        try:
            while True:
                os.write(full, b"." * 4096)
        except BlockingIOError:
            time.sleep(HELD)
        os.close(full)
        os.close(self._ours)

    def _read(self) -> None:
        while self._reads:
            if select.select([self._ours], [], [], 0.02)[0]:
                data = os.read(self._ours, 1 << 16)
                if not data:
                    return
                self.said += data.decode(errors="replace")


def environment(folder: Path) -> dict[str, str]:
    """Return what makes the clock of a process one that can be set."""
    path = os.pathsep.join((str(folder / "site"), os.environ.get("PYTHONPATH", "")))
    return os.environ | {
        "PYTHONPATH": path, "STRUCK_CLOCK": str(folder / "clock"),
        "EQUIPOISE_RUNS": str(folder / "runs"),
    }  # fmt: skip


def fill_disk(members: Sequence[int]) -> None:
    """Let no file of these processes grow any more."""
    for pid in members:
        try:
            resource.prlimit(pid, resource.RLIMIT_FSIZE, (0, resource.RLIM_INFINITY))
        except ProcessLookupError:
            continue


def group(leader: int) -> list[int]:
    """Return the processes of a group that have not ended."""
    found: list[int] = []
    for place in Path("/proc").glob("[0-9]*/stat"):
        try:
            state, _, leader_of, *_ = place.read_text().rpartition(")")[2].split()
        except OSError:
            continue
        if int(leader_of) == leader and state not in "ZX":
            found.append(int(place.parent.name))
    return found
