"""Figures to draw on, without pyplot; matplotlib is loaded when the first one is made.

A command that draws nothing does not wait for it, whatever it imports of this room.
"""

import sys
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from matplotlib.axes import Axes as Axes
    from matplotlib.figure import Figure as Figure
else:
    Axes = Figure = Any


def load() -> None:
    """Load matplotlib; without the help of its artists, unless somebody is there to read it.

    Half of the time of loading goes into it: for each kind of artist, the list of all that can be
    set of it.
    """
    is_read = hasattr(sys, "ps1") or "IPython" in sys.modules
    if is_read or "matplotlib.artist" in sys.modules:
        return
    from matplotlib.artist import Artist

    helped: Any = Artist
    helped._update_set_signature_and_docstring = classmethod(lambda cls: None)


def laid_out(width: float, height: float) -> Figure:
    """Return a figure of so many inches that finds the places of its panels and texts itself."""
    load()
    from equipoise.app.figures.base.notebook_figure import NotebookFigure

    return NotebookFigure(figsize=(width, height), layout="constrained")


def sheet(width: float, height: float, dpi: float | None = None) -> Figure:
    """Return a figure of so many inches on which each thing is placed where it is set."""
    load()
    from equipoise.app.figures.base.notebook_figure import NotebookFigure

    return NotebookFigure(figsize=(width, height), dpi=dpi)
