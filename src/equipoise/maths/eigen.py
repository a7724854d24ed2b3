"""Eigenvalues and vectors of a symmetric 3 x 3 matrix, compiled: Jacobi's rotations.

    theta = (S_qq - S_pp) / 2 S_pq,    t = sgn(theta) / (|theta| + sqrt(theta^2 + 1)),
    c = 1 / sqrt(1 + t^2),    s = t c

(Golub and Van Loan 2013, section 8.5.) Each rotation clears one of the three pairs; what is left
falls with the square of itself in each sweep.
"""

from equipoise.maths.kernels.compiled import part
from equipoise.model.arrays import Six, Triple

SWEEPS = 8  # chosen: six bring any matrix to rounding


@part
def rotation(p: float, q: float, pq: float) -> tuple[float, float, float]:
    """Return t, c and s that clear the entry ``pq`` between the diagonal entries p and q."""
    if pq == 0.0:
        return 0.0, 1.0, 0.0
    theta = (q - p) / (2.0 * pq)
    t = 1.0 / (abs(theta) + (theta * theta + 1.0) ** 0.5)
    t = -t if theta < 0.0 else t
    c = (1.0 + t * t) ** -0.5
    return t, c, t * c


@part
def mixed(u: Triple, v: Triple, c: float, s: float) -> tuple[Triple, Triple]:
    """Return c u - s v and s u + c v."""
    return (
        (c * u[0] - s * v[0], c * u[1] - s * v[1], c * u[2] - s * v[2]),
        (s * u[0] + c * v[0], s * u[1] + c * v[1], s * u[2] + c * v[2]),
    )


@part
def eigen(matrix: Six) -> tuple[Triple, tuple[Triple, Triple, Triple]]:
    """Return the eigenvalues of xx yy zz xy xz yz, in no order, and their unit vectors."""
    xx, yy, zz, xy, xz, yz = matrix
    u, v, w = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
    for _ in range(SWEEPS):
        t, c, s = rotation(xx, yy, xy)
        xx, yy, xy, xz, yz = xx - t * xy, yy + t * xy, 0.0, c * xz - s * yz, s * xz + c * yz
        u, v = mixed(u, v, c, s)
        t, c, s = rotation(xx, zz, xz)
        xx, zz, xz, xy, yz = xx - t * xz, zz + t * xz, 0.0, c * xy - s * yz, s * xy + c * yz
        u, w = mixed(u, w, c, s)
        t, c, s = rotation(yy, zz, yz)
        yy, zz, yz, xy, xz = yy - t * yz, zz + t * yz, 0.0, c * xy - s * xz, s * xy + c * xz
        v, w = mixed(v, w, c, s)
    return (xx, yy, zz), (u, v, w)
