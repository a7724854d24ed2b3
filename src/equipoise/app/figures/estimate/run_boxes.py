"""Box plots of centre of mass and inertia over several runs, as Ivanov 2021 Fig. 9."""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from equipoise.app.figures.base.canvas import Axes, Figure, laid_out
from equipoise.app.figures.base.strokes import with_legend
from equipoise.app.figures.base.style import BLUE, GREY, ORANGE, WIDE, styled
from equipoise.app.text.numbers import unit_for
from equipoise.model.estimate import COM, INERTIA, NORMAL_95, Parameter

CAPTION = (
    "Centre of mass, um in body axes, and inertia about P, kg m2, masses at home, "
    "over the runs (dots): median, quartiles, whiskers within 1.5 interquartile "
    "ranges. Beside them the joint estimate with its 95 % interval. Dashed: value of "
    "the testbed, where it lies within the panel."
)
CAPTION_OF_BALANCING = (
    "Centre of mass with the masses in their present positions, um in body axes, by "
    "the verdict of each run (dots): median, quartiles, whiskers within 1.5 "
    "interquartile ranges. Dashed: target, where it lies within the panel."
)
HIGH = 1.35  # inches of a row, chosen
ROWS = (COM, INERTIA[:3], INERTIA[3:])
BOX, JOINT = 0.0, 1.0  # places along x


class Boxed(NamedTuple):
    """One parameter over the runs that show it."""

    values: Sequence[float]  # SI
    unit: str  # SI
    joint: Parameter | None  # None: there is no joint estimate
    dashed: float  # SI: where it is stated or wanted


@styled
def draw(parameters: Mapping[str, Boxed], label: str = "testbed") -> Figure:
    """Return the figure: a panel a parameter, each to its own scale; what the dashed line is."""
    rows = [[name for name in row if name in parameters] for row in ROWS]
    rows = [row for row in rows if row]
    figure = laid_out(WIDE, HIGH * len(rows) + 0.4)
    grid = figure.subplots(len(rows), len(COM), squeeze=False)
    for every, row in zip(grid, rows, strict=True):
        for axes in every[len(row) :]:
            axes.set_visible(False)
        for axes, name in zip(every, row, strict=False):
            _panel(axes, name, parameters[name], label)
    return with_legend(figure, grid[0, 0])


def _panel(axes: Axes, name: str, boxed: Boxed, label: str) -> None:
    unit, joint = unit_for(name, boxed.unit), boxed.joint
    values = [value / unit.size for value in boxed.values]
    axes.boxplot(
        [values], positions=[BOX], widths=0.5, showfliers=False,
        medianprops={"color": BLUE}, boxprops={"color": GREY}, whiskerprops={"color": GREY},
        capprops={"color": GREY},
    )  # fmt: skip
    axes.plot([BOX] * len(values), values, ".", color=BLUE, alpha=0.6, label="runs")
    if joint is not None and joint.observable:
        axes.errorbar(JOINT, joint.value / unit.size, NORMAL_95 * joint.sd / unit.size, fmt="o",
                      color=ORANGE, capsize=3, label="jointly, 95 %")  # fmt: skip
    axes.set_xlim(-0.6, 1.6)
    axes.set_ylim(*axes.get_ylim())
    axes.axhline(boxed.dashed / unit.size, color=GREY, linestyle="--", linewidth=0.9,
                 label=label)  # fmt: skip
    axes.set_xticks([])
    axes.set_title(f"{name}, {unit.name}")
