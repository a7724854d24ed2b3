"""A document as PDF, set by typst."""

import json
from collections.abc import Mapping
from dataclasses import asdict
from importlib.resources import files
from importlib.util import find_spec
from typing import Any

from equipoise.app.text.blocks import Document
from equipoise.app.text.escaping import for_typst
from equipoise.model.errors import InputError

TEMPLATE = "page.typ"


def can_set() -> bool:
    """Say whether typst is there."""
    return find_spec("typst") is not None


def pdf(document: Document, images: Mapping[str, bytes]) -> bytes:
    """Return the file; ``images`` are the document's figures as SVG, by name; typst is there.

    Raises InputError with what typst says where it cannot set them.
    """
    import typst

    source = (files("equipoise.app.report") / TEMPLATE).read_bytes()
    parts = {f"{name}.svg": image for name, image in images.items()}
    inputs = {"page": json.dumps(for_typst(asdict(document)))}
    inside: Any = {"main.typ": source, **parts}  # its annotations know of one file only
    try:
        return typst.compile(inside, sys_inputs=inputs)
    except typst.TypstError as error:
        wanted = "blocks and figures that it can set"
        raise InputError("the report as PDF", f"typst's '{error}'", wanted) from error
