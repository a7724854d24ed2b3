"""Mass, centre of mass and inertia of a body."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from equipoise.app.presentation.tables import Arrays, Table, Variable
from equipoise.app.text.blocks import Blocks, Column, number
from equipoise.app.text.blocks import table as text_table
from equipoise.app.text.json_lists import MASS_PROPERTIES
from equipoise.app.text.json_shape import View
from equipoise.app.text.numbers import unit_for
from equipoise.model.estimate import COM, INERTIA
from equipoise.model.mass_properties import MassProperties, is_possible

if TYPE_CHECKING:
    from matplotlib.figure import Figure

ELEMENTS = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))  # in the order of INERTIA
AXES = ("x", "y", "z")


def lines(body: MassProperties) -> Iterator[str]:
    """Yield mass, centre of mass and inertia about P."""
    unit = unit_for("com_x", "m")
    com = ", ".join(f"{value / unit.size:.4g}" for value in body.com)
    elements = (f"{name[-2:]} {value:.4g}" for name, value in _elements(body))
    yield f"MassProperties: {body.mass:.5g} kg"
    yield f"  com        x, y, z {com} {unit.name}"
    yield f"  inertia_P  {', '.join(elements)} kg m2"


def _elements(body: MassProperties) -> list[tuple[str, float]]:
    """Return the inertia's elements by name, kg m^2."""
    return [(name, float(body.inertia_P[at])) for name, at in zip(INERTIA, ELEMENTS, strict=True)]


def blocks(body: MassProperties) -> Blocks:
    """Return one table."""
    of = table(body)
    rows = list[tuple[str, str, str]]()
    for name, si, value in zip(of["name"], of["unit"], of["value"], strict=True):
        unit = unit_for(name, si) if si == "m" else None
        shown = value / (1.0 if unit is None else unit.size)
        rows.append((name, f"{shown:.5g}", si if unit is None else unit.name))
    columns = Column(), number("value"), Column("unit")
    return (text_table("Mass properties, masses at home", columns, rows),)


def document(body: MassProperties) -> View:
    """Return the numbers, SI."""
    return MASS_PROPERTIES.write(body)


def table(body: MassProperties) -> Table:
    """Return a row a number."""
    elements = [value for _, value in _elements(body)]
    return {
        "name": ["mass", *COM, *INERTIA],
        "unit": ["kg", *["m"] * len(COM), *["kg m2"] * len(INERTIA)],
        "value": [body.mass, *body.com.tolist(), *elements],
    }


def arrays(body: MassProperties) -> Arrays:
    """Return mass, centre of mass and inertia along the body axes."""
    variables = {
        "mass": Variable((), np.array(body.mass), "kg"),
        "com": Variable(("axis",), body.com, "m"),
        "inertia_P": Variable(("axis", "axis_2"), body.inertia_P, "kg m2"),
    }
    return Arrays(
        variables, {"axis": Variable(("axis",), AXES), "axis_2": Variable(("axis_2",), AXES)}
    )


def figure(body: MassProperties) -> "Figure | None":
    """Return the ellipsoid of even density with this inertia, and its centre of mass."""
    from equipoise.app.figures.estimate import inertia_ellipsoid

    return inertia_ellipsoid.draw(body) if is_possible(body) else None
