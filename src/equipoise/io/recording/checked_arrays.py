"""What a person hands over as an array, checked: numbers of the shape that is wanted."""

from typing import Any

import numpy as np

from equipoise.model.arrays import Floats
from equipoise.model.errors import InputError


def where(name: str) -> str:
    """Return an argument's place, as an error names it."""
    return f"from_arrays: {name}"


def checked(name: str, values: Any, shape: tuple[int, ...], time: str) -> Floats:
    """Return an array of float64 of a shape; InputError names the argument.

    Its first axis has as many rows as ``time``, the argument with its times.
    """
    try:
        array = np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise InputError(where(name), "not an array of numbers", _wanted(shape, time)) from error
    if array.shape != shape:
        found = f"an array of shape {_shown(array.shape)}"
        raise InputError(where(name), found, _wanted(shape, time))
    return array


def _shown(shape: tuple[int, ...]) -> str:
    return "(" + ", ".join(map(str, shape)) + ("," if len(shape) == 1 else "") + ")"


def _wanted(shape: tuple[int, ...], time: str) -> str:
    return f"{_shown(shape)}: a row for each of the {shape[0]} times in {time}"
