"""Jet pairs: impulses about their axes, and back.

    impulse on the platform = sum p_i a_i,     on for |p_i| / torque_i

p = A^+ wanted, the least that give it. A pulse shorter than the jet's least time on is not made:
none is made longer than it should be. The remainder is returned, to be requested again with the
next impulse. It stays below the sum of the least pulses, but for its part outside the span of the
axes. Lags are not modelled.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from equipoise.actuators.reaction_wheels import axes_of
from equipoise.model.arrays import Floats, Vector3
from equipoise.model.devices import JetPair


class Pulses(NamedTuple):
    """The pulses of jets, and the impulse that they do not deliver."""

    impulses: Floats  # (n,) N m s, about each axis
    left: Vector3  # N m s, of what was wanted, body axes


def on_platform(jets: Sequence[JetPair], about_axes: Floats) -> Floats:
    """Return impulse or torque on the platform (..., 3) of those about the axes (..., n)."""
    return about_axes @ axes_of(jets)


def pulses_for(jets: Sequence[JetPair], wanted: Vector3) -> Pulses:
    """Return pulses for an impulse on the platform (N m s), and what is left over."""
    impulses = np.linalg.pinv(axes_of(jets).T) @ wanted
    on = abs(impulses) / np.array([jet.torque for jet in jets])
    made = np.where(on >= np.array([jet.min_pulse for jet in jets]), impulses, 0.0)
    return Pulses(made, wanted - on_platform(jets, made))
