"""A document as PDF, and a drawing as PNG, set by typst."""

import json
from collections.abc import Mapping
from dataclasses import asdict
from importlib.resources import files
from importlib.util import find_spec
from typing import Any

from equipoise.app.report.html import Drawings
from equipoise.app.text.blocks import Document
from equipoise.app.text.escaping import for_typst
from equipoise.app.text.still import still
from equipoise.model.errors import InputError
from equipoise.model.optional_libraries import extra_library, extra_line

TEMPLATE = "page.typ"
ALONE = b"""#set page(width: auto, height: auto, margin: 0pt)
#image("drawing.svg")
"""
AS_PNG = "a figure as PNG"
EXTRA = "report"
NO_PDF = f"no PDF was written, typst is not installed: {extra_line(EXTRA)}"
PPI = 300.0  # pixels an inch, chosen: what journals want of pictures with lines


def can_set() -> bool:
    """Say whether typst is there."""
    return find_spec("typst") is not None


def pdf(document: Document, drawings: Drawings) -> bytes:
    """Return the file, with the document's figures; typst is there.

    Raises InputError with what typst says where it cannot set them.
    """
    source = (files("equipoise.app.report") / TEMPLATE).read_bytes()
    parts = {f"{name}.svg": drawing for name, drawing in drawings.items()}
    inputs = {"page": json.dumps(for_typst(asdict(still(document))))}
    return _set("the report as PDF", {"main.typ": source, **parts}, sys_inputs=inputs)


def png(drawing: bytes) -> bytes:
    """Return an SVG as a PNG of ``PPI``; InputError where typst is not there, or cannot set it."""
    return _set(AS_PNG, {"main.typ": ALONE, "drawing.svg": drawing}, format="png", ppi=PPI)


def _set(what: str, sources: Mapping[str, bytes], **options: Any) -> bytes:
    typst = extra_library("typst", what, "typesetting", EXTRA)
    compiled: Any = typst.compile  # its annotations know of one file only
    try:
        return compiled(sources, **options)
    except typst.TypstError as error:
        wanted = "blocks and figures that the PDF supports"
        raise InputError(what, f"typst's '{error}'", wanted) from error
