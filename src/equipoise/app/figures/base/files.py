"""Figures as the bytes of a file, and as files written whole or not at all."""

import io
from pathlib import Path

from equipoise.app.figures.base.arrangement import arrange
from equipoise.app.figures.base.canvas import Figure
from equipoise.app.figures.base.style import styled
from equipoise.io.files.atomic_file import write_whole
from equipoise.model.errors import InputError

KINDS = (".png", ".svg", ".pdf")


@styled
def rendered(figure: Figure, kind: str = "png") -> bytes:
    """Return a figure as the bytes of a file; the same figure gives the same bytes."""
    layout = figure.get_layout_engine()
    if layout is not None and figure.get_suptitle():
        layout.execute(figure)
        figure.set_layout_engine(None)  # laid out anew it would be a hair different, and slow
    elif layout is not None:
        arrange(figure)
    undated = {"png": {}, "svg": {"Date": None}, "pdf": {"CreationDate": None}}[kind]
    stream = io.BytesIO()
    figure.savefig(stream, format=kind, metadata=undated)
    return stream.getvalue()


def check_picture_name(path: Path) -> None:
    """Raise InputError if the name does not say which kind of picture it is to be."""
    if path.suffix.lower() not in KINDS:
        wanted = f"a file name ending in {', '.join(KINDS)}"
        raise InputError(str(path), f"suffix '{path.suffix}'", wanted)


def write_figure(figure: Figure, path: Path) -> None:
    """Write one figure in the format of the file's suffix."""
    check_picture_name(path)
    write_whole(path, rendered(figure, path.suffix.lower().removeprefix(".")))
