"""The balancing laws, by name: the one list that terminal, tests and studies take."""

from typing import Any

from equipoise.control.law import Law
from equipoise.control.laws import (
    coarse_fine,
    fully_actuated,
    impulse_feedback,
    ivanov_25s,
    l1_adaptive,
    momentum_buildup,
    parameter_adaptive,
    pid,
    planar_magnetic,
    slew_and_measure,
    underactuated,
    underactuated_integral,
)

ALL: tuple[Law[Any, Any], ...] = (
    pid.LAW,
    l1_adaptive.LAW,
    underactuated.LAW,
    underactuated_integral.LAW,
    planar_magnetic.LAW,
    coarse_fine.LAW,
    ivanov_25s.LAW,
    slew_and_measure.LAW,
    impulse_feedback.LAW,
    fully_actuated.LAW,
    momentum_buildup.LAW,
    parameter_adaptive.LAW,
)
LAWS: dict[str, Law[Any, Any]] = {law.card.name: law for law in ALL}
