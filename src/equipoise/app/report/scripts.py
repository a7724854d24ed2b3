"""The scripts and styles that a report carries, so that a browser asks nobody for anything.

Charts and 3-D view are the dashboard's own modules; those of a report are in ``page``. The modules
that a document needs are packed in the order in which they import each other, and unpacked by the
page (``page/load.js``).
"""

import base64
import gzip
import json
import re
from dataclasses import asdict
from functools import cache
from importlib.resources import files
from importlib.resources.abc import Traversable

from equipoise.app.text.blocks import Document
from equipoise.app.text.charts import Chart, Replay
from equipoise.app.text.escaping import for_json

OWN = files("equipoise.app.report") / "page"
SHARED = files("equipoise.app") / "dashboard" / "static"
IMPORTED = re.compile(r"""(from\s*)["']\./([^"']+)["']""")
THEMES = re.compile(r":root[^{}]*\{[^}]*\}")
FIRST, REPLAY, DATA = "start.js", "replay.js", "blocks.js"
STILL = (
    "The figures of this report do not move: the page libraries of this installation are missing. "
    "An installation from a wheel has them; in a source folder, run `make`."
)


def packed(document: Document) -> str | None:
    """Return data and modules of a document's charts as gzip in base64; empty if it has none.

    None where a module is not installed.
    """
    blocks = [block for section in document.sections for block in section.blocks
              if isinstance(block, Chart | Replay)]  # fmt: skip
    if not blocks:
        return ""
    first = (FIRST, REPLAY) if any(isinstance(b, Replay) for b in blocks) else (FIRST,)
    data = for_json(json.dumps({block.name: asdict(block) for block in blocks}))
    modules = {DATA: f"export const blocks = {data};"}
    try:
        for name in first:
            _collect(name, modules)
    except FileNotFoundError:
        return None
    text = json.dumps({"modules": list(modules.items()), "first": first})
    return base64.b64encode(gzip.compress(text.encode(), mtime=0)).decode()


def loader() -> str:
    """Return the script that unpacks the modules and runs them."""
    return (OWN / "load.js").read_text(encoding="utf-8")


@cache
def style() -> str:
    """Return colours, page and charts as one style sheet."""
    colours = THEMES.findall((SHARED / "style.css").read_text(encoding="utf-8"))
    own = (OWN / "page.css").read_text(encoding="utf-8")
    plots = SHARED / "vendor" / "uPlot.min.css"
    of_plots = plots.read_text(encoding="utf-8") if plots.is_file() else ""
    return "\n".join((of_plots, *colours, own))


def _collect(name: str, modules: dict[str, str]) -> None:
    """Add a module after those that it imports."""
    text = _file(name).read_text(encoding="utf-8")
    folder = name.rpartition("/")[0]
    for _, imported in IMPORTED.findall(text):
        needed = _beside(folder, imported)
        if needed not in modules:
            _collect(needed, modules)
    modules[name] = IMPORTED.sub(
        lambda match: f'{match[1]}"module:{_beside(folder, match[2])}"', text
    )


def _file(name: str) -> Traversable:
    own = OWN / name
    return own if own.is_file() else SHARED / name


def _beside(folder: str, name: str) -> str:
    return f"{folder}/{name}" if folder else name
