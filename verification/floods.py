"""The dashboard flooded with connections, requests and malformed messages; a page stays open.

Memory and the latency of a small file are measured before and a minute after. What a flood does to
a second page that is opened amid it is not judged: it may have to wait a few seconds.
"""

import tempfile
import time
from collections.abc import Sequence
from http.client import HTTPConnection
from pathlib import Path

import numpy as np
from websockets.sync.client import connect

from equipoise.model.units import MINUTE
from tests.support.dashboard_program import Dashboard, dashboard
from tests.support.floods import is_closed, malformed, requested, silent
from tests.support.page_by_hand import opened
from verification.processes import resident
from verification.result import Result, Row, Spread, at_least, at_most, in_turn

CONNECTIONS, REQUESTS, MESSAGES = 3000, 10_000, 1000
AT_ONCE = 500  # connections that this process holds open
LATENCY, GROWN = 0.1, 0.2  # s; of the memory before
FILE = "/static/page.js"


def latencies(running: Dashboard, count: int = 50) -> list[float]:
    """Return how long (s) a small file takes, each on a new connection."""
    found: list[float] = []
    for _ in range(count):
        began = time.perf_counter()
        line = HTTPConnection("127.0.0.1", running.port, timeout=30)
        line.request("GET", FILE)
        line.getresponse().read()
        line.close()
        found.append(time.perf_counter() - began)
    return found


def flooded_with_connections(running: Dashboard) -> float:
    """Return the share of silent connections that the server has closed in the end."""
    closed = 0
    for _ in range(CONNECTIONS // AT_ONCE):
        lines = silent(running, AT_ONCE)
        time.sleep(6.0)  # longer than a silent connection is kept
        closed += sum(map(is_closed, lines))
        for line in lines:
            line.close()
    return closed / CONNECTIONS


def flooded_with_messages(running: Dashboard) -> int:
    """Send malformed messages, page after page; return how many."""
    sent = 0
    while sent < MESSAGES:
        time.sleep(1.0)  # pages are opened no oftener than this
        with opened(running.url, running.port) as page:
            page.commands(running.token)
            sent += malformed(page, 230)
            page.releases()
    return sent


def flooded(_: int) -> tuple[float, ...]:
    """Return what is measured of one dashboard; see ``measure``."""
    with tempfile.TemporaryDirectory() as name, dashboard(Path(name), "nanosat") as running:
        own = f"127.0.0.1:{running.port}"
        with connect(f"ws://{own}/live", origin=f"http://{own}", max_queue=None) as live:
            requested(running, 20)
            before = resident(running.process.pid)
            closed = flooded_with_connections(running)
            served = requested(running, REQUESTS)
            sent = flooded_with_messages(running)
            most = resident(running.process.pid)
            time.sleep(MINUTE)
            after = resident(running.process.pid)
            slowest = max(latencies(running))
            open_still = float(live.close_code is None)
    return closed, served[200] / REQUESTS, float(sent), most / before - 1, after / before - 1, (
        slowest
    ), open_still  # fmt: skip


def measure(seeds: Sequence[int], spread: Spread = in_turn) -> Result:
    """Measure a dashboard for each seed, one after the other."""
    found = np.array(list(spread(flooded, list(seeds))))
    closed, pages, sent, most, after, slowest, open_still = found.T
    claim = (
        f"A dashboard on loopback, flooded with {CONNECTIONS} connections that finish no request, "
        f"{REQUESTS} requests for the page and {MESSAGES} malformed messages of a page that "
        f"commands; {len(found)} times."
    )
    rows: tuple[Row, ...] = (
        at_least("silent connections that were closed", closed.min(), 1.0, ".1%"),
        at_least("malformed messages", sent.min(), MESSAGES, ".0f"),
        at_least("page that was open stayed so", open_still.min(), 1.0, ".0%"),
        at_most("memory a minute later: growth", after.max(), GROWN, ".1%"),
        at_most("slowest of 50 small files a minute later, s", slowest.max(), LATENCY, ".3f"),
    )
    note = (
        f"Of the requests {pages.mean():.1%} were answered with a page, the rest refused (429). "
        f"At its end the memory had grown by {most.max():.1%}."
    )
    return Result("floods", claim, rows, (note,))
