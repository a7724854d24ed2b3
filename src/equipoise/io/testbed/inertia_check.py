"""Whether some body can have a given inertia, and if not, which law it breaks.

A body's inertia is symmetric, its principal moments are positive, and about the centre of mass
each is less than the sum of the other two (equal for a flat plate without thickness).

Measured moments of a flat body break the last law by chance. With a relative sd s of each,

    J_k - J_i - J_j  has the sd  s sqrt(J_i^2 + J_j^2 + J_k^2),

and up to ``SURE`` of it the nearest moments that a body can have are taken, in units of their sd.
"""

import numpy as np

from equipoise.model.arrays import Matrix3
from equipoise.model.errors import InputError
from equipoise.model.mass_properties import smallest_second_moment
from equipoise.model.reasons.finding_reasons import FindingReason as Why
from equipoise.model.reasons.reason import Reason

SURE = 3.0  # sd, chosen: chance is beyond in one of 700 measurements of a flat plate
INSIDE = 0.1  # sd from the edge of the possible, chosen: where a fit can begin
SYMMETRY = 1e-9  # relative; chosen: far above rounding, far below any digit a person writes


def check_inertia(inertia: Matrix3, where: str) -> None:
    """Raise InputError naming the broken law with its numbers (kg m^2)."""
    _check_symmetry(inertia, where)
    low, middle, high = np.linalg.eigvalsh(inertia)
    if low <= 0:
        found = f"a physically inconsistent inertia with the principal moment {low:.4g} kg m2"
        raise InputError(where, found, "positive principal moments")
    if smallest_second_moment(inertia) <= 0:
        found = (
            f"a physically inconsistent inertia: its principal moments break {high:.4g} < "
            f"{low:.4g} + {middle:.4g} = {low + middle:.4g} kg m2"
        )
        wanted = (
            "each principal moment below the sum of the other two; a measured "
            f"inertia, with its inertia_sd_percent, may exceed it by {SURE:g} sd at "
            "most"
        )
        raise InputError(where, found, wanted)


def measured(
    inertia: Matrix3, share: float | None, where: str
) -> tuple[Matrix3, tuple[Reason, ...]]:
    """Return an inertia about C (kg m^2) that a body can have, and what was changed.

    ``share`` is its relative sd, None if none is stated. Raises InputError for one that no body can
    have, nor by chance.
    """
    moments, axes = np.linalg.eigh(inertia)
    beyond = float(moments[2] - moments[0] - moments[1])
    sd = (share or 0.0) * float(np.linalg.norm(moments))
    by_chance = moments[0] > 0 and sd > 0 and beyond <= SURE * sd
    if smallest_second_moment(inertia) > 0 or not by_chance:
        check_inertia(inertia, where)
        return inertia, ()
    _check_symmetry(inertia, where)
    way = moments**2 / float(moments @ moments) * (beyond + INSIDE * sd)
    found = axes @ np.diag(moments + way * [1.0, 1.0, -1.0]) @ axes.T
    numbers = {
        "greatest": float(moments[2]),
        "others": float(moments[0] + moments[1]),
        "sds": max(beyond / sd, 0.0),
    }
    return 0.5 * (found + found.T), (Reason(Why.INERTIA_PROJECTED, (), numbers),)


def _check_symmetry(inertia: Matrix3, where: str) -> None:
    gap = np.abs(inertia - inertia.T)
    if gap.max() > SYMMETRY * np.abs(inertia).max():
        i, j = np.unravel_index(int(gap.argmax()), gap.shape)
        found = (
            f"row {i + 1}, column {j + 1} = {inertia[i, j]:g} but "
            f"row {j + 1}, column {i + 1} = {inertia[j, i]:g}"
        )
        raise InputError(where, found, "a symmetric matrix")
