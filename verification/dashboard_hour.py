"""An hour of the dashboard: attitude and rate at 100 Hz, one page in a browser looking on.

A simulated platform swings as it likes; server, runner and page are processes of their own, and the
system counts each one's processor time and memory. The page's own heap is looked at after the
browser was made to collect what nobody holds. A page draws in software here, in the browser's
process for graphics, which a graphics card would do elsewhere: that process is told, not judged.
"""

import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from equipoise.io.testbed.presets import read_preset
from equipoise.io.testbed.testbed_file import write_testbed
from equipoise.model.testbed import Testbed
from equipoise.model.units import MINUTE
from tests.support.dashboard_program import Dashboard, browser, dashboard
from verification.processes import resident, spent
from verification.result import Result, Row, Spread, at_least, at_most, in_turn

RATE = 100.0  # Hz
BEGUN = 10  # min, chosen: by then the server keeps as many rows as it ever does
SHARE, GROWN = 0.15, 0.05  # of one core; of the memory at the tenth minute
LAST = "window.equipoise.state().series.pose?.last?.[0] ?? 0"  # s


@dataclass(frozen=True, slots=True)
class Observed:
    """How far all have come at one time: each process's seconds and MB, by name."""

    clock: float  # s, on the wall
    bench: float  # s, of the last attitude that the page has
    seconds: dict[str, float]
    megabytes: dict[str, float]


def testbed() -> Testbed:
    """Return the preset at 100 Hz, hanging low, with nothing to hold it back."""
    bed = read_preset("nanosat")
    assert bed.attitude is not None
    assert bed.gyro is not None
    assert bed.truth is not None
    low = replace(bed.truth, com_low=np.array([0, 0, -3e-4]), com_high=np.array([0, 0, -3e-4]))
    return replace(
        bed,
        attitude=replace(bed.attitude, rate=RATE),
        gyro=replace(bed.gyro, rate=RATE),
        tilt_limit=3.0,
        truth=low,
    )


def runner_of(server: int) -> int:
    """Return the server's child that has the bench: it works most."""
    children = Path(f"/proc/{server}/task/{server}/children").read_text().split()
    return max(map(int, children), key=spent)


class Watched:
    """A page in front of a dashboard, and the processes of both."""

    def __init__(self, chromium: Any, running: Dashboard) -> None:
        self.page = chromium.new_page(viewport={"width": 1280, "height": 720})
        self.page.goto(running.url)
        self.page.wait_for_function(
            "() => window.equipoise?.state().link === 'open'", timeout=120_000
        )
        self._tab = self.page.context.new_cdp_session(self.page)
        self._tab.send("HeapProfiler.enable")
        found = chromium.new_browser_cdp_session().send("SystemInfo.getProcessInfo")["processInfo"]
        server = running.process.pid
        self.processes = {
            "server": [server],
            "runner": [runner_of(server)],
            "page": [each["id"] for each in found if each["type"] == "renderer"],
            "drawing": [each["id"] for each in found if each["type"] == "GPU"],
        }

    def let_go(self, token: str, speed: str) -> None:
        """Take command and let the platform swing."""
        page = self.page
        page.get_by_label("Token").fill(token)
        page.keyboard.press("Enter")
        page.get_by_role("tab", name="Bench").click()
        page.get_by_label("Speed", exact=True).click()
        page.get_by_role("option", name=speed, exact=True).click()
        page.get_by_role("button", name="Let go", exact=True).click()

    def observed(self) -> Observed:
        """Return how far all have come."""
        self._tab.send("HeapProfiler.collectGarbage")
        heap = self._tab.send("Runtime.getHeapUsage")["usedSize"] / 1e6
        pose = self.page.evaluate(LAST)
        return Observed(
            time.monotonic(),
            float(pose),
            {name: sum(map(spent, each)) for name, each in self.processes.items()},
            {name: sum(map(resident, each)) for name, each in self.processes.items()}
            | {"heap": heap},
        )


def soaked(measurements: int, every: float = MINUTE, speed: str = "real time") -> list[Observed]:
    """Let a dashboard run, and look so many times, so long (s) apart, after a first look."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        write_testbed(testbed(), folder / "swinging.toml")
        with dashboard(folder, "swinging.toml") as running, browser() as chromium:
            watched = Watched(chromium, running)
            watched.let_go(running.token, speed)
            watched.page.wait_for_timeout(2000)
            observed = [watched.observed()]
            for _ in range(measurements):
                watched.page.wait_for_timeout(1000 * every)
                observed.append(watched.observed())
    return observed


def share(observed: Sequence[Observed], name: str) -> float:
    """Return a process's share of one core, from the first look to the last."""
    first, last = observed[0], observed[-1]
    return (last.seconds[name] - first.seconds[name]) / (last.clock - first.clock)


def growth(observed: Sequence[Observed], name: str) -> float:
    """Return the growth of memory over the looks, as a share, by the straight line through them."""
    held = np.array([each.megabytes[name] for each in observed])
    t: NDArray[np.float64] = np.linspace(-0.5, 0.5, len(held))
    return float(t @ held / (t @ t) / held.mean())


def measure(seeds: Sequence[int], spread: Spread = in_turn) -> Result:
    """Measure one run of as many minutes as there are seeds."""
    (observed,) = spread(soaked, [len(seeds)])
    bench, clock = observed[-1].bench - observed[0].bench, observed[-1].clock - observed[0].clock
    later = observed[min(BEGUN, len(observed) // 2) :]
    claim = (
        f"A simulated platform with attitude and rate at {RATE:g} Hz, shown live for "
        f"{clock / 60:.0f} minutes to one page of 1280 x 720 in Chromium."
    )
    rows: tuple[Row, ...] = (
        at_least("bench time on the page over real time", bench / clock, 0.995, ".4f"),
        at_most("server: share of one core", share(observed, "server"), SHARE, ".1%"),
        at_most("page: share of one core", share(observed, "page"), SHARE, ".1%"),
        at_most("server: growth of memory", growth(later, "server"), GROWN, ".1%"),
        at_most("page: growth of its heap", growth(later, "heap"), GROWN, ".1%"),
        at_most("page: growth of its process", growth(later, "page"), GROWN, ".1%"),
        at_most("runner: growth of memory", growth(later, "runner"), GROWN, ".1%"),
    )
    last = observed[-1].megabytes
    note = (
        f"The runner, with the simulated bench and the live estimate, takes "
        f"{share(observed, 'runner'):.1%} of a core; drawing in software "
        f"{share(observed, 'drawing'):.1%}. "
        f"At the end the server holds {last['server']:.0f} MB, the runner {last['runner']:.0f} MB, "
        f"the page {last['page']:.0f} MB, {last['heap']:.1f} MB of them its heap."
    )
    return Result("dashboard_hour", claim, rows, (note,))
