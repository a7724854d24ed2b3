"""The newest numbers of a bench while something runs, as a block of lines at the terminal.

A view: every number was measured or is a procedure's. The block stands above the sign of life
(``terminal.busy``) and is drawn by rich's thread, which must neither stop a bench nor disturb the
printing of results: so it draws what never changes, and says what it cannot draw.
"""

import math
from collections.abc import Sequence
from pathlib import Path

from rich.console import Console, ConsoleOptions, RenderResult
from rich.text import Text

from equipoise.app.console.terminal import stderr
from equipoise.app.live.latest_rows import SPAN, Newest, after, tilt_of
from equipoise.app.live.observed_bench import WatchedBench
from equipoise.app.text.com_estimate import com_after
from equipoise.app.text.numbers import fixed
from equipoise.app.text.sparkline import BLOCKS, PLAIN, in_columns, sparkline
from equipoise.model.bench import Bench
from equipoise.model.recording import Recording
from equipoise.model.step import Step
from equipoise.model.testbed import Testbed
from equipoise.model.units import DEG, MM, UM
from equipoise.simulation.bench import SimulatedBench

SLICE = 0.125  # s, chosen: as often as the block is drawn
INDENT, GAP = "  ", "  "
NAMES, WIDE = 10, 60  # letters: of the longest name; of a terminal that has room for a column of it
GREATEST = " to 123.4 deg, 60 s"
AXES = "xyz"


class TerminalView:
    """The newest numbers of a bench, to be drawn at any time; ``rows`` and ``step`` update them."""

    def __init__(self, testbed: Testbed) -> None:
        self.testbed, self.newest = testbed, Newest()
        self._step: Step | None = None  # the last that says where the centre of mass is

    def rows(self, rows: Recording) -> None:
        """Take in new rows."""
        self.newest = after(self.newest, rows, self.testbed.up)

    def step(self, step: Step) -> None:
        """Take in a step of a procedure."""
        if step.estimate is not None or step.verdict is not None:
            self._step = step

    def lines(self) -> list[list[str]]:
        """Return what is known, in groups: a name, and short texts."""
        return [self._motion(), self._masses(), self._offset()]

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        """Draw, cropped to the terminal."""
        try:
            lines = self._lines(options.max_width, options.ascii_only)
        except Exception as error:
            lines = [f"{INDENT}the view has failed, the bench continues: {error!r}"]
        yield Text()  # apart from the steps above
        for line in lines:
            yield Text(line, no_wrap=True, overflow="crop")

    def _lines(self, width: int, plain: bool) -> list[str]:
        lines = [line for group in self.lines() if group for line in filled(group, width)]
        return lines + self._course(width, plain)

    def _motion(self) -> list[str]:
        newest = self.newest
        reported = ["bench time", f"{newest.time:8.1f} s"]
        if newest.tilt is not None:
            reported.append(f"{tilt_of(newest)} (limit {self.testbed.tilt_limit / DEG:g})")
        if newest.rate is not None:
            reported.append(f"rate {newest.rate / DEG:6.2f} deg/s")
        return reported

    def _masses(self) -> list[str]:
        reported = [f"{name} {at / MM:6.2f}" for name, at in self.newest.masses.items()]
        return ["masses, mm", *reported] if reported else []

    def _course(self, width: int, plain: bool) -> list[str]:
        """Return the sparkline of the tilt with its greatest value; no line before there is one."""
        indent = len(INDENT) + (NAMES + len(GAP) if width >= WIDE else 0)
        columns, seconds = in_columns(self.newest.tilts, SPAN, width - indent - len(GREATEST))
        if not columns:
            return []
        greatest = max(value for value in columns if value is not None) / DEG
        drawn = sparkline(columns, PLAIN if plain else BLOCKS)
        name = f"{'tilt':{indent - len(INDENT)}s}" if width >= WIDE else ""
        return [f"{INDENT}{name}{drawn} to {greatest:.1f} deg, {seconds} s"]

    def _offset(self) -> list[str]:
        """Return the last estimate of the centre of mass, um."""
        estimated = None if self._step is None else com_after(self._step)
        if self._step is None or estimated is None:
            return []
        pairs = zip(AXES, estimated.com / UM, estimated.sd / UM, strict=True)
        reported = [f"{axis} {_um(float(value), float(sd))}" for axis, value, sd in pairs]
        return ["com, um", *reported, f"at {self._step.time:.1f} s"]


class RecordingView(TerminalView):
    """The newest numbers, and what share of the record there is, in which file."""

    def __init__(self, testbed: Testbed, file: Path, begin: float, duration: float) -> None:
        super().__init__(testbed)
        self._file, self._begin, self._duration = file, begin, duration

    def lines(self) -> list[list[str]]:
        """Return what is known, in groups: a name, and short texts."""
        share = min(max(self.newest.time - self._begin, 0.0) / self._duration, 1.0)
        done = ["record", f"{share:4.0%} of {self._duration:g} s", self._file.name]
        rows = [f"{name} {number}" for name, number in self.newest.counts.items()]
        return [*super().lines(), done, ["rows", *rows] if rows else []]


def filled(group: Sequence[str], width: int) -> list[str]:
    """Return a name and texts side by side, as many to a line as it has room for."""
    name, *texts = group
    lines = [INDENT + (f"{name:{NAMES}s}" if width >= WIDE else name)]
    for text in texts:
        if len(lines[-1]) + len(GAP) + len(text) <= width:
            lines[-1] += GAP + text
        else:
            lines.append(INDENT + text)
    return lines


def watched_by(view: TerminalView, bench: Bench) -> Bench:
    """Return a bench whose rows a view gets, if there is a terminal to draw it at.

    A simulated bench is not cut into slices: it is faster than anybody can read.
    """
    if not stderr().is_interactive:
        return bench
    each = math.inf if isinstance(bench, SimulatedBench) else SLICE
    return WatchedBench(bench, view.rows, each)


def _um(value: float, sd: float) -> str:
    """Return a coordinate in the digits of the steps' sentences."""
    return f"{fixed(value, 1)} +/- {fixed(sd, 1)}" if math.isfinite(sd) else "unobservable"
