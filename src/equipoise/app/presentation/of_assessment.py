"""An assessment: the verdict, what gravity does, and the estimate that it rests on."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

from equipoise.app.presentation import of_estimate
from equipoise.app.presentation.tables import Arrays, Table
from equipoise.app.runs.assessment import AssessedPlatform
from equipoise.app.text.blocks import Blocks
from equipoise.app.text.json_shape import View

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def lines(shown: AssessedPlatform) -> Iterator[str]:
    """Yield the last sentence, and the parameters."""
    yield f"Assessment of {shown.done.testbed.name}: {shown.steps[-1].sentence}"
    yield from of_estimate.parameter_lines(shown.estimate)


def blocks(shown: AssessedPlatform) -> Blocks:
    """Return what the command prints."""
    from equipoise.app.views import assess_views

    return assess_views.blocks(shown)


def document(shown: AssessedPlatform) -> View:
    """Return what `equipoise assess --json` prints."""
    from equipoise.app.views.assess_json import document_of

    return document_of(shown)


def table(shown: AssessedPlatform) -> Table:
    """Return a row a parameter of the estimate."""
    return of_estimate.table(shown.estimate)


def arrays(shown: AssessedPlatform) -> Arrays:
    """Return the estimate's arrays."""
    return of_estimate.arrays(shown.estimate)


def figure(shown: AssessedPlatform) -> "Figure | None":
    """Return the first figure of the report."""
    from equipoise.app.views.assess_views import pictures_of

    first = next(pictures_of(shown), None)
    return None if first is None else first.figure
