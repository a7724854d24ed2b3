"""An identification from several recordings: its joint estimate, and whether the runs agree."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

from equipoise.app.presentation import of_estimate
from equipoise.app.runs.recordings.joint_identification import JointIdentification

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def lines(done: JointIdentification) -> Iterator[str]:
    """Yield what was identified from how many runs, how it ended, and the parameters."""
    estimate, count = done.estimate, len(done.runs)
    yield f"Identification of {done.testbed.name} from {count} runs: {estimate.outcome.sentence}"
    yield done.verdict.sentence
    yield from of_estimate.parameter_lines(estimate)


def figure(done: JointIdentification) -> "Figure | None":
    """Return the box plots, else the intervals of the joint estimate."""
    from equipoise.app.views.identify_runs_views import pictures

    first = next(pictures(done), None)
    return of_estimate.figure(done.estimate) if first is None else first.figure
