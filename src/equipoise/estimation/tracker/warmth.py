"""What the tracker knows of warmth: how far a kelvin moves the centre of mass, and how warm it is.

r <- r + k dT: k (m/K) is a state. How warm it is, ``known_inputs`` says.

Cannot tell k from a walk of r that happens to follow the temperature.
"""

from dataclasses import dataclass

import numpy as np

from equipoise.model.arrays import Floats, Vector3
from equipoise.model.estimate import Estimate
from equipoise.model.torque_terms import GROUPS, typical_sizes

THERMAL = GROUPS["thermal"]


@dataclass(frozen=True, slots=True, eq=False)
class Warmth:
    """What a kelvin moves the centre of mass by, and how well that is known."""

    thermal: Vector3  # m/K
    covariance: Floats  # (3, 12) of it with com, J and itself


def unknown_warmth() -> Warmth:
    """Return what is known before anything was warmed: how large it is on benches."""
    variance = typical_sizes(THERMAL) ** 2
    return Warmth(np.zeros(3), np.hstack([np.zeros((3, 9)), np.diag(variance)]))


def warmth_of(estimate: Estimate | None, names: tuple[str, ...]) -> Warmth:
    """Return what an estimate says of warmth, and its covariance with com and J by name, if any."""
    if estimate is None or not estimate.sees(THERMAL):
        return unknown_warmth()
    covariance = estimate.covariance_of((*names, *THERMAL))
    known = np.zeros((3, 12))
    known[:, : len(names)], known[:, 9:] = covariance[-3:, : len(names)], covariance[-3:, -3:]
    return Warmth(estimate.values(THERMAL), known)
