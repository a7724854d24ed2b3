"""A picture on paper at its true size: PDF or PNG."""

from pathlib import Path

from equipoise.app.figures.base.canvas import sheet
from equipoise.hardware.camera.aruco import Picture
from equipoise.io.files.atomic_file import whole_file
from equipoise.model.errors import InputError

DPI = 600  # dots per inch, chosen: a dot is 0.04 mm
SUFFIXES = (".pdf", ".png")


def check_paper(path: Path) -> None:
    """Raise InputError for a file of another kind."""
    if path.suffix.lower() not in SUFFIXES:
        raise InputError(str(path), f"suffix '{path.suffix}'", " or ".join(SUFFIXES))


def write_paper(picture: Picture, path: Path) -> None:
    """Write a picture of ``DPI`` so that a printer at 100 % gives it in its true size."""
    height, width = picture.shape
    figure = sheet(width / DPI, height / DPI, DPI)
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set_axis_off()
    axes.imshow(picture, cmap="gray", vmin=0, vmax=255, interpolation="none", aspect="auto")
    with whole_file(path) as temporary:
        figure.savefig(temporary, dpi=DPI)
