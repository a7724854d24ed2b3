"""What is left of torque, line by line, and what would be left with one thing better."""

from collections.abc import Sequence

from equipoise.app.figures.base.canvas import Axes, Figure, laid_out
from equipoise.app.figures.base.style import BLUE, GREY, ORANGE, WIDE, styled
from equipoise.model.units import UN_M
from equipoise.planning.sizing.budget import Budget
from equipoise.planning.sizing.sensitivity import Bettered

CAPTION = (
    "Residual torque, uN m rms within the tilt: each cause alone, all together (root "
    "sum square), and all together with one improvement."
)
ROW = 0.24  # inches a bar


@styled
def draw(budget: Budget, better: Sequence[Bettered], required: float | None) -> Figure:
    """Return the figure; ``required`` (N m) is a line across."""
    lines = [(line.cause, line.torque, BLUE) for line in budget.lines]
    lines.append(("together", budget.torque, GREY))
    changes = [(change.name, change.torque, ORANGE) for change in better]
    rows = len(lines) + len(changes)
    figure = laid_out(WIDE, ROW * rows + 1.2)
    heights = [len(lines), max(len(changes), 1)]
    upper, lower = figure.subplots(2, 1, sharex=True, height_ratios=heights)
    bars(upper, lines, "each cause by itself")
    bars(lower, changes, "together, with one improvement")
    lower.set_xlabel("uN m rms")
    if required is not None:
        for axes in (upper, lower):
            axes.axvline(required / UN_M, color="black", linestyle="--", linewidth=0.9)
        lower.set_title("dashed: required", loc="right")
    return figure


def bars(axes: Axes, rows: Sequence[tuple[str, float, str]], title: str) -> None:
    """Draw bars from above, with their numbers beside them."""
    torque = [value / UN_M for _, value, _ in rows]
    drawn = axes.barh(range(len(rows)), torque, color=[colour for *_, colour in rows], height=0.7)
    axes.bar_label(drawn, fmt="%.3g", padding=3, fontsize=8)
    axes.set_yticks(range(len(rows)), [name for name, *_ in rows])
    axes.invert_yaxis()
    axes.grid(False, axis="y")
    axes.margins(x=0.1)
    axes.set_title(title)
