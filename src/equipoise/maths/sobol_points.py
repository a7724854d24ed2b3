"""Points that fill a unit cube more evenly than chance: the sequence of Sobol.

    x(n) = XOR over the bits k of gray(n) of v(k),        gray(n) = n XOR (n >> 1)

    v(k) = m(k) 2^-k;   m(k) = 2 a(1) m(k-1) XOR 4 a(2) m(k-2) XOR ... XOR 2^s m(k-s) XOR m(k-s)

with a(1) ... a(s-1) the inner coefficients of a primitive polynomial of degree s over GF(2),
another for each dimension (Bratley and Fox, ACM TOMS 14, 1988, eq. 2). Polynomials and first m are
those of Joe and Kuo (SIAM J. Sci. Comput. 30, 2008), of the file ``new-joe-kuo-6``. Point 0 is the
origin. The first 2^p points have one in each of 2^p equal slices of every axis.

SciPy has the same sequence, in a package that takes half a second to import (decision 0030).
"""

import numpy as np

from equipoise.model.arrays import Floats, Ints

BITS = 30
# Of each dimension after the first: polynomial, as the bits of its coefficients, and first m.
DIRECTIONS = (
    (3, 1), (7, 1, 3), (11, 1, 3, 1), (13, 1, 1, 1), (19, 1, 1, 3, 3), (25, 1, 3, 5, 13),
    (37, 1, 1, 5, 5, 17),
)  # fmt: skip
MOST = 1 + len(DIRECTIONS)  # dimensions


def sobol_points(first: int, count: int, dimensions: int) -> Floats:
    """Return points (count, dimensions) of the sequence from number ``first`` on, in [0, 1)."""
    number = np.arange(first, first + count, dtype=np.int64)
    gray = number ^ (number >> 1)
    found = np.zeros((count, dimensions), dtype=np.int64)
    directions = np.stack([_directions(d) for d in range(dimensions)], axis=1)
    for k in range(int(first + count).bit_length()):
        found ^= np.where((gray[:, None] >> k) & 1, directions[k], 0)
    return np.ldexp(found.astype(np.float64), -BITS)


def _directions(dimension: int) -> Ints:
    """Return 2^BITS v(k) of one dimension, k from 1 on."""
    if dimension == 0:
        return 1 << np.arange(BITS - 1, -1, -1)
    polynomial, *m = DIRECTIONS[dimension - 1]
    degree = polynomial.bit_length() - 1
    for k in range(degree, BITS):
        new = m[k - degree] ^ (m[k - degree] << degree)
        for i in range(1, degree):
            new ^= (polynomial >> (degree - i) & 1) * (m[k - i] << i)
        m.append(new)
    return np.array([each << (BITS - 1 - k) for k, each in enumerate(m)])
