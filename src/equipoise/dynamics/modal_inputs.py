"""What modes do to the body that bears them, as known inputs along a record.

Modes that are known to move by e(t) are stored momentum and torque to the rigid body:

    h = sum d e',      tau = (sum s e) x g_B

A fit that takes them as given has the same motion as the coupled equations (``modal_motion``) once
they follow from that very motion. They fix no scale: d counts in units of the body's own inertia.
"""

from dataclasses import dataclass

import numpy as np

from equipoise.maths.straight_lines import read_at
from equipoise.model.recording import Samples


@dataclass(frozen=True, slots=True, eq=False)
class ModalInputs:
    """Momentum and torque of all modes of a platform, at the same times."""

    momentum: Samples  # N m s, body axes
    torque: Samples  # N m, body axes


def summed(known: Samples | None, more: Samples | None) -> Samples | None:
    """Return the sum of two known inputs at the times of both; None is none."""
    if known is None or more is None or not len(known):
        return known if more is None else more
    t = np.union1d(known.t, more.t)
    return Samples(t, read_at(t, known.t, known.values) + read_at(t, more.t, more.values))
