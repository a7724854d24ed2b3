"""A balance that was kept: how it ended, and where the centre of mass stood."""

from collections.abc import Iterator

from equipoise.app.presentation.tables import Table
from equipoise.app.runs.keeping import Keeping
from equipoise.app.text.blocks import Blocks
from equipoise.app.text.run_blocks import moments


def lines(done: Keeping) -> Iterator[str]:
    """Yield how it ended, and how often masses moved."""
    yield f"Balance of {done.testbed.name} kept: {done.verdict.sentence}"
    yield f"  {done.moves} moves while holding"


def blocks(done: Keeping) -> Blocks:
    """Return steps, what masses did, and the verdict."""
    from equipoise.app.views.balancing import keep_views

    return (*moments(done.steps), *keep_views.blocks(done))


def table(done: Keeping) -> Table:
    """Return a row a report: time, centre of mass and its sd."""
    course = done.course
    found: Table = {"time_s": course.t.tolist()}
    for i, axis in enumerate("xyz"):
        found[f"com_{axis}_m"] = course.values[:, i].tolist()
        found[f"sd_{axis}_m"] = course.sd[:, i].tolist()
    return found
