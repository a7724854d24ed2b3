"""The balancing laws, by name: the one list that terminal, tests and studies take."""

from typing import Any

from equipoise.control import momentum_buildup, pid
from equipoise.control.law import Law

ALL: tuple[Law[Any, Any], ...] = (pid.LAW, momentum_buildup.LAW)
LAWS: dict[str, Law[Any, Any]] = {law.card.name: law for law in ALL}
