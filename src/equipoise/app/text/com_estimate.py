"""The centre of mass that an estimate or a step states."""

from dataclasses import dataclass

import numpy as np

from equipoise.model.arrays import Vector3
from equipoise.model.estimate import COM, END, Estimate
from equipoise.model.step import Step


@dataclass(frozen=True, slots=True, eq=False)
class ComEstimate:
    """A centre of mass with the masses as they stand, m."""

    com: Vector3
    sd: Vector3


def at_home(estimate: Estimate) -> ComEstimate | None:
    """Return the centre of mass with the masses at home."""
    return _com_estimate(estimate, COM)


def as_it_stands(estimate: Estimate) -> ComEstimate | None:
    """Return the centre of mass with the masses as they stood at the end of the recording."""
    return _com_estimate(estimate, END) or at_home(estimate)


def com_after(step: Step) -> ComEstimate | None:
    """Return what a step says of it: its verdict, else its estimate; None if it says nothing."""
    verdict, estimate = step.verdict, step.estimate
    if verdict is not None and verdict.com is not None:
        return ComEstimate(verdict.com, np.zeros(3) if verdict.sd is None else verdict.sd)
    return None if estimate is None else as_it_stands(estimate)


def _com_estimate(estimate: Estimate, names: tuple[str, ...]) -> ComEstimate | None:
    if not all(map(estimate.has, names)):
        return None
    sd = np.array([estimate.parameters[estimate.index(name)].sd for name in names])
    return ComEstimate(estimate.values(names), sd)
