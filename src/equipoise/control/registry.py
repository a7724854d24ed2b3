"""The balancing laws, by name: the one list that terminal, tests and studies take."""

from typing import Any

from equipoise.control import (
    fully_actuated,
    l1_adaptive,
    momentum_buildup,
    pid,
    underactuated,
    underactuated_integral,
)
from equipoise.control.law import Law

ALL: tuple[Law[Any, Any], ...] = (
    pid.LAW,
    l1_adaptive.LAW,
    underactuated.LAW,
    underactuated_integral.LAW,
    fully_actuated.LAW,
    momentum_buildup.LAW,
)
LAWS: dict[str, Law[Any, Any]] = {law.card.name: law for law in ALL}
