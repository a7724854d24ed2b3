"""Whether the best body is flat: its inertia at the edge of what a body can have.

    Sigma = 1/2 tr(J_C) E - J_C,    flat: the least eigenvalue of Sigma < FLAT tr(Sigma)

Then the greatest principal moment is the sum of the other two, but for 2 FLAT of it. A fit by
numbers that always give a body (``maths.pseudo_inertia``) ends there when the rows alone would lead
beyond, and the sd that it states knows of no edge. A thin plate does lie there.
"""

import numpy as np

from equipoise.model.mass_properties import MassProperties, second_moments
from equipoise.model.reasons.estimate_reasons import EstimateReason as Why
from equipoise.model.reasons.reason import Reason

FLAT = 1e-4  # chosen: a square plate whose thickness is 1.4 % of its width


def flat_reasons(body: MassProperties) -> tuple[Reason, ...]:
    """Return that a body is flat, if it is; one that cannot exist is not judged."""
    least, middle, greatest = np.linalg.eigvalsh(second_moments(body.inertia_C))
    if not 0 < least < FLAT * (least + middle + greatest):
        return ()
    gap = float(2 * least / (middle + greatest))
    return (Reason(Why.FLAT_BODY, (), {"gap": gap}),)
