"""Whether a testbed can be a platform: its inertia against its mass, its centre of mass.

    k = sqrt(tr J / 2 m)          root mean square distance of the mass from the pivot

A platform of a bearing is some centimetres to metres large. Inertias in kg cm^2 or g m^2, or a mass
in g, put k off by powers of ten.
"""

import numpy as np

from equipoise.model.finding import Finding
from equipoise.model.reasons.finding_reasons import FindingReason as Why
from equipoise.model.reasons.reason import one_reason
from equipoise.model.testbed import Testbed

SMALLEST, LARGEST = 0.01, 3.0  # m (chosen)
SURE = 2.0  # sd, by which a centre of mass must be above to be called so (chosen)


def body_findings(testbed: Testbed | None) -> list[Finding]:
    """Return an inertia that does not fit the mass, and a stated centre of mass above the pivot."""
    if testbed is None:
        return []
    return [*_gyration(testbed), *_above(testbed)]


def _gyration(testbed: Testbed) -> list[Finding]:
    inertia, mass = testbed.body.inertia_P, testbed.body.mass
    radius = float(np.sqrt(np.trace(inertia) / (2 * mass)))
    if SMALLEST <= radius <= LARGEST:
        return []
    return [Finding("wrong", one_reason(Why.NO_BODY, mass=mass, radius=radius))]


def _above(testbed: Testbed) -> list[Finding]:
    """Return a problem for a platform that would fall over rather than swing."""
    height = float(testbed.body.com @ testbed.up)
    sd = float(np.linalg.norm(testbed.com_sd * testbed.up))
    if height <= max(SURE * sd, 0.0):
        return []
    return [Finding("problem", one_reason(Why.COM_ABOVE, height=height))]
