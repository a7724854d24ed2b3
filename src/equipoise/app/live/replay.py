"""A recording shown at a speed: the clock, the lines for a person, other onlookers."""

import math
import time
from collections.abc import Generator, Mapping
from contextlib import contextmanager
from functools import partial

import numpy as np
from rich.console import Console
from rich.live import Live

from equipoise.app.bench.lost_onlookers import complain_of
from equipoise.app.console.terminal import stdout
from equipoise.app.live.latest_rows import Newest, after, masses_of, tilt_of, time_of
from equipoise.app.live.observed_bench import Onlooker
from equipoise.app.live.pace import Pace
from equipoise.app.live.status_block import TerminalView
from equipoise.hardware.bench.onlookers import Onlookers
from equipoise.hardware.bench.replayed_bench import RecordingEnded, ReplayedBench
from equipoise.io.formats.clock_units import nanoseconds
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed

FRAME = 0.1  # s, chosen: as often as a person can follow numbers
LINE = 1.0  # s of the recording from line to line, where there is no terminal (chosen)


def begun(recording: Recording, speed: float) -> tuple[Pace, int]:
    """Return a pace that begins now (0: as fast as possible) and UTC at time zero, ns.

    The recording's first row counts as arriving now, at one moment of both.
    """
    pace = Pace(speed, lagging=math.inf)  # readings keep to the speed, whatever each takes
    return pace, time.time_ns() - nanoseconds(recording.span[0])


def replayed(
    testbed: Testbed, recording: Recording, pace: Pace, onlookers: Mapping[str, Onlooker]
) -> None:
    """Show a recording from its beginning to its end at a pace, or until nobody looks on."""
    shown = Onlookers[Onlooker](_lost)
    for name, onlooker in onlookers.items():
        shown.add(name, onlooker)
    bench = ReplayedBench(testbed, recording, lambda passed: time.sleep(pace.wait(passed)))
    step = FRAME * (pace.speed or LINE / FRAME)
    while len(shown):
        try:
            rows = bench.read(step)
        except RecordingEnded:
            return
        shown.hand_on(partial(_show, rows))


def _show(rows: Recording, onlooker: Onlooker) -> None:
    onlooker(rows)


def _lost(name: str, error: Exception) -> None:
    """Go on without an onlooker; where nobody reads what is printed, there is nothing to do."""
    if isinstance(error, BrokenPipeError):
        raise error
    complain_of(name, error)


@contextmanager
def shown_lines(testbed: Testbed) -> Generator[Onlooker]:
    """Lend a function that shows the newest rows: in place at a terminal, else line by line."""
    console = stdout()
    if not console.is_interactive:
        yield _Lines(testbed, console).rows
        return
    view = TerminalView(testbed)

    def show(rows: Recording) -> None:
        view.rows(rows)
        live.update(view, refresh=True)

    with Live(console=console, auto_refresh=False) as live:
        yield show


class _Lines:
    """A line for every second of the recording."""

    def __init__(self, testbed: Testbed, console: Console) -> None:
        self._up, self._console = testbed.up, console
        self._newest, self._reported = Newest(), -np.inf

    def rows(self, rows: Recording) -> None:
        """Print a line if a second has passed since the last."""
        self._newest = newest = after(self._newest, rows, self._up)
        if newest.time - self._reported < LINE * (1 - 1e-9):
            return
        self._reported = newest.time
        texts = (time_of(newest), tilt_of(newest), *masses_of(newest))
        self._console.print("  ".join(filter(None, texts)))
