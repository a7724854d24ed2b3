"""Centre of mass and inertia with their 95 % intervals."""

from collections.abc import Sequence

import numpy as np

from equipoise.app.figures.base.canvas import Axes, Figure, laid_out
from equipoise.app.figures.base.style import BLUE, WIDE, styled
from equipoise.app.text.numbers import unit_for
from equipoise.model.estimate import COM, NORMAL_95, Parameter

CAPTION = (
    "Centre of mass, um in body axes, and inertia about P, kg m2, masses at home (dots), with 95 % "
    "intervals (bars)."
)
HIGH = 2.6  # inches, chosen


@styled
def draw(parameters: Sequence[Parameter]) -> Figure:
    """Return the figure: one panel for the centre of mass, one for the inertia."""
    com = [p for p in parameters if p.name in COM]
    groups = [group for group in (com, [p for p in parameters if p not in com]) if group]
    figure = laid_out(WIDE, HIGH)
    for axes, group in zip(figure.subplots(1, len(groups), squeeze=False)[0], groups, strict=True):
        _panel(axes, group)
    return figure


def _panel(axes: Axes, group: Sequence[Parameter]) -> None:
    """Draw one group, a bar a parameter."""
    unit = unit_for(group[0].name, group[0].unit)
    values = np.array([p.value for p in group]) / unit.size
    half = NORMAL_95 * np.array([p.sd for p in group]) / unit.size
    names = [p.name.rsplit("_", 1)[1] for p in group]
    axes.errorbar(range(len(group)), values, half, fmt="o", color=BLUE, capsize=3)
    axes.set_xticks(range(len(group)), names)
    axes.set_ylabel(f"{group[0].name.rsplit('_', 1)[0]}, {unit.name}")
    axes.margins(x=0.15)
