"""The dashboard as a program, and Debian's Chromium in front of it."""

import os
import re
import shutil
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
ARGUMENTS = (
    "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-quic",
    "--no-first-run", "--disable-background-networking", "--disable-component-update",
    "--disable-sync",
)  # fmt: skip
START = 240.0  # s: to compile what has to be compiled once


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


@dataclass
class Dashboard:
    """A running program."""

    process: subprocess.Popen
    url: str
    token: str
    port: int
    folder: Path

    def kill(self):
        """End the server as a crash would."""
        self.process.kill()
        self.process.wait()

    def end(self, number=signal.SIGINT):
        """End it as Ctrl-C does, or another signal; return its exit code."""
        if self.process.poll() is None:
            self.process.send_signal(number)
        try:
            return self.process.wait(30)
        except subprocess.TimeoutExpired:
            self.kill()
            raise


def started(folder: Path, *words: object, port: int | None = None) -> Dashboard:
    """Start the program and wait for what it prints."""
    return _started(folder, "dashboard", words, port)


def _started(folder: Path, command_name: str, words: Sequence[object], port: int | None):
    port, log = port or free_port(), folder / "printed.txt"
    command = [sys.executable, "-m", "equipoise.app.cli", command_name, *map(str, words),
               "--port", str(port)]  # fmt: skip
    own = os.environ | {"EQUIPOISE_RUNS": str(folder / "runs"), "PYTHONUNBUFFERED": "1"}
    with log.open("w") as file:
        process = subprocess.Popen(command, stdout=file, stderr=file, env=own, cwd=folder)
    until = time.monotonic() + START
    while time.monotonic() < until and process.poll() is None:
        said = log.read_text()
        if "Ctrl-C" in said:
            url = re.search(r"The \w+ is at (\S+)", said)[1]
            token = re.search(r"command: (\S+)", said)
            return Dashboard(process, url, token[1] if token else "", port, folder)
        time.sleep(0.1)
    process.kill()
    raise AssertionError(log.read_text())


@contextmanager
def dashboard(folder: Path, *words: object, ended_with: int = signal.SIGINT) -> Iterator[Dashboard]:
    """Lend a running dashboard, which ends without a fault."""
    yield from _lent(started(folder, *words), ended_with)


@contextmanager
def viewer(folder: Path, *words: object) -> Iterator[Dashboard]:
    """Lend a running viewer of a recording, which has no token and ends without a fault."""
    yield from _lent(_started(folder, "replay", words, None), signal.SIGINT)


def _lent(running: Dashboard, ended_with: int) -> Iterator[Dashboard]:
    try:
        yield running
    finally:
        code = running.end(ended_with)
    assert code == 0
    assert "Traceback" not in (running.folder / "printed.txt").read_text()


@contextmanager
def browser(*others: str) -> Iterator[Any]:
    """Lend a browser that asks nobody but us; ``others`` are arguments of its own."""
    from playwright.sync_api import sync_playwright

    with sync_playwright() as play:
        opened = play.chromium.launch(executable_path=CHROMIUM, args=[*ARGUMENTS, *others])
        yield opened
        opened.close()


class Received:
    """What a page says on its console, and whom it asks."""

    def __init__(self, page):
        self.said, self.requested = [], set()
        page.on("console", lambda message: self.said.append((message.type, message.text)))
        page.on("pageerror", lambda error: self.said.append(("error", str(error))))
        page.on("request", lambda request: self.requested.add(request.url.split("/")[2]))
        page.on("websocket", lambda socket: self.requested.add(socket.url.split("/")[2]))

    @property
    def wrong(self):
        return [text for kind, text in self.said if kind in ("error", "warning")]


SIZES = {"laptop": (1280, 720), "tablet": (768, 1024), "phone": (390, 844)}


def pictures(page, folder: Path, name: str, faults: Callable[[Any], list] = lambda _: []) -> list:
    """Take pictures of a page at three sizes; return where it is too wide, and other faults.

    EQUIPOISE_SCREENSHOTS names a folder to keep them in.
    """
    found = []
    kept = Path(os.environ.get("EQUIPOISE_SCREENSHOTS") or folder)
    kept.mkdir(parents=True, exist_ok=True)
    for size, (width, height) in SIZES.items():
        page.set_viewport_size({"width": width, "height": height})
        page.wait_for_timeout(1200)
        page.screenshot(path=kept / f"{name}-{size}.png", full_page=True)
        if page.evaluate("document.documentElement.scrollWidth") > width:
            found.append(f"{size}: wider than the screen")
        found += [f"{size}: {fault}" for fault in faults(page)]
    return found


def barriers(page) -> list[str]:
    """Return what axe-core calls a serious or critical fault for people with disabilities."""
    from axe_playwright_python.sync_playwright import Axe

    found = Axe().run(page).response["violations"]
    return [
        f"{each['id']}: {each['nodes'][0]['html']} {each['nodes'][0]['failureSummary']}"
        for each in found
        if each["impact"] in ("serious", "critical")
    ]
