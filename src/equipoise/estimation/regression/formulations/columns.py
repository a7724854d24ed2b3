"""What every row is made of, at every time: momentum by J, torque by com and terms, what is known.

    H = W(w) p + k,        k = dJ(d) w + h
    H' + w x H = m r x g_B + sum_k c_k T_k + dmu(d) x g_B + tau

tau, which is recorded and may jump between two rows, is given as its exact integral. k is momentum
that is known once w is: masses off home, masses travelling, wheels. Formulations differ only in
what they make of these.
"""

from typing import NamedTuple

import numpy as np

from equipoise.actuators.sliding_masses import inertia_shift, mass_maps
from equipoise.dynamics.lamp_warmth import temperature_of
from equipoise.dynamics.regressor import MOMENT, TORQUE, WIDTH, regressor
from equipoise.dynamics.timeline import straight_lines, warmth
from equipoise.maths.attitude import to_matrix
from equipoise.maths.kernels.compiled import kernel
from equipoise.maths.linalg import unpack_symmetric
from equipoise.maths.straight_lines import integral_at
from equipoise.model import torque_terms
from equipoise.model.arrays import Floats, Series1, Series3, Series4
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed


class Columns(NamedTuple):
    """At every time, in body axes."""

    momentum: Floats  # (n, 3, 6) W(w), by J xx yy zz xy xz yz
    torque: Floats  # (n, 3, 3 + terms) by com (m), then by the terms' coefficients
    known_momentum: Series3  # k, N m s
    shifted: Series3  # dmu x g_B, N m
    impulse: Series3  # integral of tau from the first row on, N m s
    R: Floats  # (n, 3, 3) body to laboratory
    g: Series3  # m/s^2


@kernel
def regressor_rows(
    w: Floats, g: Floats, t: Floats, warm: Floats, mass: float, gravity: float, out: Floats
) -> None:
    """Write the regressor of every sample, shape (n, 3, 28)."""
    for i in range(t.shape[0]):
        wi, gi = (w[i, 0], w[i, 1], w[i, 2]), (g[i, 0], g[i, 1], g[i, 2])
        regressor(wi, gi, t[i] - t[0], warm[i], mass, gravity, True, out[i])


def known_momentum(
    recording: Recording, testbed: Testbed, t: Series1, w: Series3
) -> tuple[Series3, Series3]:
    """Return k (N m s) and the known change of first moment dmu (kg m) at times t."""
    bend, h, dmu = moved_masses(recording, testbed, t)
    return np.einsum("nij,nj->ni", bend, w) + h, dmu


def moved_masses(
    recording: Recording, testbed: Testbed, t: Series1
) -> tuple[Floats, Series3, Series3]:
    """Return dJ (n, 3, 3) kg m^2, momentum h of what moves inside (N m s) and dmu (kg m)."""
    maps = mass_maps(testbed.masses)
    d = straight_lines(recording.masses, t, len(testbed.masses))
    travel: Floats = np.gradient(d, t, axis=0) if len(t) > 1 else 0 * d
    bend = np.moveaxis(unpack_symmetric(inertia_shift(maps, d).T), -1, 0)
    h = travel @ maps.momentum + straight_lines(recording.momentum, t, 3)
    return bend, h, d @ maps.first_moment


def columns(
    recording: Recording,
    testbed: Testbed,
    motion: tuple[Series1, Series4, Series3],
    terms: tuple[str, ...] = (),
) -> Columns:
    """Return the columns for attitudes q and rates w (rad/s) at times t (s)."""
    t, q, w = motion
    R = to_matrix(q)
    g = np.ascontiguousarray(-testbed.gravity * R[:, 2, :])
    full = np.zeros((len(t), 3, WIDTH))
    warm = warmth(temperature_of(recording, testbed), t)[:, 0]
    regressor_rows(w, g, t, warm, testbed.body.mass, testbed.gravity, full)
    wanted = [TORQUE + torque_terms.TERMS.index(term) for term in terms]
    torque = full[:, :, [*range(MOMENT, TORQUE), *wanted]]
    torque[:, :, :3] *= testbed.body.mass
    k, dmu = known_momentum(recording, testbed, t, w)
    shifted, impulse = np.cross(dmu, g), known_impulse(recording, t)
    return Columns(full[:, :, :MOMENT], torque, k, shifted, impulse, R, g)


def known_impulse(recording: Recording, t: Series1) -> Series3:
    """Return the integral of the known torque from the first of the times t on, N m s."""
    reported = recording.torque
    if reported is None or not len(reported):
        return np.zeros((len(t), 3))
    return integral_at(t, reported.t, reported.values)
