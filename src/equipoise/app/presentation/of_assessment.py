"""An assessment: the verdict, what gravity does, and the estimate that it rests on."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

from equipoise.app.presentation import of_estimate
from equipoise.app.runs.recordings.assessment import AssessedPlatform

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def lines(shown: AssessedPlatform) -> Iterator[str]:
    """Yield the last sentence, and the parameters."""
    yield f"Assessment of {shown.done.testbed.name}: {shown.steps[-1].sentence}"
    yield from of_estimate.parameter_lines(shown.estimate)


def figure(shown: AssessedPlatform) -> "Figure | None":
    """Return the first figure of the report."""
    from equipoise.app.views.assess_views import pictures_of

    first = next(pictures_of(shown), None)
    return None if first is None else first.figure
