"""What the tracker knows of warmth: how far a kelvin moves the centre of mass, and how warm it is.

r <- r + k dT: k (m/K) is a state. What says how warm it is, is kept from one call to the next: the
last temperature, or all switches of a lamp.

Cannot tell k from a walk of r that happens to follow the temperature.
"""

from dataclasses import dataclass, replace

import numpy as np

from equipoise.dynamics.timeline import straight_lines
from equipoise.model.arrays import Floats, Vector3
from equipoise.model.estimate import Estimate
from equipoise.model.recording import Recording, Samples, join
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


def heat_of(before: Recording | None, recording: Recording) -> Recording:
    """Return what says how warm it is and was: temperature and lamp, those before included."""
    fresh = Recording(temperature=recording.temperature, lamp=recording.lamp)
    return fresh if before is None else join(before, fresh)


def heat_kept(heat: Recording, since: float) -> Recording:
    """Return of the same what later rows need: temperature from ``since`` (s) on, all switches.

    The temperature at that moment is the one that was taken for it: what comes later does not
    change how warm it was.
    """
    temperature, lamp = heat.temperature, heat.lamp
    if temperature is not None and len(temperature):
        first = straight_lines(temperature, np.array([since]), 1)
        later = temperature.where(temperature.t > since)
        t, values = np.append(since, later.t), np.vstack([first, later.values])
        temperature = Samples(t, values)
    if lamp is not None and len(lamp):
        changes = np.diff(lamp.values[:, 0], prepend=np.nan) != 0
        lamp = lamp.where(changes | (lamp.t == lamp.t[-1]))
    return replace(heat, temperature=temperature, lamp=lamp)
