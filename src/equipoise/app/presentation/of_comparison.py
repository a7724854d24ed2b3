"""Methods and laws compared."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

from equipoise.app.presentation.tables import Arrays, Table, of_table
from equipoise.app.runs.comparison import Compared
from equipoise.app.text.blocks import Blocks
from equipoise.app.text.json_shape import View

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def lines(done: Compared) -> Iterator[str]:
    """Yield what is recommended."""
    from equipoise.app.views.study.comparison_report import advice

    yield f"Comparison on {done.testbed.name}, platforms: {done.requested['platforms']}"
    for each in advice(done):
        yield f"  {each.sentence}"


def blocks(done: Compared) -> Blocks:
    """Return what the command prints."""
    from equipoise.app.views.study import comparison_report

    return comparison_report.blocks(done)


def document(done: Compared) -> View:
    """Return what `equipoise compare --json` prints."""
    from equipoise.app.views.study import comparison_report

    return comparison_report.document(done)


def table(done: Compared) -> Table:
    """Return a row a method and a row a law; what one kind does not have is None."""
    methods = () if done.methods is None else done.methods.methods
    laws = () if done.laws is None else done.laws.laws
    of_laws, of_methods = [None] * len(laws), [None] * len(methods)
    return Table(
        "name",
        {
            "name": [*(m.method for m in methods), *(law.law for law in laws)],
            "runs": [*(m.runs for m in methods), *(law.runs for law in laws)],
            "failed": [*(m.failed for m in methods), *of_laws],
            "com_rmse_per_bound": [*(m.com.rmse for m in methods), *of_laws],
            "inertia_rmse_per_bound": [*(m.inertia.rmse for m in methods), *of_laws],
            "coverage": [*(m.coverage.value for m in methods), *of_laws],
            "torque_median_N_m": [*of_methods, *(law.torque.median for law in laws)],
            "torque_most_N_m": [*of_methods, *(law.torque.most for law in laws)],
            "false_passes": [*of_methods, *(law.false_passes for law in laws)],
        },
    )


def arrays(done: Compared) -> Arrays:
    """Return the table's columns along the names."""
    return of_table(table(done))


def figure(done: Compared) -> "Figure | None":
    """Return the first figure of the report."""
    from equipoise.app.views.study.comparison_report import pictures

    first = next(pictures(done), None)
    return None if first is None else first.figure
