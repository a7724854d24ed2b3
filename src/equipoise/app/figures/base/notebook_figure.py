"""The figure of matplotlib that a notebook shows, though no figure here belongs to pyplot.

Importing this module loads matplotlib; ``canvas`` does so when the first figure is made.
"""

from io import BytesIO

from matplotlib.figure import Figure

from equipoise.app.figures.base.style import styled


class NotebookFigure(Figure):
    """A figure as the result of a cell: IPython asks for ``_repr_png_``."""

    @styled
    def _repr_png_(self) -> bytes:
        """Return the drawing as PNG."""
        drawn = BytesIO()
        self.savefig(drawn, format="png", dpi="figure")
        return drawn.getvalue()
