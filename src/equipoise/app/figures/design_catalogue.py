"""A design put down in a folder: two figures and the JSON document; all of them or none."""

from pathlib import Path

from equipoise.app.figures.base.files import rendered
from equipoise.app.figures.catalogue import Picture
from equipoise.app.figures.study import reach, torque_budget
from equipoise.app.text.json_document import View, dump
from equipoise.io.files.atomic_folder import write_folder
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


def write_design(found: Sizing, document: View, folder: Path) -> list[Path]:
    """Write reach.png, budget.png and design.json, and return their paths."""
    files: dict[str, str | bytes] = {
        f"{picture.name}.png": rendered(picture.figure) for picture in pictures_of(found)
    }
    return write_folder(folder, files | {"design.json": dump(document) + "\n"})
