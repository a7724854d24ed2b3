"""An estimate beside what the testbed file states, in units of their common sd."""

import math
from dataclasses import replace

import numpy as np

from equipoise.app.text.blocks import Row, Table, number
from equipoise.app.text.numbers import fixed, significant, unit_for
from equipoise.maths.linalg import element_sizes, pack_symmetric
from equipoise.model.estimate import BODY, COM, Estimate, Parameter, normalised_difference
from equipoise.model.testbed import Testbed

DIFFERENT = 3.0  # sd, chosen: one in 370 by chance
COLUMNS = (number("testbed file"), number("difference", "sd"))
NOTE = (
    "Difference: (value - testbed file) / sqrt(sd² + sd²), with the standard deviations of both. "
    "Beyond 3, the testbed file or its standard deviation is wrong, or the estimate is."
)


def stated(testbed: Testbed) -> dict[str, Parameter]:
    """Return inertia and centre of mass as the testbed states them, with their sd."""
    body = testbed.body
    if testbed.body_covariance is None:
        inertia_sd = testbed.inertia_sd * element_sizes(body.inertia_P)
        sd = np.concatenate([inertia_sd, testbed.com_sd])
    else:
        sd = np.sqrt(np.diag(testbed.body_covariance))
    values = np.concatenate([pack_symmetric(body.inertia_P), body.com])
    return {
        name: Parameter(name, "m" if name in COM else "kg m2", float(value), float(each))
        for name, value, each in zip(BODY, values, sd, strict=True)
    }


def beside_testbed(shown: Table, estimate: Estimate, testbed: Testbed) -> Table:
    """Return a table of parameters with the testbed's values, and differences if they are known.

    A table without inertia and centre of mass comes back as it is.
    """
    of_testbed = stated(testbed)
    others = [of_testbed.get(row.cells[0]) for row in shown.rows]
    if not any(others):
        return shown
    differences = [_difference(estimate, other) for other in others]
    count = 2 if any(map(math.isfinite, differences)) else 1
    rows = (
        _with_stated(row, other, difference, count)
        for row, other, difference in zip(shown.rows, others, differences, strict=True)
    )
    notes = (*shown.notes, *((NOTE,) if count == 2 else ()))
    columns = (*shown.columns, *COLUMNS[:count])
    return replace(shown, columns=columns, rows=tuple(rows), notes=notes)


def _difference(estimate: Estimate, other: Parameter | None) -> float:
    """Return how far an estimated parameter is from the testbed's, in sd; NaN: not known."""
    if other is None:
        return math.nan
    parameter = estimate.parameters[estimate.index(other.name)]
    return normalised_difference(parameter, other) if math.isfinite(parameter.sd) else math.nan


def _with_stated(row: Row, other: Parameter | None, difference: float, count: int) -> Row:
    if other is None:
        return replace(row, cells=(*row.cells, *[""] * count))
    value = significant(other.value / unit_for(other.name, other.unit).size, 4)
    known = math.isfinite(difference)
    cells = (value, fixed(difference, 1) if known else "")[:count]
    tone = "caution" if known and abs(difference) > DIFFERENT else row.tone
    return Row((*row.cells, *cells), tone)
