"""What a solver may use beside the rows."""

from collections.abc import Callable
from typing import NamedTuple

from equipoise.estimation.regression.formulations.rows import Rows
from equipoise.model.arrays import Floats, Square
from equipoise.model.testbed import Testbed


class Aid(NamedTuple):
    """The testbed, and the noise of the rows."""

    testbed: Testbed
    gram: Square  # (c, c) mean of dA^T dA, dA being what the sensors' noise adds to centred rows
    cross: Floats  # (c,) mean of dA^T db


Solver = Callable[[Rows, Aid], Floats]
