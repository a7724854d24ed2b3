"""Before and after: what balancing did to a platform, as rows for a table."""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial

import numpy as np

from equipoise.app.text.blocks import Column, Table, number, table
from equipoise.app.text.com_estimate import ComEstimate
from equipoise.app.text.numbers import Unit, decimals_for, fixed, is_known, with_sd
from equipoise.assessment.metrics.residual_torque import (
    Uncertain,
    level_torque,
    swing_period,
    with_doubtful_inertia,
)
from equipoise.model.arrays import Matrix3, Vector3
from equipoise.model.mass_properties import MassProperties
from equipoise.model.testbed import Testbed
from equipoise.model.units import UM, UN_M


@dataclass(frozen=True, slots=True, eq=False)
class Change:
    """A platform before and after; truths only when it is simulated."""

    testbed: Testbed
    inertia_P: Matrix3  # kg m^2, as last estimated, else the testbed's
    inertia_sd: float  # -, relative
    target: Vector3  # m
    before: ComEstimate
    after: ComEstimate
    truth_before: MassProperties | None = None
    truth_after: MassProperties | None = None


NUMBERS = ("before", "after", "target", "truth before", "truth after")


def change_table(change: Change) -> Table:
    """Return before and after side by side; the truth beside them when it is known."""
    shown = NUMBERS[:3] if change.truth_before is None else NUMBERS
    columns = (Column(), Column("unit"), *map(number, shown))
    return table("Before and after", columns, (line[: len(columns)] for line in rows(change)))


def rows(change: Change) -> Iterator[tuple[str, ...]]:
    """Yield name, unit and ``NUMBERS`` of centre of mass, torque when level, period of swing."""
    for i, axis in enumerate("xyz"):
        yield _row(f"centre of mass {axis}", Unit("um", UM), change, partial(_component, i))
    yield _row("gravity torque when level", Unit("uN m", UN_M), change, _torque)
    yield _row("period of swing", Unit("s", 1.0), change, _period)


Quantity = Callable[[Change, ComEstimate, Matrix3], Uncertain]


def _component(axis: int, change: Change, at: ComEstimate, inertia: Matrix3) -> Uncertain:
    return Uncertain(float(at.com[axis]), float(at.sd[axis]))


def _torque(change: Change, at: ComEstimate, inertia: Matrix3) -> Uncertain:
    return level_torque(change.testbed.weight, at.com, at.sd, change.testbed.up)


def _period(change: Change, at: ComEstimate, inertia: Matrix3) -> Uncertain:
    period = swing_period(change.testbed.weight, at.com, at.sd, inertia, change.testbed.up)
    return with_doubtful_inertia(period, change.inertia_sd)


def _row(name: str, unit: Unit, change: Change, quantity: Quantity) -> tuple[str, ...]:
    """Return one line: the truths and the target with the digits that the result bears."""
    estimated = [quantity(change, at, change.inertia_P) for at in (change.before, change.after)]
    before, after = (Uncertain(n.value / unit.size, n.sd / unit.size) for n in estimated)

    def exact(com: Vector3, inertia: Matrix3) -> str:
        value = quantity(change, ComEstimate(com, np.zeros(3)), inertia).value / unit.size
        return _exact(value, after)

    truths = (change.truth_before, change.truth_after)
    shown = ("" if truth is None else exact(truth.com, truth.inertia_P) for truth in truths)
    target = exact(change.target, change.inertia_P)
    return name, unit.name, _shown(before), _shown(after), target, *shown


def _shown(number: Uncertain) -> str:
    if is_known(*number):
        return " ± ".join(with_sd(*number))
    return _exact(number.value, number)


def _exact(value: float, like: Uncertain) -> str:
    if not math.isfinite(value):
        return "topples"
    return fixed(value, decimals_for(like.sd)) if is_known(*like) else f"{value:.4g}"
