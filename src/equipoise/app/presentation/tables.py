"""A record as plain columns and named arrays, and as what pandas and xarray make of them."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from equipoise.model.arrays import Floats
from equipoise.model.optional_libraries import extra_library

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
    pandas = extra_library("pandas", "to_pandas", "a DataFrame", "analysis")
    return pandas.DataFrame(dict(table)).set_index(next(iter(table)))


def to_dataset(arrays: Arrays) -> Any:
    """Return an ``xarray.Dataset``. Raises InputError where xarray is missing."""
    xarray = extra_library("xarray", "to_xarray", "a Dataset", "analysis")
    parts = (_with_units(arrays.variables), _with_units(arrays.coordinates))
    return xarray.Dataset(*parts, dict(arrays.attributes))


def _with_units(of: Mapping[str, Variable]) -> dict[str, Any]:
    return {
        name: (each.dims, np.asarray(each.values), {"units": each.unit} if each.unit else {})
        for name, each in of.items()
    }
