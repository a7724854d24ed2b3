"""The angular acceleration and its sensitivities, compiled.

From w = J^-1 (H - h) and dw = J^-1 (dH - f), with f = dh/dp + (dJ/dp) w (``sensitivities``):

    J w'  = H' - h' - J' w
    J dw' = dH' - J' dw - f',           f' = df/dt

Within a step displacements d and shares r of errors are straight lines, and

    h' = that of the stored momentum,        J' = sum d' (A + 2 d B)
    f' = E_k w'                              of element k of J
    f' = r (A + 2 d B) w' + ( r' (A + 2 d B) + 2 r d' B ) w        of an error of a mass

and zero of every other unknown. Where a mass starts or stops the rate jumps; that is not in w'.
"""

from equipoise.dynamics.rigid_body import KNOWN_D, A, B, Now, between, times
from equipoise.dynamics.sensitivities import ERROR, INERTIA, Inputs
from equipoise.maths.kernels.compiled import part
from equipoise.model.arrays import Floats, Six, Triple


@part
def bend_of(m: Floats, d: float, by_rate: float, by_place: float) -> Six:
    """Return by_rate (A + 2 d B) + 2 by_place B of a mass's map."""
    k = 2.0 * (by_rate * d + by_place)
    return (by_rate * m[A] + k * m[B], by_rate * m[A + 1] + k * m[B + 1],
            by_rate * m[A + 2] + k * m[B + 2], by_rate * m[A + 3] + k * m[B + 3],
            by_rate * m[A + 4] + k * m[B + 4], by_rate * m[A + 5] + k * m[B + 5])  # fmt: skip


@part
def inertia_change(inputs: Inputs, i: int, share: float) -> Six:
    """Return J' within step i, kg m^2/s."""
    a, b, step = inputs.known[i], inputs.known[i + 1], inputs.t[i + 1] - inputs.t[i]
    xx, yy, zz, xy, xz, yz = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for k in range(inputs.maps.shape[0]):
        first, last = a[KNOWN_D + k], b[KNOWN_D + k]
        if first != last:
            d, rate = between(first, last, share), (last - first) / step
            s = bend_of(inputs.maps[k], d, rate, 0.0)
            xx, yy, zz, xy, xz, yz = (
                xx + s[0], yy + s[1], zz + s[2], xy + s[3], xz + s[4], yz + s[5],
            )  # fmt: skip
    return (xx, yy, zz, xy, xz, yz)


@part
def angular_acceleration(
    now: Now, inputs: Inputs, i: int, bend: Six, torque: Triple, w: Triple
) -> Triple:
    """Return w' (rad/s^2) from H' (``torque``), J' (``bend``) and w."""
    a, b, step = inputs.known[i], inputs.known[i + 1], inputs.t[i + 1] - inputs.t[i]
    x = times(bend, w)
    return times(now.inverse, (torque[0] - (b[0] - a[0]) / step - x[0],
                               torque[1] - (b[1] - a[1]) / step - x[1],
                               torque[2] - (b[2] - a[2]) / step - x[2]))  # fmt: skip


@part
def forcing_change(
    inputs: Inputs, i: int, share: float, column: int, w: Triple, turning: Triple
) -> Triple:
    """Return f' of a column, ``turning`` being w'."""
    kind, k = inputs.columns.kinds[column], inputs.columns.indices[column]
    if kind == INERTIA:
        return element_times(k, turning)
    if kind == ERROR:
        return error_change(inputs, i, share, k, w, turning)
    return (0.0, 0.0, 0.0)


@part
def element_times(k: int, x: Triple) -> Triple:
    """Return E_k x, E_k being dJ by its element k: xx yy zz xy xz yz."""
    return times((1.0 * (k == 0), 1.0 * (k == 1), 1.0 * (k == 2), 1.0 * (k == 3), 1.0 * (k == 4),
                  1.0 * (k == 5)), x)  # fmt: skip


@part
def error_change(
    inputs: Inputs, i: int, share: float, error: int, w: Triple, turning: Triple
) -> Triple:
    """Return f' of an error, summed over the masses that have it."""
    a, b, step = inputs.known[i], inputs.known[i + 1], inputs.t[i + 1] - inputs.t[i]
    x, y, z = 0.0, 0.0, 0.0
    for c in range(inputs.owners.shape[0]):
        if inputs.owners[c, 1] == error:
            owner, column = inputs.owners[c, 0], KNOWN_D + inputs.maps.shape[0] + c
            first, last, m = a[KNOWN_D + owner], b[KNOWN_D + owner], inputs.maps[owner]
            d, travel = between(first, last, share), (last - first) / step
            r, growth = between(a[column], b[column], share), (b[column] - a[column]) / step
            u = times(bend_of(m, d, r, 0.0), turning)
            v = times(bend_of(m, d, growth, r * travel), w)
            x, y, z = x + u[0] + v[0], y + u[1] + v[1], z + u[2] + v[2]
    return (x, y, z)
