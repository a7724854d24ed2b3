"""The balancing laws, by name: the one list that terminal, tests and studies take."""

from typing import Any

from equipoise.control.law import Law

ALL: tuple[Law[Any, Any], ...] = ()
LAWS: dict[str, Law[Any, Any]] = {law.card.name: law for law in ALL}
