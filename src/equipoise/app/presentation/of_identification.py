"""An identification: its estimate, after what was done."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

from equipoise.app.presentation import of_estimate
from equipoise.app.runs.recordings.identification import Identification
from equipoise.app.text.blocks import Blocks

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def lines(done: Identification) -> Iterator[str]:
    """Yield what was identified, how it ended, and the parameters."""
    estimate = done.estimate
    yield f"Identification of {done.testbed.name} by {estimate.method}: {estimate.outcome.sentence}"
    yield from of_estimate.parameter_lines(estimate)


def blocks(done: Identification) -> Blocks:
    """Return what the command prints."""
    from equipoise.app.views import identify_views

    return identify_views.blocks(done)


def figure(done: Identification) -> "Figure | None":
    """Return the first figure of the report, else the intervals."""
    from equipoise.app.figures.catalogue import of_estimate as pictures

    first = next(pictures(done.recording, done.estimate, done.courses()), None)
    return of_estimate.figure(done.estimate) if first is None else first.figure
