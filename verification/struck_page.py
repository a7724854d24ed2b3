"""A dashboard's runner that records, and to which something happens: does the page say what is so?

Here is the page's end of the pipe. What it has been shown is compared with the file.
"""

import mmap
import os
import threading
import time
from multiprocessing import Pipe, get_context
from pathlib import Path
from typing import Any

import numpy as np

from equipoise.app.dashboard.protocol import requests
from equipoise.app.dashboard.runner.runner_process import Opening, run_runner
from equipoise.io.recording.recording_file import read_recording
from equipoise.io.testbed.presets import read_preset
from verification.struck_program import (
    CLOCK,
    DISK_FULL,
    FULL_PIPE,
    HELD,
    JUMPS,
    KILL,
    SIGNALS,
    environment,
    fill_disk,
)

READY, LEFT = 120.0, 60.0  # s, chosen: to begin, on a slow computer; to end
LONGEST = 4.0  # s, chosen: of a recording before it happens; a platform falls some seconds later
AFTER = 2.0  # s, chosen: in which the page goes on
TURN = 0.2  # s of the bench, between what is recorded and what the page was sent last


class Page:
    """The page's end: the last state, and bench time of the last rows."""

    def __init__(self, pipe: Any) -> None:
        self._pipe, self._reads = pipe, True
        self.state: dict[str, Any] = {}
        self.steps: list[str] = []
        self.t, self.ready, self.ended = 0.0, False, False
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def stop_reading(self) -> None:
        """Read no more."""
        self._reads = False
        self._reader.join()

    def until(self, there: Any, seconds: float) -> bool:
        """Wait for something; say whether it came about."""
        end = time.monotonic() + seconds
        while not there() and time.monotonic() < end:
            time.sleep(0.01)
        return bool(there())

    def _read(self) -> None:
        try:
            while self._reads:
                if self._pipe.poll(0.02):
                    self._take(*self._pipe.recv())
        except (EOFError, OSError):
            self.ended = True

    def _take(self, kind: str, what: Any) -> None:
        if kind == "state":
            self.state, self.t = what, max(self.t, what["t"])
        elif kind == "step":
            self.steps.append(what["sentence"])
        self.ready |= kind == "ready"


def struck_page(
    folder: Path, fault: str, rng: np.random.Generator
) -> tuple[tuple[str, ...], float]:
    """Let a runner record, let the fault happen; return what is wrong, and s that were lost."""
    ours, theirs = Pipe()
    (folder / "site").mkdir()
    (folder / "site" / "sitecustomize.py").write_text(CLOCK)
    (folder / "clock").write_bytes(bytes(8))
    before = dict(os.environ)
    os.environ.update(environment(folder))
    try:
        opening = Opening(read_preset("nanosat"), folder, int(rng.integers(1, 1000)))
        process = get_context("spawn").Process(target=run_runner, args=(theirs, opening))
        process.start()
    finally:
        os.environ.clear()
        os.environ.update(before)
    theirs.close()
    page = Page(ours)
    try:
        return _struck(folder, (process, ours), page, fault, float(rng.uniform(0.0, LONGEST)))
    finally:
        process.kill()
        process.join()


def _struck(
    folder: Path, runner: tuple[Any, Any], page: Page, fault: str, moment: float
) -> tuple[tuple[str, ...], float]:
    process, pipe = runner
    if not page.until(lambda: page.ready, READY):
        return ("it has not begun",), 0.0
    for request in (requests.Pause(False), requests.Record(True)):
        pipe.send(request)
    page.until(lambda: page.state.get("recording"), LEFT)
    path = folder / page.state["recording"]
    time.sleep(moment)
    shown, size = page.t, path.stat().st_size
    _happens(folder, runner, page, fault)
    wrong = _untrue(page, path, fault, size)
    page.stop_reading()
    pipe.close()
    process.join(LEFT)
    if process.exitcode not in ((0,) if fault != KILL else (-SIGNALS[KILL],)):
        wrong.append(f"code {process.exitcode}")
    kept = read_recording(path).attitude
    assert kept is not None
    jumped = np.diff(kept.t).max() > 1.0 or np.diff(kept.t).min() <= 0
    wrong += ["rows whose times jump"] * bool(jumped)
    return tuple(wrong), max(shown - float(kept.t[-1]), 0.0)


def _happens(folder: Path, runner: tuple[Any, Any], page: Page, fault: str) -> None:
    process, _ = runner
    if fault in SIGNALS:
        os.kill(process.pid, SIGNALS[fault])
    elif fault in JUMPS:
        with (folder / "clock").open("r+b") as file, mmap.mmap(file.fileno(), 8) as clock:
            clock[:] = np.float64(JUMPS[fault]).tobytes()
    elif fault == DISK_FULL:
        fill_disk([process.pid])
    else:
        page.stop_reading()
        time.sleep(HELD)


def _untrue(page: Page, path: Path, fault: str, size: int) -> list[str]:
    """Return what the page was shown that is not so."""
    if fault == KILL:
        return ["it goes on"] * (not page.until(lambda: page.ended, LEFT))
    if fault == FULL_PIPE:
        return []
    if fault == DISK_FULL:
        page.until(lambda: page.state["recording"] is None, LEFT)
        said = any("recording stopped" in step and str(path) in step for step in page.steps)
        wrong = ["it records, the page says"] * (page.state["recording"] is not None)
        wrong += ["no sentence"] * (not said)
    else:
        wrong = ["nothing is recorded, the page says"] * (page.state["recording"] is None)
        grows = page.until(lambda: path.stat().st_size > size, LEFT)
        wrong += ["it does not grow"] * (not grows)
    end = page.t + AFTER

    def goes_on() -> bool:
        """Its time goes on, unless the platform tilted to its limit and was caught."""
        return page.t > end or page.state["phase"] == "paused"

    return wrong + ["the view stands still"] * (not page.until(goes_on, LEFT))
