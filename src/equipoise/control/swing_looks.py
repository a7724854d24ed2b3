"""What looks at free swings tell, and how a known way between two of them sets their scale.

A free swing shows r and J up to one factor, so that r is wrong by as much as the moment of J that
is held at the drawing's value. The masses' way from one look to another is known, and tells that
factor k, and so r with the masses at home:

    r_i + s_i = k (r + s_i),     k = up.( r_1 + s_1 - r_2 - s_2 ) / up.( s_1 - s_2 )
    r = ( r_2 + s_2 ) / k - s_2

r_i is what look i says of r with the masses at home, s_i the shift at it; the way must be along
``up``, where swings are told from one another by their period. All looks must swing about axes
alike, or they do not share one k.

Sag is held at none: what is seen is the centre of mass of a stiff platform that behaves alike at
small tilts (``dynamics.sag_trim.acting_com``), and that is what is balanced.
"""

from typing import NamedTuple

import numpy as np

from equipoise.model.arrays import Vector3
from equipoise.model.estimate import COM, Estimate
from equipoise.model.testbed import Testbed

METHOD = "momentum_corrected"


class Shown(NamedTuple):
    """What a look said."""

    com: Vector3  # m, masses at home
    sd: Vector3
    shift: Vector3  # m, at the look


def held(testbed: Testbed) -> tuple[str, ...]:
    """Return what a small swing about horizontal axes does not show, and one moment of J."""
    z = int(np.argmax(np.abs(testbed.up)))
    x, y = (i for i in range(3) if i != z)
    pairs = ((x, x), (z, z), (x, z), (y, z))
    J = tuple("inertia_P_" + "".join("xyz"[i] for i in sorted(pair)) for pair in pairs)
    return (*J, *(term for term in testbed.disturbances if term.startswith("sag")))


def shows(seen: Estimate) -> bool:
    """Say whether a look showed the centre of mass."""
    return seen.outcome.usable and seen.sees(COM)


def shown(seen: Estimate, shift: Vector3) -> Shown:
    """Return what a look said that was taken at a shift (m)."""
    return Shown(seen.com, np.sqrt(np.diag(seen.covariance_of(COM))), shift)


def unscaled(first: Shown, last: Shown, up: Vector3) -> Vector3:
    """Return r (m) with the masses at home, freed of the factor that both looks share."""
    way = float(up @ (first.shift - last.shift))
    k = float(up @ (first.com + first.shift - last.com - last.shift)) / way
    return (last.com + last.shift) / k - last.shift


def believed(looks: tuple[Shown, ...], up: Vector3) -> Vector3:
    """Return r (m) with the masses at home by the last look; a single look's as it is."""
    return looks[0].com if len(looks) == 1 else unscaled(looks[0], looks[-1], up)
