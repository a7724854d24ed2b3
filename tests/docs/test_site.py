"""The site builds without a warning, asks no other host, and keeps nobody out.

It is built once: reading all pages takes half a minute. Notebooks are run by tests of their own.
"""

import re
import subprocess
import sys
from pathlib import Path
from urllib.parse import urlsplit

import pytest

from docs.site.gathered import ROOT
from tests.support.dashboard_program import CHROMIUM, Received, barriers, browser, pictures

LOADED = re.compile(r"<(?:script|img|iframe|source|video|audio|embed)\b[^>]*?\bsrc=\"([^\"]*)\"")
LINKED = re.compile(r"<link\b[^>]*>")
IN_STYLE = re.compile(r"url\(\s*['\"]?([^'\")]+)|@import\s+['\"]([^'\"]+)")
PAGES = (
    "index", "reference/commands/identify", "reference/python/identify",
    "reference/python/Estimate", "gallery/index",
)  # fmt: skip
PICTURED = {"index", "gallery/index"}


def built(folder: Path) -> Path:
    """Build the site; a warning is an error, and nothing is said."""
    command = [sys.executable, "-m", "docs.site", str(folder)]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    return folder


def loaded(path: Path) -> list[str]:
    """Return what a browser fetches for a page or a style sheet by itself."""
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".css":
        return ["".join(found) for found in IN_STYLE.findall(text)]
    links = [
        href
        for tag in LINKED.findall(text)
        if re.search(r'rel="(?:stylesheet|icon|preload|preconnect|modulepreload)', tag)
        for href in re.findall(r'href="([^"]*)"', tag)
    ]
    return LOADED.findall(text) + links


def foreign(site: Path) -> list[str]:
    """Return each page that fetches something from another host, with what it is."""
    return [
        f"{path.relative_to(site)}: {target}"
        for kind in ("html", "css")
        for path in sorted(site.rglob(f"*.{kind}"))
        for target in loaded(path)
        if urlsplit(target).netloc
    ]


def faults(site: Path, folder: Path) -> list[str]:
    """Return serious faults by axe-core in both themes; take pictures of some pages."""
    found: list[str] = []
    with browser() as opened:
        for scheme in ("light", "dark"):
            page = opened.new_page(color_scheme=scheme)
            received = Received(page)
            for name in PAGES:
                page.goto((site / f"{name}.html").as_uri())
                shown = f"site-{scheme}-{name.replace('/', '-')}"
                pictured = name in PICTURED
                faults = pictures(page, folder, shown, barriers) if pictured else barriers(page)
                found += [f"{name}, {scheme}: {fault}" for fault in faults]
            assert received.requested == {""}  # files have no host
            page.close()
    return found


def test_the_site_is_whole_offline_and_open_to_all(tmp_path):
    site = built(tmp_path / "site")
    assert len(list(site.rglob("*.html"))) > 150
    assert len(list((site / "_images").glob("*.png"))) >= 10
    assert foreign(site) == []
    if CHROMIUM is None:
        pytest.skip("no chromium, so no page was looked at: apt-get install chromium")
    assert faults(site, tmp_path / "pictures") == []


def test_a_page_that_requests_another_host_is_found(tmp_path):
    (tmp_path / "page.html").write_text(
        '<link rel="stylesheet" href="https://x.org/a.css"><a href="https://fine.org">link</a>'
        '<script defer src="//y.org/b.js"></script><img src="own.png">'
    )
    (tmp_path / "style.css").write_text("@import 'https://z.org/c.css'; a { src: url(own.woff) }")
    assert foreign(tmp_path) == [
        "page.html: //y.org/b.js", "page.html: https://x.org/a.css", "style.css: https://z.org/c.css"
    ]  # fmt: skip
