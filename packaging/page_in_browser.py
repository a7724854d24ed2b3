"""Open the dashboard's page in Chromium, as the environment of check_wheel.py's browser runs it.

    python packaging/page_in_browser.py CHROMIUM URL PICTURE

Exit code 1 with the faults on stderr: a page that does not connect or draws nothing, an error or a
warning on its console, a request to anywhere but the dashboard.
"""

import sys
from typing import Any
from urllib.parse import urlsplit

from playwright.sync_api import Page, sync_playwright

LATER = 120_000  # ms, chosen: for the first kernels of a slow computer
SETTLED = 3_000  # ms, chosen: some turns of the charts
ARGUMENTS = [
    "--no-sandbox",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
]
# Canvases of scene and charts that have a size and more than one colour.
DRAWN = """canvases => canvases.filter(each => {
    if (!each.width || !each.height) return false;
    const copy = document.createElement("canvas");
    [copy.width, copy.height] = [each.width, each.height];
    const pen = copy.getContext("2d");
    pen.drawImage(each, 0, 0);
    const dots = new Uint32Array(pen.getImageData(0, 0, copy.width, copy.height).data.buffer);
    return dots.some(dot => dot !== dots[0]);
}).length"""


def main(chromium: str, url: str, picture: str) -> int:
    """Open the page and look at it."""
    with sync_playwright() as play:
        browser = play.chromium.launch(executable_path=chromium, args=ARGUMENTS)
        page = browser.new_page(viewport={"width": 1280, "height": 720})
        faults = watched(page, urlsplit(url).netloc)
        page.goto(url)
        page.get_by_text("connected").first.wait_for(timeout=LATER)
        page.wait_for_timeout(SETTLED)
        drawn = page.locator("canvas").evaluate_all(DRAWN)
        page.screenshot(path=picture)
        browser.close()
    if drawn == 0:
        faults.append("no canvas is drawn on")
    print("\n".join(faults) or f"{drawn} canvases drawn", file=sys.stderr if faults else sys.stdout)
    return 1 if faults else 0


def watched(page: Page, host: str) -> list[str]:
    """Return the list to which the page's faults will be added."""
    faults: list[str] = []

    def said(message: Any) -> None:
        if message.type in ("error", "warning"):
            faults.append(f"console: {message.text}")

    def requested(thing: Any) -> None:
        parts = urlsplit(thing.url)
        if parts.scheme not in ("data", "blob") and parts.netloc != host:
            faults.append(f"request to {thing.url}")

    page.on("console", said)
    page.on("pageerror", lambda error: faults.append(f"error: {error}"))
    page.on("request", requested)
    page.on("websocket", requested)
    return faults


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
