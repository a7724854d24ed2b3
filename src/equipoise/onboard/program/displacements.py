"""Shifts of the centre of mass and displacements of masses, each from the other.

    s = sum m_i d_i u_i / m,        d = M^+ s

M^+ is the pseudo-inverse of M = [m_i u_i / m]: of masses on parallel rails the heavier goes further
(the least sum of squares). The library's allocation is a search, which chooses among coarse and
fine masses; it takes more memory than a small board has. Displacements end at the travel, and are
whole motor steps.
"""

import math
from typing import NamedTuple

import numpy as np

from equipoise.actuators.sliding_masses import shift_by_travel
from equipoise.model.arrays import Floats, Triple
from equipoise.model.errors import InputError
from equipoise.model.testbed import Testbed

DEPENDENT = 1e-3  # chosen: a third direction that masses reach a thousand times less is none


class Rails(NamedTuple):
    """The masses, one row each."""

    per_travel: Floats  # (k, 3) -, shift by displacement
    per_shift: Floats  # (k, 3) -, displacement by shift
    low: Floats  # (k,) m
    high: Floats
    step: Floats  # (k,) m, of a motor; 0: any displacement


def shift_of(rails: Rails, d: Floats) -> Triple:
    """Return the shift by masses at d m, m."""
    x, y, z = 0.0, 0.0, 0.0
    for k in range(d.shape[0]):
        x += d[k] * rails.per_travel[k, 0]
        y += d[k] * rails.per_travel[k, 1]
        z += d[k] * rails.per_travel[k, 2]
    return (x, y, z)


def put_displacements(rails: Rails, shift: Floats, out: Floats) -> None:
    """Write the displacements (m) that shift the centre of mass so (m)."""
    for k in range(out.shape[0]):
        wanted = 0.0
        for j in range(3):
            wanted += rails.per_shift[k, j] * shift[j]
        if rails.step[k] > 0.0:
            wanted = math.floor(wanted / rails.step[k] + 0.5) * rails.step[k]
        out[k] = min(max(wanted, rails.low[k]), rails.high[k])


def rails_on(testbed: Testbed) -> Rails:
    """Return the rails; InputError for masses that do not reach every direction."""
    per_travel = shift_by_travel(testbed)
    sizes = np.linalg.svd(per_travel, compute_uv=False) if len(per_travel) else np.zeros(0)
    if len(sizes) < 3 or sizes[2] < DEPENDENT * sizes[0]:
        raise InputError("generate", "masses that shift the centre of mass in a plane at most",
                         "rails in three directions")  # fmt: skip
    low, high = np.array([mass.travel for mass in testbed.masses]).T
    per_shift = np.linalg.pinv(per_travel).T.astype(np.float64, copy=False)
    return Rails(
        per_travel, np.ascontiguousarray(per_shift), np.ascontiguousarray(low),
        np.ascontiguousarray(high), np.array([mass.resolution for mass in testbed.masses]),
    )  # fmt: skip
