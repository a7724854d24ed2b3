"""The torque on a platform by cause: rms of each, and columns in SI."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

from equipoise.app.presentation.tables import Table
from equipoise.model.torque_by_cause import TorqueByCause
from equipoise.model.units import UN_M

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def lines(torque: TorqueByCause) -> Iterator[str]:
    """Yield whether the balance closes, and the rms of each cause."""
    of = torque.source or "a recording"
    yield f"Torque by cause of {of}: {torque.closure.reason.sentence}"
    for course in torque.courses:
        sizes = ", ".join(f"{size / UN_M:.3g}" for size in course.rms)
        yield f"{course.name:10s} rms {sizes} uN m, sd {course.typical_sd / UN_M:.3g} uN m"


def table(torque: TorqueByCause) -> Table:
    """Return a row an interval, SI."""
    from equipoise.app.views.torque_views import columns_of

    return {name: column.tolist() for name, column in columns_of(torque).items()}


def figure(torque: TorqueByCause) -> "Figure":
    """Return the figure of the report."""
    from equipoise.app.figures.estimate import torque_by_cause

    return torque_by_cause.draw(torque)
