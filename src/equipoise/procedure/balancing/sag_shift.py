"""Where the centre of mass of a sagging platform must be for it to act as a stiff one.

A platform that sags has the lever r + C n, n = g_B / g. It acts as a stiff one with the centre of
mass r_t, (r + C n - r_t) x n = 0, at every attitude to which masses follow with

    r(n) = r_t + C u - (E - n n^T)(C u + C n)  =  r_t + allowance(n)

where u points up; level, n = -u, the second part is zero. Masses that stand do so at small tilts
alone (``dynamics.sag_trim.acting_com``).

C is taken as known: its error stays.
"""

from equipoise.dynamics.sag_trim import acting_com, trimming_shift
from equipoise.maths.attitude import to_matrix
from equipoise.model.arrays import Matrix3, Quaternion, Vector3
from equipoise.model.testbed import Testbed


def allowance(sag: Matrix3, q: Quaternion, testbed: Testbed) -> Vector3:
    """Return r(n) - r_t (m) at an attitude."""
    level: Vector3 = sag @ testbed.up
    down: Vector3 = -to_matrix(q)[2]
    return level + trimming_shift(sag, level, down)


def lever(com: Vector3, sag: Matrix3, testbed: Testbed) -> Vector3:
    """Return r (m) of a platform that acts, at small tilts, as a stiff one with ``com`` (m)."""
    return com - (acting_com(com, sag, testbed.up) - com)
