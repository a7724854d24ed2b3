"""Estimates from free swings, and the scale that known shifts between them determine.

A free swing determines r and J up to one factor, so that r is wrong by as much as the moment of J
that is held at its nominal value. The masses' shifts from one measurement to the next are known and
determine that factor. With z_i = up.(r_i + s_i) of measurement i, r_i its estimate of r with the
masses at home and s_i the shift at it,

    r_i + s_i = k (r + s_i),     z_i = h + k up.(s_i - s_n),    h = k up.(r + s_n)

is a straight line in the shift to the last measurement n. Its slope k and its end h are found by
weighted least squares, with 1 and the sd of the nominal inertia as the prior of k; then

    r = (r_n + s_n) / k - s_n        with h for the part of r_n + s_n along ``up``

Shifts along ``up`` count, as swings differ in their period. All measurements must swing about the
same axes, or they do not share one k.

Sag is held at none. The estimate is the centre of mass of a stiff platform that behaves alike at
small tilts (``dynamics.sag_trim.acting_com``), and that one is balanced. So is drift: in a minute
it is a tenth of a um, and the swing of a minute separates it from the height to ten.
"""

from typing import NamedTuple

import numpy as np

from equipoise.maths.linalg import inverse_spd
from equipoise.model.arrays import Floats, Square, Vector3
from equipoise.model.estimate import COM, Estimate
from equipoise.model.reasons.law_reasons import LawReason
from equipoise.model.reasons.reason import Reason, one_reason
from equipoise.model.testbed import Testbed
from equipoise.model.torque_terms import GROUPS

METHOD = "trajectory"
LEAST, LEAST_SCALE = 1e-9, 1e-6  # m, -: no sd is smaller
STEEP = 6.0  # chosen: of the sideways sd, so that the platform leans by ten degrees at most
UNSURE = 2.0  # sds of the height that must still hang


class Shown(NamedTuple):
    """The estimate of one measurement."""

    com: Vector3  # m, masses at home
    sd: Vector3
    shift: Vector3  # m, at the measurement


def held(testbed: Testbed) -> tuple[str, ...]:
    """Return what a small swing about horizontal axes does not determine, and one moment of J."""
    z = int(np.argmax(np.abs(testbed.up)))
    x, y = (i for i in range(3) if i != z)
    pairs = ((x, x), (z, z), (x, z), (y, z))
    J = tuple("inertia_P_" + "".join("xyz"[i] for i in sorted(pair)) for pair in pairs)
    return (*J, *testbed.in_group("sag"), *testbed.in_group("drift"))


def hanging_shift(testbed: Testbed, least: float) -> tuple[float, float]:
    """Return the depth (m) of a first swing, ``least`` or more, and the shift (m) along -up to it.

    The depth keeps the lean by the likely sideways offset within ten degrees; the shift adds what
    is uncertain of the height.
    """
    up, sd = testbed.up, testbed.com_sd
    depth = max(STEEP * float(np.linalg.norm(sd - (sd @ up) * up)), least)
    return depth, depth + UNSURE * float(abs(up @ sd)) + float(testbed.body.com @ up)


def shows(estimate: Estimate) -> bool:
    """Say whether a measurement showed the centre of mass."""
    return estimate.outcome.usable and estimate.sees(COM)


def why_not_shown(estimate: Estimate) -> tuple[Reason, ...]:
    """Return why a measurement does not show the centre of mass."""
    return (*one_reason(LawReason.COM_NOT_SHOWN), *estimate.outcome.reasons)


def drift_of(estimate: Estimate) -> Vector3:
    """Return how fast the centre of mass drifts, m/s; com is that at the start of its record."""
    names = GROUPS["drift"]
    return np.array([float(estimate.values((n,))[0]) if estimate.has(n) else 0.0 for n in names])


def shown(estimate: Estimate, shift: Vector3) -> Shown:
    """Return the estimate of a measurement that was made at a shift (m)."""
    return Shown(estimate.com, np.sqrt(np.diag(estimate.covariance_of(COM))), shift)


def line_of(
    measurements: tuple[Shown, ...], up: Vector3, inertia_sd: float
) -> tuple[Floats, Square]:
    """Return h (m) and k, and their covariance."""
    way = np.array([up @ (each.shift - measurements[-1].shift) for each in measurements])
    z = np.array([up @ (each.com + each.shift) for each in measurements])
    weight = np.array([1.0 / max(float(np.abs(up) @ m.sd), LEAST) ** 2 for m in measurements])
    sure = 1.0 / max(inertia_sd, LEAST_SCALE) ** 2
    A = np.column_stack([np.ones(len(measurements)), way])
    information = (A * weight[:, None]).T @ A + np.diag([0.0, sure])
    covariance = inverse_spd(information)
    return covariance @ ((A * weight[:, None]).T @ z + np.array([0.0, sure])), covariance


def combined(measurements: tuple[Shown, ...], up: Vector3, inertia_sd: float) -> Shown:
    """Return r (m), masses at home, and its sd, by all measurements without their factor."""
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
