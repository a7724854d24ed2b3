"""The moment of inertia about a known axis, from the period of a swing about it.

The axis has the direction n and goes through a; its support holds it: knife edges, a shaft, a wire.
Moments about a line are linear in the moments p = (M, mu, J) about P (``part_moments``):

    J_n = n.J n - 2 [ a.mu - (n.a)(n.mu) ] + M (a.a - (n.a)^2)
    s   = mu - M a                                        first moment about a
    J_n w0^2 = k

    by gravity, axis level      k = g |n x s|             the platform hangs with s below the axis
    on a wire, axis upright     k as stated
    w0^2 = (2 pi / T0)^2 + l^2                            T0 the period with the damping l
    T    = T0 / agm(1, cos(A/2))                          by gravity, amplitude A; a wire has T = T0

(Olsen 1996 analyses oscillations about orthogonal axes: da Silva 2021 section 3.1.2. agm is the
arithmetic-geometric mean, which gives the elliptic integral.) A weight m_w at b adds m_w (d.d -
(n.d)^2), d = b - a, to J_n and m_w d to s; a fixture adds its own inertia. By gravity alone a swing
shows J_n and s by their ratio: the known weight, or a known centre of mass, sets the scale.

What it cannot see: the other axes, which have to be held. On a spherical bearing swings about two
axes couple through products of inertia; there the record of the motion itself says more
(`equipoise identify`).
"""

from typing import NamedTuple

import numpy as np

from equipoise.estimation.mass_budget.part_moments import INERTIA, about_P, along
from equipoise.maths.axes_across import axes_across
from equipoise.maths.complex_step import jacobian
from equipoise.model.arrays import Complexes, Floats
from equipoise.model.errors import InputError
from equipoise.model.mass_budget import Oscillation
from equipoise.model.units import MM

ROUNDS = 6  # of the arithmetic-geometric mean, which doubles its digits each time
LEAST_LEVER = 1e-6  # kg m, chosen: 14 kg hung by 0.1 um; no swing about a level axis is so slow


class Measured(NamedTuple):
    """A swing's equation, linear about some moments: row @ (p - p0) = -left, with an sd."""

    row: Floats  # (10,)
    left: float  # kg m^2, of J_n minus what the period makes it
    sd: float  # kg m^2
    moment: float  # kg m^2, what the period makes J_n


def agm(a: complex, b: complex) -> complex:
    """Return the arithmetic-geometric mean."""
    for _ in range(ROUNDS):
        a, b = (a + b) / 2, np.sqrt(a * b)
    return a


def numbers_of(swing: Oscillation) -> tuple[Floats, Floats]:
    """Return what is known of a swing, with its sd: two small turns of its axis come last."""
    k = swing.stiffness or 0.0
    known = [swing.period, swing.amplitude, k, swing.fixture, swing.weight, *swing.place, 0.0, 0.0]
    sd = [swing.period_sd, swing.amplitude_sd, swing.stiffness_sd * k, swing.fixture_sd,
          swing.weight_sd, *[swing.place_sd] * 3, swing.axis_sd, swing.axis_sd]  # fmt: skip
    return np.array(known, float), np.array(sd, float)


def both_sides(swing: Oscillation, p: Complexes, known: Complexes) -> tuple[complex, complex]:
    """Return J_n of the moments, and what the period makes it, kg m^2."""
    period, amplitude, stiffness, fixture, weight = known[:5]
    n = swing.axis + known[8:] @ axes_across(swing.axis)
    a, d = swing.through, known[5:8] - swing.through
    mass, first = p[0], p[1:4]
    moment = along(n) @ p[INERTIA] - 2 * (a @ first - (n @ a) * (n @ first))
    moment += mass * (a @ a - (n @ a) ** 2) + weight * (d @ d - (n @ d) ** 2) + fixture
    if swing.stiffness is None:
        lever = np.cross(n, first - mass * a + weight * d)
        stiffness = swing.gravity * np.sqrt(lever @ lever)
        period = period * agm(1.0, np.cos(amplitude / 2))
    return moment, stiffness / ((2 * np.pi / period) ** 2 + swing.decay**2)


def measured(swing: Oscillation, p: Floats) -> Measured:
    """Return a swing's equation about moments p."""
    known, sd = numbers_of(swing)
    check_lever(swing, p)
    at = np.concatenate([p, known])

    def left(x: Complexes) -> Complexes:
        have, made = both_sides(swing, x[:10], x[10:])
        return np.array([have - made])

    slopes = jacobian(left, at)[0]
    have, made = both_sides(swing, p.astype(complex), known.astype(complex))
    spread = float(np.linalg.norm(slopes[10:] * sd))
    return Measured(slopes[:10], float((have - made).real), spread, float(made.real))


def check_lever(swing: Oscillation, p: Floats) -> None:
    """Raise InputError where gravity does not turn the platform back."""
    if swing.stiffness is not None:
        return
    d = swing.place - swing.through
    lever = np.linalg.norm(np.cross(swing.axis, p[1:4] - p[0] * swing.through + swing.weight * d))
    if lever < LEAST_LEVER:
        com = ", ".join(f"{x / MM:.3g}" for x in about_P(p.astype(complex))[1:4].real)
        wanted = "a weight away from the axis, or stiffness_N_m of the wire that turns it back"
        raise InputError(
            f"oscillation {swing.name}", f"a centre of mass on its axis ({com} mm from P)", wanted
        )
