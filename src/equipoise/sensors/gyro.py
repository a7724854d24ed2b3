"""What a gyro triad says of a rate, compiled.

w_said = (E + M) w( t - c (t - t0) ) + b    M: scale errors on the diagonal, misalignment beside it

A row is stamped t by a clock that is fast by c beside the camera's.
"""

from equipoise.maths.kernels.compiled import part
from equipoise.model.arrays import Floats, Nine
from equipoise.sensors.camera import CLOCK, GYRO


@part
def gyro_matrix(sensor: Floats) -> Nine:
    """Return E + M by rows, from coefficients xx yy zz xy xz yx yz zx zy."""
    k = GYRO
    return (1.0 + sensor[k], sensor[k + 3], sensor[k + 4],
            sensor[k + 5], 1.0 + sensor[k + 1], sensor[k + 6],
            sensor[k + 7], sensor[k + 8], 1.0 + sensor[k + 2])  # fmt: skip


@part
def entry(term: int) -> tuple[int, int]:
    """Return row and column in M of a coefficient; row -1 where it is none of M."""
    k = term - GYRO
    if k < 0 or term >= CLOCK:
        return -1, 0
    if k < 3:
        return k, k
    row = (k - 3) // 2
    other = (k - 3) % 2
    return row, other if other < row else other + 1
