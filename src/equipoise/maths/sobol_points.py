"""Points that fill a unit cube more evenly than chance: the sequence of Sobol.

    x(n) = XOR over the bits k of gray(n) of v(k),        gray(n) = n XOR (n >> 1)

    v(k) = m(k) 2^-k;   m(k) = 2 a(1) m(k-1) XOR 4 a(2) m(k-2) XOR ... XOR 2^s m(k-s) XOR m(k-s)

with a(1) ... a(s-1) the inner coefficients of a primitive polynomial of degree s over GF(2), another
for each dimension (Bratley and Fox, ACM TOMS 14, 1988, eq. 2). Polynomials and first m are those of
Joe and Kuo (SIAM J. Sci. Comput. 30, 2008), of the file ``new-joe-kuo-6``. Point 0 is the origin.
The first 2^p points have one in each of 2^p equal slices of every axis. A shift of all bits by the
same random ones keeps that, and moves no point to the edge but by chance.

SciPy has the same sequence, in a package that takes most of a second to import (decision 0093).
"""

import numpy as np

from equipoise.model.arrays import Floats, Ints

BITS = 30
# Of each dimension after the first: polynomial, as the bits of its coefficients, and first m.
DIRECTIONS = (
    (3, 1), (7, 1, 3), (11, 1, 3, 1), (13, 1, 1, 1), (19, 1, 1, 3, 3), (25, 1, 3, 5, 13), (37,
    1, 1, 5, 5, 17), (41, 1, 1, 5, 5, 5), (47, 1, 1, 7, 11, 19), (55, 1, 1, 5, 1, 1), (59, 1, 1,
    1, 3, 11), (61, 1, 3, 5, 5, 31), (67, 1, 3, 3, 9, 7, 49), (91, 1, 1, 1, 15, 21, 21), (97, 1,
    3, 1, 13, 27, 49), (103, 1, 1, 1, 15, 7, 5), (109, 1, 3, 1, 15, 13, 25), (115, 1, 1, 5, 5,
    19, 61), (131, 1, 3, 7, 11, 23, 15, 103), (137, 1, 3, 7, 13, 13, 15, 69), (143, 1, 1, 3, 13,
    7, 35, 63), (145, 1, 3, 5, 9, 1, 25, 53), (157, 1, 3, 1, 13, 9, 35, 107), (167, 1, 3, 1, 5,
    27, 61, 31), (171, 1, 1, 5, 11, 19, 41, 61), (185, 1, 3, 5, 3, 3, 13, 69), (191, 1, 1, 7,
    13, 1, 19, 1), (193, 1, 3, 7, 5, 13, 19, 59), (203, 1, 1, 3, 9, 25, 29, 41), (211, 1, 3, 5,
    13, 23, 1, 55), (213, 1, 3, 7, 3, 13, 59, 17), (229, 1, 3, 1, 3, 5, 53, 69), (239, 1, 1, 5,
    5, 23, 33, 13), (241, 1, 1, 7, 7, 1, 61, 123), (247, 1, 1, 7, 9, 13, 61, 49), (253, 1, 3, 3,
    5, 3, 55, 33), (285, 1, 3, 1, 15, 31, 13, 49, 245), (299, 1, 3, 5, 15, 31, 59, 63, 97),
    (301, 1, 3, 1, 11, 11, 11, 77, 249), (333, 1, 3, 1, 11, 27, 43, 71, 9), (351, 1, 1, 7, 15,
    21, 11, 81, 45), (355, 1, 3, 7, 3, 25, 31, 65, 79), (357, 1, 3, 1, 1, 19, 11, 3, 205), (361,
    1, 1, 5, 9, 19, 21, 29, 157), (369, 1, 3, 7, 11, 1, 33, 89, 185), (391, 1, 3, 3, 3, 15, 9,
    79, 71), (397, 1, 3, 7, 11, 15, 39, 119, 27)
)  # fmt: skip
MOST = 1 + len(DIRECTIONS)  # dimensions


def sobol_points(first: int, count: int, dimensions: int, shift_seed: int | None = None) -> Floats:
    """Return points (count, dimensions) of the sequence from number ``first`` on, in [0, 1).

    ``shift_seed``: shifted by random bits of it; None: not shifted.
    """
    number = np.arange(first, first + count, dtype=np.int64)
    gray = number ^ (number >> 1)
    found = np.zeros((count, dimensions), dtype=np.int64)
    directions = np.stack([_directions(d) for d in range(dimensions)], axis=1)
    for k in range(int(first + count).bit_length()):
        found ^= np.where((gray[:, None] >> k) & 1, directions[k], 0)
    if shift_seed is not None:
        found ^= np.random.default_rng(shift_seed).integers(0, 1 << BITS, dimensions)
    return found * 2.0**-BITS


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
