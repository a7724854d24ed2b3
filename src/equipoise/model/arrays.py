"""Names for array shapes.

Time comes first in a series. Everything real is float64. The shapes are checked at run time in the
tests only, which load the checker first; for the reader, the type checker and in use they are plain
arrays.
"""

import sys
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]
Complexes = NDArray[np.complex128]

# What compiled functions pass to each other.
Triple = tuple[float, float, float]
Six = tuple[float, float, float, float, float, float]
Nine = tuple[float, float, float, float, float, float, float, float, float]

if TYPE_CHECKING or "jaxtyping" not in sys.modules:
    Vector3 = NDArray[np.float64]
    Vector6 = NDArray[np.float64]
    Quaternion = NDArray[np.float64]
    Matrix3 = NDArray[np.float64]
    Square = NDArray[np.float64]
    Series1 = NDArray[np.float64]
    Series3 = NDArray[np.float64]
    Series4 = NDArray[np.float64]
    Series = NDArray[np.float64]
else:
    from jaxtyping import Float64

    Vector3 = Float64[np.ndarray, "3"]
    Vector6 = Float64[np.ndarray, "6"]
    Quaternion = Float64[np.ndarray, "4"]
    Matrix3 = Float64[np.ndarray, "3 3"]
    Square = Float64[np.ndarray, "n n"]
    Series1 = Float64[np.ndarray, "n"]
    Series3 = Float64[np.ndarray, "n 3"]
    Series4 = Float64[np.ndarray, "n 4"]
    Series = Float64[np.ndarray, "n k"]
