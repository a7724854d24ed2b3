"""Whether a testbed can be a platform: its inertia against its mass, its centre of mass.

    k = sqrt(tr J / 2 m)          root mean square distance of the mass from the pivot

A platform of a bearing is some centimetres to metres large, and as dense as machines are: m / k^3
is between that of a wide frame and that of lead. Inertias in kg cm^2 or g m^2, or a mass in g, put
it off by many powers of ten.
"""

import numpy as np

from equipoise.model.finding import Finding
from equipoise.model.reasons.finding_reasons import FindingReason as Why
from equipoise.model.reasons.reason import one_reason
from equipoise.model.testbed import Testbed

SMALLEST, LARGEST = 0.005, 10.0  # m (chosen)
LIGHT, DENSE = 1.0, 1e6  # kg/m^3, of m / k^3 (chosen)
SURE = 2.0  # sd, by which a centre of mass must be above to be called so (chosen)


def body_findings(testbed: Testbed | None) -> list[Finding]:
    """Return an inertia that does not fit the mass, and a stated centre of mass above the pivot."""
    if testbed is None:
        return []
    return [*_gyration(testbed), *_above(testbed)]


def _gyration(testbed: Testbed) -> list[Finding]:
    inertia, mass = testbed.body.inertia_P, testbed.body.mass
    radius = float(np.sqrt(np.trace(inertia) / (2 * mass)))
    if SMALLEST <= radius <= LARGEST and LIGHT <= mass / radius**3 <= DENSE:
        return []
    return [Finding("wrong", one_reason(Why.NO_BODY, mass=mass, radius=radius))]


def _above(testbed: Testbed) -> list[Finding]:
    """Return a note on a platform that would fall over rather than swing."""
    height = float(testbed.body.com @ testbed.up)
    sd = float(np.linalg.norm(testbed.com_sd * testbed.up))
    if height <= max(SURE * sd, 0.0):
        return []
    return [Finding("content", one_reason(Why.COM_ABOVE, height=height))]
