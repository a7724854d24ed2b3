"""What forces the sensitivities, compiled: f_p = dh/dp + (dJ/dp) w and b_p = d(torque)/dp.

They are columns of the regressor. Those of J and mu stand together in nearly every set of columns:
they are then written at once, fifteen numbers, and the rest stays zero. One by one, with a kind to
be asked for each, they took a third of a step's time.
"""

from equipoise.dynamics.regressor import INERTIA as INERTIA_COLUMN
from equipoise.dynamics.regressor import MOMENT as MOMENT_COLUMN
from equipoise.dynamics.regressor import TORQUE as TORQUE_COLUMN
from equipoise.dynamics.regressor import regressor
from equipoise.dynamics.rigid_body import HM, KNOWN_D, A, B, Body, Now, between, cross, times
from equipoise.dynamics.sensitivities import (
    ERROR,
    INERTIA,
    LANES,
    MOMENT,
    TORQUE,
    Columns,
    Groups,
    Inputs,
    Work,
    place,
)
from equipoise.maths.kernels.compiled import part
from equipoise.model.arrays import Floats, Triple


@part
def error_column(
    inputs: Inputs, i: int, share: float, owner: int, column: int, w: Triple, g: Triple
) -> tuple[Triple, Triple]:
    """Return f and b of an error of one mass, whose share of it is the known input ``column``."""
    t, a, b, k = inputs.t, inputs.known[i], inputs.known[i + 1], KNOWN_D + owner
    response, rate = (
        between(a[column], b[column], share),
        (b[column] - a[column]) / (t[i + 1] - t[i]),
    )
    d, m = between(a[k], b[k], share), inputs.maps[owner]
    bend = (m[A] + 2 * d * m[B], m[A + 1] + 2 * d * m[B + 1], m[A + 2] + 2 * d * m[B + 2],
            m[A + 3] + 2 * d * m[B + 3], m[A + 4] + 2 * d * m[B + 4],
            m[A + 5] + 2 * d * m[B + 5])  # fmt: skip
    v, u = times(bend, w), cross((m[0], m[1], m[2]), g)
    f = (
        response * v[0] + rate * m[HM],
        response * v[1] + rate * m[HM + 1],
        response * v[2] + rate * m[HM + 2],
    )
    return f, (response * u[0], response * u[1], response * u[2])


@part
def write_error(
    inputs: Inputs, i: int, share: float, error: int, w: Triple, g: Triple, fb: Floats
) -> None:
    """Write f and b of an error, summed over the masses that have it, from row 0 of ``fb`` on."""
    for j in range(6):
        fb[j * LANES] = 0.0
    owners = inputs.owners
    for c in range(owners.shape[0]):
        if owners[c, 1] == error:
            response = KNOWN_D + inputs.maps.shape[0] + c
            f, b = error_column(inputs, i, share, int(owners[c, 0]), response, w, g)
            for j in range(3):
                fb[j * LANES] += f[j]
                fb[(3 + j) * LANES] += b[j]


@part
def regressor_block(kind: int) -> int:
    """Return the first column of a kind in the regressor."""
    if kind == INERTIA:
        return INERTIA_COLUMN
    return MOMENT_COLUMN if kind == MOMENT else TORQUE_COLUMN


@part
def together(columns: Columns, kind: int, count: int) -> int:
    """Return where all columns of a kind stand in order and in one block; -1: nowhere."""
    kinds, indices = columns
    for c in range(kinds.shape[0] - count + 1):
        if kinds[c] == kind and c % LANES + count <= LANES:
            found = True
            for k in range(count):
                found &= kinds[c + k] == kind and indices[c + k] == k
            return c if found else -1
    return -1


@part
def groups_of(columns: Columns) -> Groups:
    """Return where columns stand together."""
    inertia, moment, forced = together(columns, INERTIA, 6), together(columns, MOMENT, 3), 0
    for c in range(columns.kinds.shape[0]):
        forced += columns.kinds[c] >= INERTIA
    return Groups(inertia, moment, forced > 6 * (inertia >= 0) + 3 * (moment >= 0))


@part
def write_inertia(w: Triple, first: int, out: Floats) -> None:
    """Write what is not zero of W(w) into six columns, three rows of LANES numbers."""
    x, y, z = first, first + LANES, first + 2 * LANES
    out[x], out[x + 3], out[x + 4] = w[0], w[1], w[2]
    out[y + 1], out[y + 3], out[y + 5] = w[1], w[0], w[2]
    out[z + 2], out[z + 4], out[z + 5] = w[2], w[0], w[1]


@part
def write_moment(g: Triple, first: int, out: Floats) -> None:
    """Write what is not zero of -[g x] into three columns, three rows of LANES numbers."""
    x, y, z = first, first + LANES, first + 2 * LANES
    out[x + 1], out[x + 2], out[y] = g[2], -g[1], -g[2]
    out[y + 2], out[z], out[z + 1] = g[0], g[1], -g[0]


@part
def write_others(
    body: Body, now: Now, inputs: Inputs, i: int, share: float, w: Triple, g: Triple, work: Work
) -> None:
    """Write f_p and b_p of the columns that do not stand together."""
    kinds, fb, torques = inputs.columns.kinds, work.fb, False
    n, (J, mu, _) = kinds.shape[0], inputs.groups
    for c in range(n):
        torques |= kinds[c] == TORQUE
    regressor(w, g, now.t, now.warmth, body.mass, body.gravity, torques, work.regress)
    for c in range(n):
        kind, k, at = kinds[c], inputs.columns.indices[c], place(c)
        if kind == ERROR:
            write_error(inputs, i, share, int(k), w, g, fb[at:])
        elif kind == TORQUE or (kind == INERTIA and J < 0) or (kind == MOMENT and mu < 0):
            first = at if kind == INERTIA else at + 3 * LANES
            source = k + regressor_block(kind)
            for j in range(3):
                fb[first + j * LANES] = work.regress[j, source]


@part
def forcing(
    body: Body, now: Now, inputs: Inputs, i: int, share: float, w: Triple, g: Triple, work: Work
) -> None:
    """Write f_p (rows 0-2) and b_p (rows 3-5) of every column; the other entries stay zero."""
    J, mu, others = inputs.groups
    if J >= 0:
        write_inertia(w, place(J), work.fb)
    if mu >= 0:
        write_moment(g, place(mu) + 3 * LANES, work.fb)
    if others:
        write_others(body, now, inputs, i, share, w, g, work)
