"""The parts of a report that the folder of a run holds, read as what a stranger may have written.

A document has a size; its figures are drawings (SVG) of the folder with plain names, which show
nothing that stands elsewhere.
"""

import re
from base64 import b64decode
from dataclasses import asdict
from pathlib import Path

from equipoise.app.text.blocks import Document, Table, document_of_text
from equipoise.app.text.charts import Chart, Heatmap, Replay, fault_of, numbers_within
from equipoise.app.text.escaping import texts_within
from equipoise.io.documents.run_folder import A_RUN
from equipoise.io.files.source_file import read_bytes
from equipoise.model.errors import InputError

DOCUMENT = "report.json"
# Chosen, some twenty times what the longest reports of our own have.
BYTES = 1 << 25  # of a file
BLOCKS, TEXTS, LETTERS, NUMBERS = 10_000, 100_000, 5_000_000, 1_000_000
PIXELS = 50_000_000  # of a picture within a drawing, chosen: that of a camera
NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]{0,99}")
PLAIN_NAME = "a plain name of letters, digits, dashes and underscores"
SIZE = slice(16, 24)  # bytes of a PNG with its width and height
EMBEDDED = re.compile(r"data:image/png;base64,\s*([A-Za-z0-9+/]{32})")
LINKED = re.compile(r"""href\s*=\s*["'](?!#|data:image/png;base64,\s*[A-Za-z0-9+/]{32})""")
ACTING = re.compile(r"<!ENTITY|<filter\b|<style[^>]*>[^<]*@import", re.IGNORECASE)


def saved_document(folder: Path) -> Document:
    """Return the document of a run's folder; InputError for what none of ours is."""
    path = folder / DOCUMENT
    document = document_of_text(_read(folder, path), str(path))
    _check_size(document, str(path))
    for name in document.figures:
        if NAME.fullmatch(name) is None:
            raise InputError(f"{path}: a figure", f"the name '{name}'", PLAIN_NAME)
    return document


def saved_drawing(folder: Path, path: Path) -> bytes:
    """Return a figure of the folder; InputError for what is none, or shows what is elsewhere."""
    content = _read(folder, path)
    fault = _fault_of_drawing(content)
    if fault:
        raise InputError(str(path), fault, "the complete figure file of the run")
    return content


def _read(folder: Path, path: Path) -> bytes:
    if path.exists() and not path.resolve().is_relative_to(folder.resolve()):
        raise InputError(str(path), "a link to elsewhere", "a file in the run's own folder")
    if path.is_file() and path.stat().st_size > BYTES:
        raise InputError(str(path), f"{path.stat().st_size} bytes", f"at most {BYTES}")
    return read_bytes(path, A_RUN)


def _fault_of_drawing(content: bytes) -> str:
    """Say what keeps an SVG from being set; nothing if that is nothing."""
    try:
        text = content.decode()
    except UnicodeDecodeError:
        return "no SVG drawing"
    if not text.lstrip().startswith("<") or "</svg>" not in text:
        return "no complete SVG drawing"
    if LINKED.search(text) or ACTING.search(text):
        return "a drawing with links, filters or entities"
    if any(_pixels(start) > PIXELS for start in EMBEDDED.findall(text)):
        return "a drawing with too large an image"
    return ""


def _pixels(start: str) -> int:
    size = b64decode(start)[SIZE]
    return int.from_bytes(size[:4]) * int.from_bytes(size[4:])


def _check_size(document: Document, source: str) -> None:
    blocks = [block for section in document.sections for block in section.blocks]
    charts = [block for block in blocks if isinstance(block, Chart | Replay | Heatmap)]
    texts = list(texts_within(asdict(document)))
    sizes = (("blocks", len(blocks), BLOCKS), ("texts", len(texts), TEXTS),
             ("letters", sum(map(len, texts)), LETTERS),
             ("numbers of charts", sum(map(numbers_within, charts)), NUMBERS))  # fmt: skip
    for what, count, most in sizes:
        if count > most:
            raise InputError(source, f"{count} {what}", f"at most {most}")
    if any("\0" in text for text in texts):
        raise InputError(source, "a character NUL", "texts")
    for fault in filter(None, map(fault_of, charts)):
        raise InputError(source, f"a chart with {fault}", "as many numbers in each column")
    for table in (block for block in blocks if isinstance(block, Table)):
        odd = next((row for row in table.rows if len(row.cells) != len(table.columns)), None)
        if odd is not None:
            found = f"a row of {len(odd.cells)} cells for {len(table.columns)} columns"
            raise InputError(source, found, "a cell for each column")
