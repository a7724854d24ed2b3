"""Figures of a design."""

from equipoise.app.figures.catalogue import Picture
from equipoise.app.figures.study import reach, torque_budget
from equipoise.planning.sizing.limits import worth_listing
from equipoise.planning.sizing.sizing import Sizing


def pictures_of(found: Sizing) -> tuple[Picture, Picture]:
    """Return the figures of a design."""
    shown = worth_listing(found.budget, found.better)
    return (
        Picture("reach", reach.CAPTION, reach.draw(found.reach, found.case)),
        Picture(
            "budget",
            torque_budget.CAPTION,
            torque_budget.draw(found.budget, shown, found.required),
        ),
    )
