"""A record as plain columns and named arrays, and as what pandas and xarray make of them."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from importlib import import_module
from typing import Any

import numpy as np

from equipoise.model.arrays import Floats
from equipoise.model.errors import InputError

# Columns of the same length by name; the first one names the rows.
Table = Mapping[str, Sequence[Any] | Floats]


@dataclass(frozen=True, slots=True, eq=False)
class Variable:
    """One array; ``dims`` names its axes in order."""

    dims: tuple[str, ...]
    values: Floats | Sequence[Any]
    unit: str = ""  # SI; empty: no number, or units stand beside it


@dataclass(frozen=True, slots=True, eq=False)
class Arrays:
    """Variables by name, and what their dimensions count in."""

    variables: Mapping[str, Variable]
    coordinates: Mapping[str, Variable]
    attributes: Mapping[str, str] = field(default_factory=dict[str, str])


def of_table(table: Table) -> Arrays:
    """Return a table's columns along the first one."""
    index = next(iter(table))
    columns = {name: Variable((index,), values) for name, values in table.items()}
    return Arrays(columns, {index: columns.pop(index)})


def to_frame(table: Table) -> Any:
    """Return a ``pandas.DataFrame`` with its index. Raises InputError where pandas is missing."""
    pandas = analysis_library("pandas", "to_pandas")
    return pandas.DataFrame(dict(table)).set_index(next(iter(table)))


def to_dataset(arrays: Arrays) -> Any:
    """Return an ``xarray.Dataset``. Raises InputError where xarray is missing."""
    xarray = analysis_library("xarray", "to_xarray")
    parts = (_with_units(arrays.variables), _with_units(arrays.coordinates))
    return xarray.Dataset(*parts, dict(arrays.attributes))


def _with_units(of: Mapping[str, Variable]) -> dict[str, Any]:
    return {
        name: (each.dims, np.asarray(each.values), {"units": each.unit} if each.unit else {})
        for name, each in of.items()
    }


def analysis_library(name: str, where: str) -> Any:
    """Return a library of the extra ``analysis``; InputError names ``where`` it was needed."""
    try:
        return import_module(name)
    except ImportError as error:
        wanted = "the analysis extra: `pip install equipoise[analysis]`"
        raise InputError(where, f"no library '{name}'", wanted) from error
