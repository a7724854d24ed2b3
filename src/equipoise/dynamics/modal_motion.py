"""The motion of a platform with modes, compiled: its total momentum H, and e and p of every mode.

With kinetic energy 1/2 w.J w + e' (d.w) + 1/2 e'^2 (J with the mode at rest), p = dT/de':

    H  = J w + sum d e',         p = e' + d.w
    (J - sum d d^T) w = H - h - sum d p
    H' = -w x H + (mu + sum s e) x g_B + tau
    p' = -W^2 e - 2 z W e' + s.(g_B - g_0)

g_0 is gravity of the level platform, so that e counts from where the mode rests then, and mu is the
first moment of the platform at rest. A mode is thus stored momentum and first moment to the body,
as a moving mass is, and the body's own equations stay as they are (``rigid_body``).

Energy T + 1/2 W^2 e^2 - (mu + s e).g_B + e s.g_0 falls by 2 z W e'^2. J is taken not to change with
e: the part left out is of the order of e / sqrt(I) times that of J which turns, 1e-2 at 1 deg.

Cannot show what a deflection of more than some degrees does, nor a mode that strikes its own stop.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from equipoise.dynamics.forcing import groups_of
from equipoise.dynamics.propagation import NO_COLUMNS, evaluate, slope, to_unit
from equipoise.dynamics.regressor import WIDTH
from equipoise.dynamics.rigid_body import ROWS, Body, Now, body_at, invert, times
from equipoise.dynamics.sensitivities import Inputs, Work
from equipoise.maths.kernels.compiled import kernel, part
from equipoise.maths.kernels.copying import copy_values
from equipoise.model.arrays import Floats, Ints, Series1, Six, Triple, Vector3
from equipoise.model.modes import Mode

SWAY = 0.05  # rad of a mode's phase in a step, chosen: energy errs by 2e-10 of it in a step
TURN = 0.0125  # rad, chosen: as ``simulation.motion``
MOST_PARTS = 1000.0  # chosen: a gap of more is no motion, but a search that is lost
NO_OWNERS: Ints = np.zeros((0, 2), dtype=np.int64)
W, Z, D, S, NUMBERS = 0, 1, 2, 5, 8  # where a mode keeps W, z, d and s


class Modes(NamedTuple):
    """The modes as the kernels see them."""

    table: Floats  # (m, 8) W rad/s, z, d sqrt(kg) m, s sqrt(kg)
    level: Triple  # m/s^2, gravity of the level platform, body axes


class ModalMotion(NamedTuple):
    """The motion at every node."""

    y: Floats  # (n, 7 + 2 m): q, H, then e and p of every mode
    rate: Floats  # (n, 3) rad/s


def modes_of(modes: Sequence[Mode], up: Vector3, gravity: float) -> Modes:
    """Return the modes as the kernels see them; ``up`` is the body axis that points up level."""
    rows = [[m.angular_frequency, m.damping, *m.coupling, *m.moment] for m in modes]
    x, y, z = -gravity * up
    table: Floats = np.array(rows, dtype=np.float64).reshape(-1, NUMBERS)
    return Modes(table, (float(x), float(y), float(z)))


def begun(modes: Sequence[Mode], rate: Vector3) -> Floats:
    """Return e and p of every mode at the beginning, the platform turning at a rate (rad/s)."""
    pairs = [(m.deflection, m.velocity + float(m.coupling @ rate)) for m in modes]
    return np.array(pairs, dtype=np.float64).ravel()


@kernel
def modal_work(modes: Modes) -> Work:
    """Return the arrays that a step works in."""
    m = ROWS + 2 * modes.table.shape[0]
    return Work(np.empty(m), np.empty(m), np.empty(m), np.zeros((3, WIDTH)), np.zeros(0))


@part
def with_modes(modes: Modes, now: Now, y: Floats) -> Now:
    """Return the platform with the momentum sum d e' and the first moment sum s e of its modes."""
    table, (xx, yy, zz, xy, xz, yz), h, mu = modes.table, now.inertia, now.momentum, now.moment
    r0, r1, r2 = y[4] - h[0], y[5] - h[1], y[6] - h[2]
    for k in range(table.shape[0]):
        a, b, c, p = table[k, D], table[k, D + 1], table[k, D + 2], y[ROWS + 2 * k + 1]
        xx, yy, zz, xy, xz, yz = (
            xx - a * a, yy - b * b, zz - c * c, xy - a * b, xz - a * c, yz - b * c,
        )  # fmt: skip
        r0, r1, r2 = r0 - a * p, r1 - b * p, r2 - c * p
    w = times(invert((xx, yy, zz, xy, xz, yz)), (r0, r1, r2))
    h0, h1, h2, m0, m1, m2 = h[0], h[1], h[2], mu[0], mu[1], mu[2]
    for k in range(table.shape[0]):
        e, along = y[ROWS + 2 * k], velocity(table[k], y[ROWS + 2 * k + 1], w)
        h0, h1, h2 = (h0 + along * table[k, D], h1 + along * table[k, D + 1],
                      h2 + along * table[k, D + 2])  # fmt: skip
        m0, m1, m2 = (m0 + e * table[k, S], m1 + e * table[k, S + 1],
                      m2 + e * table[k, S + 2])  # fmt: skip
    return Now(now.t, now.warmth, now.inertia, now.inverse, (m0, m1, m2), (h0, h1, h2),
               now.torque)  # fmt: skip


@part
def velocity(mode: Floats, p: float, w: Triple) -> float:
    """Return e' = p - d.w."""
    return p - mode[D] * w[0] - mode[D + 1] * w[1] - mode[D + 2] * w[2]


@part
def modal_rates(modes: Modes, w: Triple, g: Triple, y: Floats, dy: Floats) -> None:
    """Write e' and p' of every mode."""
    level = modes.level
    for k in range(modes.table.shape[0]):
        mode, e = modes.table[k], y[ROWS + 2 * k]
        along = velocity(mode, y[ROWS + 2 * k + 1], w)
        pull = 0.0
        for j in range(3):
            pull += mode[S + j] * (g[j] - level[j])
        dy[ROWS + 2 * k] = along
        dy[ROWS + 2 * k + 1] = pull - mode[W] * (mode[W] * e + 2.0 * mode[Z] * along)


@part
def modal_slope(
    body: Body, modes: Modes, inputs: Inputs, i: int, share: float, y: Floats, work: Work,
    dy: Floats,
) -> None:  # fmt: skip
    """Write y' at ``share`` of step i."""
    rigid = body_at(body, inputs.maps, inputs.t, inputs.known, i, share)
    now = with_modes(modes, rigid, y)
    w, g = evaluate(body, now, inputs, i, share, y, work)
    slope(body, now, w, g, y, work, dy)
    modal_rates(modes, w, g, y, dy)


@part
def modal_step(
    body: Body, modes: Modes, inputs: Inputs, i: int, first: float, last: float, y: Floats,
    work: Work,
) -> None:  # fmt: skip
    """Take y from one share of step i to another, in place, by Runge-Kutta of order 4."""
    at, dy, total = work.at, work.dy, work.total
    h, n = (last - first) * (inputs.t[i + 1] - inputs.t[i]), y.shape[0]
    for j in range(n):
        total[j], at[j] = 0.0, y[j]
    for k in range(4):
        share = first if k == 0 else last if k == 3 else 0.5 * (first + last)
        weight = 2.0 if 0 < k < 3 else 1.0
        modal_slope(body, modes, inputs, i, share, at, work, dy)
        for j in range(n):
            total[j] += weight * dy[j]
            at[j] = y[j] + (h if k == 2 else 0.5 * h) * dy[j]
    for j in range(n):
        y[j] += h / 6 * total[j]
    to_unit(y)


@part
def modal_parts(body: Body, modes: Modes, now: Now, w: Triple, gap: float) -> int:
    """Return into how many steps a gap (s) is cut: by turning, swinging, and each mode's phase."""
    mu, inverse, fastest = now.moment, now.inverse, 0.0
    trace = inverse[0] + inverse[1] + inverse[2]
    for k in range(modes.table.shape[0]):
        mode = modes.table[k]
        taking = mode[D] * mode[D] + mode[D + 1] * mode[D + 1] + mode[D + 2] * mode[D + 2]
        stiffening = max(1.0 - taking * trace, 0.1)  # an upper bound of its free frequency
        fastest = max(fastest, mode[W] * stiffening**-0.5)
    turning = (w[0] * w[0] + w[1] * w[1] + w[2] * w[2]) ** 0.5
    moment = (mu[0] * mu[0] + mu[1] * mu[1] + mu[2] * mu[2]) ** 0.5
    swinging = (body.gravity * moment * trace) ** 0.5
    steps = abs(gap) * ((turning + swinging) / TURN + fastest / SWAY)
    return int(min(max(np.ceil(steps - 1e-9), 1.0), MOST_PARTS)) if steps < np.inf else 1


@kernel
def _follow(
    body: Body, maps: Floats, modes: Modes, t: Floats, known: Floats, owners: Ints, y: Floats,
    out: ModalMotion,
) -> None:  # fmt: skip
    inputs = Inputs(maps, t, known, owners, NO_COLUMNS, groups_of(NO_COLUMNS))
    work, last = modal_work(modes), t.shape[0] - 2
    for node in range(t.shape[0]):
        i, share = (last, 1.0) if node > last else (node, 0.0)
        now = with_modes(modes, body_at(body, maps, t, known, i, share), y)
        w, _ = evaluate(body, now, inputs, i, share, y, work)
        copy_values(y, out.y[node])
        out.rate[node, 0], out.rate[node, 1], out.rate[node, 2] = w
        if node <= last:
            n = modal_parts(body, modes, now, w, t[node + 1] - t[node])
            for j in range(n):
                modal_step(body, modes, inputs, node, j / n, (j + 1) / n, y, work)


def follow_modes(
    body: Body, maps: Floats, modes: Modes, y: Floats, t: Series1, known: Floats
) -> ModalMotion:
    """Return the motion from state ``y`` at the first of at least two nodes ``t`` (s).

    ``known`` and ``maps`` are those of ``timeline`` and ``propagation.stacked``.
    """
    out = ModalMotion(np.zeros((len(t), len(y))), np.zeros((len(t), 3)))
    _follow(body, maps, modes, t, known, NO_OWNERS, y.copy(), out)
    return out


@kernel
def total_momentum(
    body: Body, maps: Floats, t: Floats, known: Floats, i: int, w: Floats
) -> tuple[Triple, Six]:
    """Return J w + h (N m s) at the beginning of step i, without modes, and J^-1."""
    now = body_at(body, maps, t, known, i, 0.0)
    H, h = times(now.inertia, (w[0], w[1], w[2])), now.momentum
    return (H[0] + h[0], H[1] + h[1], H[2] + h[2]), now.inverse
