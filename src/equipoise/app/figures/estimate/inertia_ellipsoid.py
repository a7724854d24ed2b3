"""The ellipsoid of even density that has a body's inertia.

    a_i^2 = 5 lambda_i / m,   lambda_i, v_i: eigenvalues and axes of Sigma = 1/2 tr(J_C) E - J_C

(second moments of an ellipsoid of even density: m a_i^2 / 5 along each of its axes).
"""

import numpy as np

from equipoise.app.figures.base.canvas import Figure, sheet
from equipoise.app.figures.base.style import AXES, BLUE, GREY, ORANGE, styled
from equipoise.model.arrays import Floats
from equipoise.model.mass_properties import MassProperties, second_moments
from equipoise.model.units import MM

CAPTION = (
    "Ellipsoid of uniform density with this mass and inertia, mm in body axes; centre "
    "of mass (dot), centre of rotation P (cross)."
)
SIZE = 4.4  # inches, chosen
AROUND, ALONG = 25, 13  # meridians and parallels of the mesh, chosen


def semi_axes(body: MassProperties) -> tuple[Floats, Floats]:
    """Return the ellipsoid's semi-axes (m), and their directions in body axes, a column each."""
    moments, directions = np.linalg.eigh(second_moments(body.inertia_C))
    return np.sqrt(5.0 * moments / body.mass), directions


def surface(body: MassProperties) -> Floats:
    """Return points of the ellipsoid, (3, ALONG, AROUND) m from P."""
    lengths, directions = semi_axes(body)
    u, v = np.meshgrid(np.linspace(0, 2 * np.pi, AROUND), np.linspace(0, np.pi, ALONG))
    sphere = np.array([np.cos(u) * np.sin(v), np.sin(u) * np.sin(v), np.cos(v)])
    turned: Floats = np.einsum("ij,j,jkl->ikl", directions, lengths, sphere)
    return turned + body.com[:, None, None]


@styled
def draw(body: MassProperties) -> Figure:
    """Return the figure; the body must be physically possible."""
    figure = sheet(SIZE, SIZE)
    axes = figure.add_subplot(projection="3d")
    axes.plot_wireframe(*(surface(body) / MM), color=BLUE, linewidth=0.5, alpha=0.6)
    axes.plot(*(body.com[:, None] / MM), "o", color=ORANGE, label="centre of mass")
    axes.plot([0.0], [0.0], [0.0], "x", color=GREY, label="P")
    for letter in AXES:
        pad = 2.0 if letter == "z" else 11.0  # numbers of x and y slant towards their labels
        getattr(axes, f"set_{letter}label")(f"{letter}, mm", labelpad=pad)
    axes.set_aspect("equal")
    axes.locator_params(nbins=4)
    axes.legend(loc="upper right")
    return figure
