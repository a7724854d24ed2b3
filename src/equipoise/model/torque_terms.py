"""Names and units of the torques other than gravity on the rigid centre of mass.

Each is one coefficient times one column of the regressor (``dynamics.regressor`` has the columns).
Groups are what a testbed file asks for under ``[disturbance]``.
"""

from collections.abc import Iterable

import numpy as np

from equipoise.model.arrays import Floats
from equipoise.model.errors import InputError, nearest

GROUPS: dict[str, tuple[str, ...]] = {
    "viscous": ("viscous_x", "viscous_y", "viscous_z"),
    "quadratic": ("quadratic",),
    "constant": ("constant_x", "constant_y", "constant_z"),
    "swirl": ("swirl",),
    "sag": ("sag_xx", "sag_yy", "sag_xy", "sag_xz", "sag_yz"),
    "drift": ("drift_x", "drift_y", "drift_z"),
    "thermal": ("thermal_x", "thermal_y", "thermal_z"),
}
TERMS: tuple[str, ...] = tuple(term for group in GROUPS.values() for term in group)
# Of each group the unit, and how large its terms are, SI, one sd, chosen: a few times what benches
# are reported to have. Where the data do not determine a term, this is its prior, and all else
# is as uncertain as that makes it.
SIZES: dict[str, tuple[str, float]] = {
    "viscous": ("N m s", 1e-4),
    "quadratic": ("N m s2", 1e-3),
    "constant": ("N m", 1e-5),
    "swirl": ("N m", 1e-5),
    "sag": ("m", 3e-5),
    "drift": ("m/s", 5e-9),
    "thermal": ("m/K", 5e-7),
}


def expand(names: tuple[str, ...], where: str = "disturbance") -> tuple[str, ...]:
    """Return the terms of groups and terms given by name, in the package's order."""
    wanted: set[str] = set()
    for name in names:
        if name not in GROUPS and name not in TERMS:
            raise InputError(where, f"'{name}'", nearest(name, [*GROUPS, *TERMS]))
        wanted.update(GROUPS.get(name, (name,)))
    return among(wanted)


def among(names: Iterable[str]) -> tuple[str, ...]:
    """Return the torques' terms among some names, each once, in the package's order."""
    wanted = set(names)
    return tuple(term for term in TERMS if term in wanted)


def typical(term: str) -> float:
    """Return how large a term's coefficient is on benches, one sd, SI."""
    return SIZES[term.split("_")[0]][1]


def typical_sizes(terms: Iterable[str]) -> Floats:
    """Return the same of several terms."""
    return np.array([typical(term) for term in terms])


def typical_torques(terms: Iterable[str]) -> tuple[tuple[str, float], ...]:
    """Return terms with the same."""
    return tuple((term, typical(term)) for term in terms)


def unit_of(term: str) -> str:
    """Return the SI unit of a term's coefficient."""
    return SIZES[term.split("_")[0]][0]
