"""What looks at free swings tell, and how known ways between them set their scale.

A free swing shows r and J up to one factor, so that r is wrong by as much as the moment of J that
is held at the drawing's value. The masses' ways from look to look are known, and tell that factor:
with z_i = up.(r_i + s_i) of look i, r_i being what it says of r with the masses at home and s_i the
shift at it,

    r_i + s_i = k (r + s_i),     z_i = h + k up.(s_i - s_n),    h = k up.(r + s_n)

is a straight line in the way to the last look n. Its slope k and its end h are found by weighted
least squares, k beginning at 1 with the sd of the drawing's inertia; then

    r = (r_n + s_n) / k - s_n        with h for the part of r_n + s_n along ``up``

Ways along ``up`` count, as swings are told from one another by their period. All looks must swing
about axes alike, or they do not share one k.

Sag is held at none: what is seen is the centre of mass of a stiff platform that behaves alike at
small tilts (``dynamics.sag_trim.acting_com``), and that is what is balanced. So is drift: in a
minute it is a tenth of a um, and the swing of a minute tells it from the height to ten.
"""

from typing import NamedTuple

import numpy as np

from equipoise.maths.linalg import inverse_spd
from equipoise.model.arrays import Floats, Square, Vector3
from equipoise.model.estimate import COM, Estimate
from equipoise.model.testbed import Testbed
from equipoise.model.torque_terms import GROUPS

METHOD = "trajectory"
LEAST, LEAST_SCALE = 1e-9, 1e-6  # m, -: no sd is smaller


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
    return (*J, *of_group(testbed, "sag"), *of_group(testbed, "drift"))


def of_group(testbed: Testbed, group: str) -> tuple[str, ...]:
    """Return the torques of a group (``model.torque_terms``) that a testbed considers."""
    return tuple(term for term in testbed.disturbances if term in GROUPS[group])


def shows(estimate: Estimate) -> bool:
    """Say whether a look showed the centre of mass."""
    return estimate.outcome.usable and estimate.sees(COM)


def shown(estimate: Estimate, shift: Vector3) -> Shown:
    """Return what a look said that was taken at a shift (m)."""
    return Shown(estimate.com, np.sqrt(np.diag(estimate.covariance_of(COM))), shift)


def line_of(
    measurements: tuple[Shown, ...], up: Vector3, inertia_sd: float
) -> tuple[Floats, Square]:
    """Return h (m) and k, and their covariance."""
    way = np.array(
        [up @ (measurement.shift - measurements[-1].shift) for measurement in measurements]
    )
    z = np.array([up @ (measurement.com + measurement.shift) for measurement in measurements])
    weight = np.array(
        [1.0 / max(float(np.abs(up) @ measurement.sd), LEAST) ** 2 for measurement in measurements]
    )
    sure = 1.0 / max(inertia_sd, LEAST_SCALE) ** 2
    A = np.column_stack([np.ones(len(measurements)), way])
    information = (A * weight[:, None]).T @ A + np.diag([0.0, sure])
    covariance = inverse_spd(information)
    return covariance @ ((A * weight[:, None]).T @ z + np.array([0.0, sure])), covariance


def combined(measurements: tuple[Shown, ...], up: Vector3, inertia_sd: float) -> Shown:
    """Return r (m) with the masses at home and its sd, by all looks, freed of their factor."""
    (h, k), covariance = line_of(measurements, up, inertia_sd)
    last, height = measurements[-1], h / k
    across: Vector3 = last.com + last.shift - (up @ (last.com + last.shift)) * up
    slope = np.array([1.0, -height]) / k
    sd = float(np.sqrt(slope @ covariance @ slope))
    return Shown(
        across / k + height * up - last.shift,
        last.sd - (np.abs(up) @ last.sd) * np.abs(up) + sd * np.abs(up),
        last.shift,
    )
