"""Before and after: what balancing did to a platform, as rows for a table."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

from equipoise.app.numbers import fixed, is_known, with_sd
from equipoise.app.units import MICRO, UM
from equipoise.assessment.residual_torque import Uncertain, level_torque, swing_period
from equipoise.model.arrays import Matrix3, Vector3
from equipoise.model.mass_properties import MassProperties
from equipoise.model.testbed import Testbed


@dataclass(frozen=True, slots=True, eq=False)
class Believed:
    """A centre of mass with the masses as they stand, m."""

    com: Vector3
    sd: Vector3


@dataclass(frozen=True, slots=True, eq=False)
class Change:
    """A platform before and after; truths only when it is simulated."""

    testbed: Testbed
    inertia_P: Matrix3  # kg m^2, as last estimated, else the testbed's
    target: Vector3  # m
    before: Believed
    after: Believed
    truth_before: MassProperties | None = None
    truth_after: MassProperties | None = None


class Row(NamedTuple):
    """One line of the table, as texts."""

    name: str
    unit: str
    before: str
    after: str
    target: str
    truth_before: str
    truth_after: str


HEADS = ("", "unit", "before", "after", "target", "truth before", "truth after")


def rows(change: Change) -> Iterator[Row]:
    """Yield centre of mass, torque when level, period of swing."""
    for i, axis in enumerate("xyz"):
        yield Row(
            f"centre of mass {axis}",
            "um",
            *(_shown(Uncertain(b.com[i], b.sd[i]), UM) for b in (change.before, change.after)),
            fixed(change.target[i] * UM, 1),
            *(_true(truth and truth.com[i], UM) for truth in _truths(change)),
        )
    yield _torque(change)
    yield _period(change)


def _truths(change: Change) -> tuple[MassProperties | None, MassProperties | None]:
    return change.truth_before, change.truth_after


def _torque(change: Change) -> Row:
    bed = change.testbed
    weight, zero = bed.body.mass * bed.gravity, change.target * 0

    def torque(com: Vector3, sd: Vector3) -> Uncertain:
        return level_torque(weight, com, sd, bed.up)

    return Row(
        "gravity torque when level",
        "uN m",
        *(_shown(torque(b.com, b.sd), MICRO) for b in (change.before, change.after)),
        fixed(torque(change.target, zero).value * MICRO, 0),
        *(_true(truth and torque(truth.com, zero).value, MICRO) for truth in _truths(change)),
    )


def _period(change: Change) -> Row:
    bed = change.testbed
    weight, zero = bed.body.mass * bed.gravity, change.target * 0

    def period(com: Vector3, sd: Vector3, inertia: Matrix3) -> Uncertain:
        return swing_period(weight, com, sd, inertia, bed.up)

    return Row(
        "period of swing",
        "s",
        *(
            _shown(period(b.com, b.sd, change.inertia_P), 1.0)
            for b in (change.before, change.after)
        ),
        _true(period(change.target, zero, change.inertia_P).value, 1.0),
        *(
            _true(truth and period(truth.com, zero, truth.inertia_P).value, 1.0)
            for truth in _truths(change)
        ),
    )


def _shown(number: Uncertain, factor: float) -> str:
    value, sd = number.value * factor, number.sd * factor
    if is_known(value, sd):
        return " ± ".join(with_sd(value, sd))
    return _true(number.value, factor)


def _true(value: float | None, factor: float) -> str:
    if value is None:
        return ""
    return f"{value * factor:.4g}" if abs(value) < float("inf") else "topples"
