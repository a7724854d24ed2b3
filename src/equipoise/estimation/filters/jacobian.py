"""What small errors do to the motion: the matrix F of every filter, from the one regressor.

    dth' = dw - w x dth
    dw'  = J^-1 ( [H x] - [w x] J - J' ) dw + J^-1 [mu x][g_B x] dth + J^-1 m (axes x g_B) dc
           - J^-1 Y_J(w, w') dp,      Y_J(w, w') = W(w') + [w x] W(w)
    w'   = J^-1 ( H' - h' - J' w ),   H = J w + h

e x g_B = -[g_B x] e and W are columns of ``dynamics.regressor``. J' and h' are those of masses
under way and of wheels. (Review Eqs. 34 and 36 with R14 and R17; Ivanov Eq. 5.1 with I7 to I9: the
whole rotation vector, so no block carries a factor.)

The simplified model has neither [H x] - [w x] J nor products of inertia. What it leaves out is no
noise: it is known, but for J. So it is considered as an error s = 0 +- 1, the share by which it
acts, and an error of J acts as on the whole equation, with w' and J of that:

    dw' / ds = J_full^-1 ( H' - h' - J' w - w x (J_full w + h) ) - w'

The covariance of r then holds what the leaving out does to it: of size |w|^2 dJ / (m g), more along
gravity.
"""

from typing import NamedTuple

from equipoise.dynamics.regressor import cross_columns, momentum_columns
from equipoise.dynamics.rigid_body import Now, cross, invert, times
from equipoise.dynamics.sensitivities import cross_twice, dot
from equipoise.estimation.filters.model import Model
from equipoise.maths.kernels.compiled import part
from equipoise.model.arrays import Floats, Six, Triple


class Change(NamedTuple):
    """How fast known things change over a step."""

    inertia: Six  # J', kg m^2/s
    momentum: Triple  # h', N m


@part
def change_of(here: Now, end: Now, dt: float) -> Change:
    """Return J' and h' over a step of dt seconds."""
    a, b, k = here.inertia, end.inertia, 1.0 / dt
    bend = (k * (b[0] - a[0]), k * (b[1] - a[1]), k * (b[2] - a[2]),
            k * (b[3] - a[3]), k * (b[4] - a[4]), k * (b[5] - a[5]))  # fmt: skip
    p, r = here.momentum, end.momentum
    return Change(bend, (k * (r[0] - p[0]), k * (r[1] - p[1]), k * (r[2] - p[2])))


@part
def less(a: Triple, b: Triple) -> Triple:
    """Return a - b."""
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


@part
def whole(model: Model, now: Now) -> Now:
    """Return the platform with all that the model does without."""
    if model.gyroscopic:
        return now
    a, b = now.inertia, model.left_out
    full = (a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3], a[4] + b[4], a[5] + b[5])
    return Now(now.t, now.warmth, full, invert(full), now.moment, now.momentum, now.torque)


@part
def accelerated(now: Now, w: Triple, push: Triple, swirl: bool) -> Triple:
    """Return J^-1 (push - w x H), of the simplified model J^-1 push."""
    v, h = times(now.inertia, w), now.momentum
    if swirl:
        push = less(push, cross(w, (v[0] + h[0], v[1] + h[1], v[2] + h[2])))
    return times(now.inverse, push)


@part
def write_inertia(
    now: Now, w: Triple, a: Triple, row: int, Y: Floats, Z: Floats, F: Floats
) -> None:
    """Write -J^-1 Y_J(w, w') of as many elements as there are columns."""
    momentum_columns(a, Y)
    momentum_columns(w, Z)
    for k in range(6):
        v = cross(w, (Z[0, k], Z[1, k], Z[2, k]))
        u = times(now.inverse, (Y[0, k] + v[0], Y[1, k] + v[1], Y[2, k] + v[2]))
        for j in range(3):
            F[row + j, row + 6 + k] = -u[j]


@part
def write_rate(
    model: Model, now: Now, change: Change, w: Triple, row: int, F: Floats
) -> None:  # fmt: skip
    """Write J^-1 ([H x] - [w x] J - J')."""
    v, h = times(now.inertia, w), now.momentum
    H = (v[0] + h[0], v[1] + h[1], v[2] + h[2])
    for k in range(3):
        e = (1.0 * (k == 0), 1.0 * (k == 1), 1.0 * (k == 2))
        u = times(change.inertia, e)
        u = (-u[0], -u[1], -u[2])
        if model.gyroscopic:
            p, s = cross(H, e), cross(w, times(now.inertia, e))
            u = (u[0] + p[0] - s[0], u[1] + p[1] - s[1], u[2] + p[2] - s[2])
        u = times(now.inverse, u)
        for j in range(3):
            F[row + j, row + k] = u[j]


@part
def write_com(model: Model, now: Now, g: Triple, row: int, Y: Floats, F: Floats) -> None:
    """Write J^-1 m (axes x g_B) of as many axes as there are columns."""
    B = model.axes
    cross_columns(g, model.body.mass, 0, Y)
    turned = (Y[0, 0], Y[0, 1], Y[0, 2], Y[1, 0], Y[1, 1], Y[1, 2], Y[2, 0], Y[2, 1], Y[2, 2])
    for k in range(min(3, F.shape[1] - row - 3)):
        v = times(now.inverse, dot(turned, (B[0, k], B[1, k], B[2, k])))
        for j in range(3):
            F[row + j, row + 3 + k] = v[j]


@part
def write_attitude(now: Now, w: Triple, g: Triple, F: Floats) -> None:
    """Write the rows of dth, and what dth does to the rate: dg_B = g_B x dth."""
    bend = cross_twice(now.moment, g)
    for k in range(3):
        e = (1.0 * (k == 0), 1.0 * (k == 1), 1.0 * (k == 2))
        u, v = cross(w, e), times(now.inverse, dot(bend, e))
        for j in range(3):
            F[j, k], F[j, 3 + k], F[3 + j, k] = -u[j], e[j], v[j]


@part
def write_jacobian(
    model: Model,
    now: Now,
    change: Change,
    w: Triple,
    push: Triple,
    g: Triple,
    Y: Floats,
    Z: Floats,
    F: Floats,
) -> None:
    """Write F at one moment, (3 or 6, n); ``push`` is H' as the model has it.

    Entries that stay nought are not set.
    """
    row, n = 3 if model.attitude else 0, F.shape[1]
    u, h = times(change.inertia, w), change.momentum
    write_rate(model, now, change, w, row, F)
    write_com(model, now, g, row, Y, F)
    if n >= row + 12:
        push = less(push, (h[0] + u[0], h[1] + u[1], h[2] + u[2]))
        full = whole(model, now)
        a = accelerated(full, w, push, not model.gyroscopic)
        write_inertia(full, w, a, row, Y, Z, F)
        if n > row + 12:
            estimated = accelerated(now, w, push, False)
            for j in range(3):
                F[row + j, row + 12] = a[j] - estimated[j]
    if model.attitude:
        write_attitude(now, w, g, F)
