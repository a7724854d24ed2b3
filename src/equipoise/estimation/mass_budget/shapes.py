"""Moments of inertia of evenly filled shapes about their centre, in their own axes.

    J = m diag(A s^2)          s: the dimensions, squared one by one

    box        s = x, y, z edges                     J_xx = m (y^2 + z^2) / 12
    plate      s = x, y edges, without thickness     J_zz = m (x^2 + y^2) / 12
    cylinder   s = diameter, height along z          J_xx = m (d^2 / 16 + h^2 / 12)
                                                     J_zz = m d^2 / 8
    tube       s = outer, inner diameter, height     J_zz = m (d_o^2 + d_i^2) / 8
    sphere     s = diameter                          J = m d^2 / 10

(Any table of moments of inertia.) A point has none, and an own tensor is stated as it is.
"""

import numpy as np

from equipoise.model.arrays import Floats
from equipoise.model.mass_budget import Shape

BOX = (1 - np.eye(3)) / 12
ROUND = np.array([1 / 16, 1 / 16, 1 / 8])  # of a diameter along z
TALL = np.array([1 / 12, 1 / 12, 0.0])  # of a height along z
NONE = np.zeros((3, 0))
SQUARES: dict[Shape, Floats] = {  # A, (3, k): a column for each of ``DIMENSIONS``
    "point": NONE,
    "box": BOX,
    "plate": BOX[:, :2],
    "cylinder": np.column_stack([ROUND, TALL]),
    "tube": np.column_stack([ROUND, ROUND, TALL]),
    "sphere": np.full((3, 1), 1 / 10),
    "tensor": NONE,
    "unknown": NONE,
}
