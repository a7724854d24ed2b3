"""The steps of a procedure as rows and columns."""

from collections.abc import Sequence

from equipoise.app.presentation.tables import Table
from equipoise.model.step import Step


def step_table(steps: Sequence[Step]) -> Table:
    """Return a row a step."""
    return Table(
        "step",
        {
            "step": list(range(1, len(steps) + 1)),
            "time_s": [step.time for step in steps],
            "kind": [step.kind for step in steps],
            "sentence": [step.sentence for step in steps],
        },
    )
