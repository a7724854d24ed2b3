"""Figures to draw on, without pyplot; matplotlib is loaded when the first one is made.

A command that draws nothing does not wait for it, whatever it imports of this room.
"""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from matplotlib.axes import Axes as Axes
    from matplotlib.figure import Figure as Figure
else:
    Axes = Figure = Any


def laid_out(width: float, height: float) -> Figure:
    """Return a figure of so many inches that finds the places of its panels and texts itself."""
    from matplotlib.figure import Figure

    return Figure(figsize=(width, height), layout="constrained")


def sheet(width: float, height: float, dpi: float | None = None) -> Figure:
    """Return a figure of so many inches on which each thing is placed where it is set."""
    from matplotlib.figure import Figure

    return Figure(figsize=(width, height), dpi=dpi)
