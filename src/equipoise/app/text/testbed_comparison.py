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
    """Return a table of parameters with two more columns; unchanged if it has none of the body."""
    of_testbed = stated(testbed)
    if not any(row.cells[0] in of_testbed for row in shown.rows):
        return shown
    rows = tuple(_with_stated(row, estimate, of_testbed.get(row.cells[0])) for row in shown.rows)
    return replace(shown, columns=(*shown.columns, *COLUMNS), rows=rows, notes=(*shown.notes, NOTE))


def _with_stated(row: Row, estimate: Estimate, other: Parameter | None) -> Row:
    if other is None:
        return replace(row, cells=(*row.cells, "", ""))
    parameter = estimate.parameters[estimate.index(other.name)]
    unit = unit_for(other.name, other.unit)
    difference = normalised_difference(parameter, other)
    known = math.isfinite(difference) and math.isfinite(parameter.sd)
    text = fixed(difference, 1) if known else ""
    tone = "caution" if known and abs(difference) > DIFFERENT else row.tone
    return Row((*row.cells, significant(other.value / unit.size, 4), text), tone)
