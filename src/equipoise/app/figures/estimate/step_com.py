"""Centres of mass beside each other, axis by axis, against the target and its tolerance."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from equipoise.app.figures.base.canvas import Axes, Figure, laid_out
from equipoise.app.figures.base.style import AXES, BAND, GREY, WIDE, XYZ, styled
from equipoise.model.arrays import Vector3
from equipoise.model.units import UM

BARLESS = (
    " Grey, without bar: the data do not determine the value, as where the scale of inertia and "
    "centre of mass is open."
)


class Mark(NamedTuple):
    """One centre of mass and what it is."""

    name: str
    com: Vector3  # m
    sd: Vector3  # m


class Wanted(NamedTuple):
    """Where the centre of mass is to be."""

    target: Vector3  # m
    tolerance: Vector3  # m


def caption(at_home: bool, marks: Sequence[Mark], wanted: Wanted | None) -> str:
    """Return what the figure shows."""
    shaded = "" if wanted is None else "; shaded: target with tolerance"
    barless = "" if all(np.isfinite(mark.sd).all() for mark in marks) else BARLESS
    return (
        "Centre of mass with the masses "
        f"{('at home' if at_home else 'in their present positions')}, um in body axes, "
        f"with bars of two standard deviations{shaded}.{barless}"
    )


@styled
def draw(marks: Sequence[Mark], wanted: Wanted | None) -> Figure:
    """Return the figure: a row for each mark, the first on top."""
    figure = laid_out(WIDE, 0.75 + 0.28 * len(marks))
    row = figure.subplots(1, 3, sharey=True)
    for i, axes in enumerate(row):
        if wanted is not None:
            low, high = ((wanted.target[i] + s * wanted.tolerance[i]) / UM for s in (-1, 1))
            axes.axvspan(low, high, color="black", alpha=0.16, linewidth=0)
        _marks(axes, i, marks)
        axes.set_xlabel(f"$r_{AXES[i]}$, um")
        axes.locator_params(axis="x", nbins=3)  # three fit, whatever their digits
        axes.set_ylim(len(marks) - 0.5, -0.5)
    row[0].set_yticks(range(len(marks)), [mark.name for mark in marks])
    return figure


def _marks(axes: Axes, i: int, marks: Sequence[Mark]) -> None:
    for k, mark in enumerate(marks):
        axes.errorbar(
            mark.com[i] / UM, k, xerr=BAND * mark.sd[i] / UM, fmt="o",
            color=XYZ[i] if np.isfinite(mark.sd[i]) else GREY,
            markerfacecolor="white", markersize=5, elinewidth=1.2, capsize=2.5,
        )  # fmt: skip
