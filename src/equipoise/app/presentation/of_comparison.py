"""Methods and laws compared."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

from equipoise.app.presentation.tables import Table
from equipoise.app.runs.comparison import Compared

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def lines(done: Compared) -> Iterator[str]:
    """Yield what is recommended."""
    from equipoise.app.views.study.comparison_report import advice

    yield f"Comparison on {done.testbed.name}, platforms: {done.requested['platforms']}"
    for each in advice(done):
        yield f"  {each.sentence}"


def table(done: Compared) -> Table:
    """Return a row a method and a row a law; what one kind does not have is None."""
    methods = () if done.methods is None else done.methods.methods
    laws = () if done.laws is None else done.laws.laws
    of_laws, of_methods = [None] * len(laws), [None] * len(methods)
    return {
        "name": [*(m.method for m in methods), *(law.law for law in laws)],
        "runs": [*(m.runs for m in methods), *(law.runs for law in laws)],
        "failed": [*(m.failed for m in methods), *of_laws],
        "com_rmse_per_bound": [*(m.com.rmse for m in methods), *of_laws],
        "inertia_rmse_per_bound": [*(m.inertia.rmse for m in methods), *of_laws],
        "coverage": [*(m.coverage.value for m in methods), *of_laws],
        "torque_median_N_m": [*of_methods, *(law.torque.median for law in laws)],
        "torque_most_N_m": [*of_methods, *(law.torque.most for law in laws)],
        "false_passes": [*of_methods, *(law.false_passes for law in laws)],
    }


def figure(done: Compared) -> "Figure | None":
    """Return the first figure of the report."""
    from equipoise.app.views.study.comparison_report import pictures

    first = next(pictures(done), None)
    return None if first is None else first.figure
