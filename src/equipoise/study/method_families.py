"""Families of methods, as the review's section 3 and Table 2 divide them, and those it has not.

    least squares    batch (section 3.1, Eqs. 8-21): every linear method, and rest positions
    recursive        the same rows one after the other (Eqs. 22-25)
    Kalman filter    on the simplified model (Eqs. 28-31)
    extended         Kalman filters with Jacobians (Eqs. 32-38), the tracker among them
    unscented        Kalman filters with sigma points (sections 3.2 and 4.1, without equations)
    whole record     maximum likelihood on all rows at once; not in the review

Source: da Silva et al., A review of balancing methods for satellite simulators, 2021.
"""

from types import ModuleType
from typing import Literal

from equipoise.estimation.methods import equilibrium, registry, tracker

Family = Literal[
    "least squares",
    "recursive",
    "Kalman filter",
    "extended Kalman filter",
    "unscented Kalman filter",
    "whole record",
]
RECURSIVE: tuple[Family, ...] = (
    "recursive",
    "Kalman filter",
    "extended Kalman filter",
    "unscented Kalman filter",
)
FILTERS: dict[str, Family] = {
    "kf": "Kalman filter",
    "ekf": "extended Kalman filter",
    "ukf": "unscented Kalman filter",
}


def family_of(module: ModuleType) -> Family:
    """Return the family of a method's module."""
    if module in registry.LINEAR or module is equilibrium:
        return "least squares"
    if module in registry.REGRESSIONS:
        return "recursive"
    if module in registry.FILTERS:
        return FILTERS[module.METHOD.card.name.split("_")[0]]
    return "extended Kalman filter" if module is tracker else "whole record"


FAMILY: dict[str, Family] = {
    module.METHOD.card.name: family_of(module)
    for module in (*registry.WHOLE, *registry.LINEAR, *registry.REGRESSIONS, *registry.FILTERS)
}
