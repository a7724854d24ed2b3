"""A recording shown at a speed: the clock, the line that a person sees, the others who look on."""

import time
from collections.abc import Callable, Generator, Sequence
from contextlib import contextmanager

import numpy as np
from rich.console import Console
from rich.live import Live
from rich.text import Text

from equipoise.app.terminal import stdout
from equipoise.hardware.replayed_bench import RecordingEnded, ReplayedBench
from equipoise.io.log_time import nanoseconds
from equipoise.maths.attitude import tilt
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed

FRAME = 0.1  # s, chosen: as often as a person can follow numbers
LINE = 1.0  # s of the recording from line to line, where there is no terminal (chosen)
Onlooker = Callable[[Recording], None]


class Pace:
    """A wait that keeps to a speed over all readings, whatever each of them takes."""

    def __init__(self, speed: float) -> None:
        self._speed, self._due = speed, time.monotonic()

    def __call__(self, duration: float) -> None:
        """Wait until a reading of this length (s of the recording) is over."""
        if self._speed:
            self._due += duration / self._speed
            time.sleep(max(self._due - time.monotonic(), 0.0))


def begun_ns(recording: Recording) -> int:
    """Return UTC at the recording's time zero (ns), as if its first row were seen now."""
    return time.time_ns() - nanoseconds(recording.span[0])


def replayed(
    testbed: Testbed, recording: Recording, speed: float, onlookers: Sequence[Onlooker]
) -> None:
    """Show a recording from its beginning to its end; 0: as fast as possible."""
    bench = ReplayedBench(testbed, recording, Pace(speed))
    step = FRAME * (speed or LINE / FRAME)
    while True:
        try:
            rows = bench.read(step)
        except RecordingEnded:
            return
        for onlooker in onlookers:
            onlooker(rows)


@contextmanager
def shown_lines(testbed: Testbed) -> Generator[Onlooker]:
    """Lend a function that shows the newest row: in place at a terminal, else line by line."""
    console, line = stdout(), _Line(testbed)
    if not console.is_terminal:
        yield lambda rows: _print(console, line.each_second(rows))
        return
    with Live(console=console, auto_refresh=False) as live:
        yield lambda rows: live.update(Text(line.newest(rows)), refresh=True)


def _print(console: Console, lines: Sequence[str]) -> None:
    for each in lines:
        console.print(each, markup=False)


class _Line:
    """The newest that is known of each channel, as a line."""

    def __init__(self, testbed: Testbed) -> None:
        self._testbed, self._told = testbed, -np.inf
        self._tilt, self._masses, self._t = "", "", 0.0

    def newest(self, rows: Recording) -> str:
        """Return the line after some rows."""
        if rows.attitude is not None:
            angle = float(tilt(rows.attitude.values[-1:], self._testbed.up)[0])
            self._tilt = f"tilt {np.degrees(angle):6.2f} deg"
        if rows.masses is not None:
            named = zip(rows.mass_names, rows.masses.values[-1] * 1e3, strict=True)
            self._masses = "  ".join(f"{name} {mm:7.2f} mm" for name, mm in named)
        ends = [float(c.t[-1]) for c in (rows.attitude, rows.rate, rows.masses) if c is not None]
        self._t = max([self._t, *ends])
        return "  ".join(filter(None, (f"{self._t:9.2f} s", self._tilt, self._masses)))

    def each_second(self, rows: Recording) -> list[str]:
        """Return the line if a second has passed since the last."""
        line = self.newest(rows)
        if self._t - self._told < LINE * (1 - 1e-9):
            return []
        self._told = self._t
        return [line]
