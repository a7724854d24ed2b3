"""The covariance of the error state as the kernels keep it, compiled.

Row by row in one array, each row filled up with zeros to two blocks of LANES numbers, so that the
compiler knows where everything is and works on whole machine vectors. What is known of bias, drift
and warmth alone lies in the second block, which is passed over where no gyro has sent a row, the
centre of mass is not taken to drift and nothing has become warmer.

Between steps only what is on and above the diagonal counts; ``fill`` writes the rest, which only
the prediction reads.
"""

from equipoise.dynamics.sensitivities import LANES
from equipoise.maths.kernels.compiled import part
from equipoise.model.arrays import Floats, Square

SIZE, N = 24, 15  # dth, dw, dr, dJ, db, dv, dk; the propagator moves the first 15, in one block
COM_ROW, DRIFT, WARM_ROW = 6, 18, 21  # where r, its drift v, and k, what a kelvin does, begin
SAG_ROW, WITH_SAG = SIZE, SIZE + 5  # where the five of C begin, of a platform that sags, and end
ROW = 2 * LANES  # numbers from one row to the next


@part
def take(covariance: Square, P: Floats) -> None:
    """Write P from a matrix."""
    size = covariance.shape[0]
    for i in range(size):
        for j in range(size):
            P[i * ROW + j] = covariance[i, j]


@part
def give(P: Floats, covariance: Square) -> None:
    """Write the matrix, symmetric to the last digit."""
    size = covariance.shape[0]
    for i in range(size):
        for j in range(i, size):
            covariance[i, j] = covariance[j, i] = P[i * ROW + j]


@part
def coupled(covariance: Square) -> bool:
    """Say whether bias or warmth has to do with the rest, or there may be a drift or a sag."""
    if covariance.shape[0] > SIZE:
        return True
    for i in range(DRIFT, WARM_ROW):
        if covariance[i, i] != 0.0:
            return True
    for i in range(N):
        for j in range(N, SIZE):
            if covariance[i, j] != 0.0:
                return True
    return False


@part
def drifts(P: Floats) -> bool:
    """Say whether the centre of mass may drift."""
    return P[DRIFT * ROW + DRIFT] != 0.0


@part
def lanes_of(P: Floats) -> int:
    """Return LANES, unknown to the compiler: a short known loop it writes out, one by one."""
    return min(LANES, P.shape[0])


@part
def fill(P: Floats) -> None:
    """Write what is below the diagonal, and left of the columns of a sag."""
    for i in range(1, SIZE):
        for j in range(i):
            P[i * ROW + j] = P[j * ROW + i]


@part
def copy_row(P: Floats, row: int, out: Floats, at: int) -> None:
    """Write a row of P, of which only the part above the diagonal need be there."""
    for j in range(ROW):
        out[at + j] = P[row * ROW + j]
    for j in range(row):
        out[at + j] = P[j * ROW + row]


@part
def add_row(P: Floats, row: int, out: Floats, at: int) -> None:
    """Add a row of P, of which only the part above the diagonal need be there."""
    for j in range(row):
        out[at + j] += P[j * ROW + row]
    for j in range(row, ROW):
        out[at + j] += P[row * ROW + j]


@part
def add_block(P: Floats, A: Floats, B: Floats, sign: float, rows: int, first: int) -> None:
    """Add sign A^T B to a block of columns, in its rows on and above the diagonal."""
    lanes = lanes_of(P)
    for i in range(rows):
        a, b, c = sign * A[i], sign * A[ROW + i], sign * A[2 * ROW + i]
        for j in range(first, first + lanes):
            P[i * ROW + j] += a * B[j] + b * B[ROW + j] + c * B[2 * ROW + j]


@part
def add_product(P: Floats, A: Floats, B: Floats, sign: float, size: int) -> None:
    """Add sign A^T B, which is symmetric; A and B are (3, 24), in rows as those of P.

    To so many rows of the second block of columns; to none of it where ``size`` is 0.
    """
    add_block(P, A, B, sign, LANES, 0)
    if size == SIZE:  # as a number that the compiler knows
        add_block(P, A, B, sign, SIZE, LANES)
    elif size > SIZE:
        add_block(P, A, B, sign, WITH_SAG, LANES)
