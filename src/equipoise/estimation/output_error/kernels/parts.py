"""Parts of a record within which few sensitivities are of their own, and how they make a whole.

A record has as many columns as unknowns, an error of every travel among them. Each changes the
motion only through the state, J and the first moment mu. While masses stand at d with shares r of
an error, its column is one of those of J and mu (``sensitivities``; A, B, m as in the mass maps):

    f = r (A + 2 d B) w,    b = r m x g_B        so   dJ = r (A + 2 d B),    dmu = r m

So a part has the columns of its first state, J, mu and torques, and those of errors whose share
changes. With x = L p, p being all unknowns and x those of the part, its first state by all before,

    A <- A + L^T A_part L,    b <- b + L^T b_part,    X <- Phi L

give the local model of all, and d(state at the end)/dp: X.

The state is handed over as the step that ends sees it. What a travel takes of the momentum then is
the same on both sides if a part also has the errors that changed in the step before it; a stand
begins a step late, so that it has none of these.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from equipoise.dynamics.rigid_body import KNOWN_D, A, B
from equipoise.dynamics.sensitivities import ERROR, Columns
from equipoise.dynamics.timeline import Timeline
from equipoise.estimation.output_error.kernels.normal_equations import Pass, pass_for
from equipoise.estimation.output_error.kernels.segments import STATE, add_scaled, add_six
from equipoise.maths.kernels.compiled import kernel, part
from equipoise.maths.kernels.copying import copy_rows
from equipoise.model.arrays import Bools, Floats, Ints

SHORT = 16  # steps, chosen: a shorter stand is part of the travel
LITTLE = 0.01  # of the greatest displacement, chosen: by which a mass that stands may be elsewhere
MOSTLY = 0.5  # of the steps, chosen
EXACT = 1e-9  # of the greatest share: by which one that is the same may vary
CORE = 15  # columns: of the first state, J and the first moment, in this order


class Parts(NamedTuple):
    """Where the parts of a record begin, and which of its columns each has."""

    nodes: Ints  # (S + 1,) where each part begins; the last node
    stretch: Ints  # (K + 1,) the first part of each stretch; S
    first: Ints  # (S + 1,) where the columns of each part begin in what follows
    kinds: Ints  # of the columns, part by part
    indices: Ints
    places: Ints  # among all columns


class Share(NamedTuple):
    """Arrays in which a part is made one of the whole; made once."""

    own: Pass  # in which a part is summed
    square: Floats  # A of the part
    right: Floats  # its b
    phi: Floats  # (6, columns) its end by its unknowns
    before: Floats  # (6, n) X where the part begins: L of its first state
    is_carried: NDArray[np.bool_]  # (1,) that X is not that of the unit matrix
    lacking: Ints  # (n,) unknowns that act on J and mu, and the part has no columns of
    response: Floats  # (n, 9) L of J and mu by each of them, by com instead of mu
    product: Floats  # (n, n) A_part L
    onward: Floats  # (6, n) X where it ends
    own_errors: NDArray[np.bool_]  # of which the part has columns


@kernel
def share_for(columns: int, unknowns: int) -> Share:
    """Return the arrays for so many columns and unknowns."""
    n = unknowns
    return Share(pass_for(columns, n), np.zeros((n, n)), np.zeros(n), np.zeros((STATE, columns)),
                 np.zeros((STATE, n)), np.zeros(1, dtype=np.bool_), np.zeros(n, dtype=np.int64),
                 np.zeros((n, CORE - STATE)), np.zeros((n, n)), np.zeros((STATE, n)),
                 np.zeros(n, dtype=np.bool_))  # fmt: skip


@kernel
def stands(values: Floats, tolerance: Floats, still: Bools) -> None:
    """Write in which steps all values (n + 1, f) stand: ``SHORT`` or more within tolerance."""
    n, f = values.shape[0] - 1, values.shape[1]
    low, high, i = np.empty(f), np.empty(f), 0
    while i < n:
        end, within = i, True
        for j in range(f):
            low[j], high[j] = values[i, j], values[i, j]
        while within and end < n:
            for j in range(f):
                low[j], high[j] = min(low[j], values[end + 1, j]), max(high[j], values[end + 1, j])
                within &= high[j] - low[j] <= tolerance[j]
            end += within
        if end - i >= SHORT or (i == 0 and end == n):
            still[i:end] = True
            i = end
        else:
            i += 1


def wavering(shares: Floats) -> Bools:
    """Return which shares (n + 1, f) of errors vary in most steps, as what is measured does."""
    return np.count_nonzero(shares[1:] != shares[:-1], axis=0) > MOSTLY * (len(shares) - 1)


def standing_runs(displacements: Floats, shares: Floats, loose: Bools) -> Bools:
    """Return in which steps all masses stand, and their shares of errors but the ``loose``."""
    way = np.full(displacements.shape[1], LITTLE * np.abs(displacements).max(initial=0.0))
    same = np.where(loose, np.inf, EXACT * np.abs(shares).max(axis=0))
    still = np.zeros(len(shares) - 1, dtype=np.bool_)
    stands(np.hstack([displacements, shares]), np.append(way, same), still)
    return still & np.append(True, still[:-1])


def parts_of(line: Timeline, cuts: Ints, columns: Columns) -> Parts:
    """Return the parts of a grid, cut at these nodes."""
    if not len(line.owners):
        return whole_stretches(cuts, columns)
    errors, last = columns.kinds == ERROR, line.known.shape[1] - len(line.owners)
    displacements, shares = line.known[:, KNOWN_D:last], line.known[:, last:]
    loose = wavering(shares)
    still = standing_runs(displacements, shares, loose)
    changes = 1 + np.flatnonzero(np.diff(still))
    nodes = np.unique(np.concatenate([cuts, changes])).astype(np.int64)
    begins = nodes[:-1]
    counted = np.ones((len(begins), len(columns.kinds)), dtype=np.bool_)
    acts = acting(shares, begins) & ~(still[begins, None] & ~loose)
    counted[:, errors] = of_errors(acts, line.owners, int(errors.sum()))
    part_of, places = np.nonzero(counted)
    first = np.searchsorted(part_of, np.arange(len(begins) + 1))
    return Parts(
        nodes,
        np.searchsorted(nodes, cuts).astype(np.int64),
        first.astype(np.int64),
        columns.kinds[places],
        columns.indices[places],
        places.astype(np.int64),
    )


def whole_stretches(cuts: Ints, columns: Columns) -> Parts:
    """Return the parts of a grid without errors: from cut to cut, with all columns each."""
    stretches, n = len(cuts) - 1, len(columns.kinds)
    return Parts(
        cuts,
        np.arange(stretches + 1),
        n * np.arange(stretches + 1),
        np.tile(columns.kinds, stretches),
        np.tile(columns.indices, stretches),
        np.tile(np.arange(n), stretches),
    )


def acting(shares: Floats, begins: Ints) -> Bools:
    """Return which shares act within each part, which ends where the next begins.

    Those that are not zero, or changed in the step behind its beginning.
    """
    within = shares != 0
    changed = np.vstack([shares[:1] != shares[:1], shares[1:] != shares[:-1]])
    found = np.logical_or.reduceat(within[:-1] | within[1:], begins, axis=0)
    return found | changed[begins]


def of_errors(acts: Bools, owners: Ints, errors: int) -> Bools:
    """Return which errors act in each part: those of which any share does."""
    found = np.zeros((len(acts), errors), dtype=np.bool_)
    for column, (_, error) in enumerate(owners):
        found[:, error] |= acts[:, column]
    return found


@part
def columns_within(parts: Parts, p: int) -> tuple[Columns, Ints]:
    """Return the columns of a part, and their places among all."""
    a, b = parts.first[p], parts.first[p + 1]
    return Columns(parts.kinds[a:b], parts.indices[a:b]), parts.places[a:b]


@part
def count_errors(columns: Columns) -> int:
    """Return how many columns are of errors; they come last."""
    count = 0
    for kind in columns.kinds:
        count += kind == ERROR
    return count


@part
def begin_stretch(share: Share) -> None:
    """Write X of a state that is the unknowns' own."""
    share.onward[:] = 0.0
    for j in range(STATE):
        share.onward[j, j] = 1.0
    share.is_carried[0] = False


@part
def mean_of(known: Floats, nodes: tuple[int, int], column: int) -> float:
    """Return the mean of a known input from one node to another."""
    total = 0.0
    for i in range(nodes[0], nodes[1] + 1):
        total += known[i, column]
    return total / (nodes[1] + 1 - nodes[0])


@part
def begin_part(places: Ints, error_at: int, share: Share) -> None:
    """Write L of the first state of a part, and of which errors it has columns."""
    copy_rows(share.onward, share.before)
    share.own_errors[:] = False
    for at in places:
        if at >= error_at:
            share.own_errors[at - error_at] = True


@part
def express(
    known: Floats, owners: Ints, maps: Floats, nodes: tuple[int, int], mass: float, error_at: int,
    share: Share,
) -> int:  # fmt: skip
    """Write dJ and dmu by the errors of which the part between two nodes has no columns.

    Return how many such errors there are.
    """
    count = 0
    for c in range(owners.shape[0]):
        owner, error = owners[c, 0], owners[c, 1]
        r = known[nodes[0], KNOWN_D + maps.shape[0] + c]
        if share.own_errors[error] or r == 0.0:
            continue
        d, k = mean_of(known, nodes, KNOWN_D + owner), 0
        while k < count and share.lacking[k] != error_at + error:
            k += 1
        if k == count:  # the first mass that has this error
            share.lacking[k], share.response[k] = error_at + error, 0.0
            count += 1
        for j in range(6):
            share.response[k, j] += r * (maps[owner, A + j] + 2 * d * maps[owner, B + j])
        for j in range(3):
            share.response[k, 6 + j] += r * maps[owner, j] / mass
    return count


@part
def place_of(places: Ints, columns: int, a: int) -> int:
    """Return which of all unknowns is the a-th of a part; ``columns`` are those of all."""
    m = places.shape[0]
    return places[a] if a < m else columns + a - m


@part
def by_all_unknowns(
    row: Floats, places: Ints, columns: int, count: int, lacking: int, share: Share, out: Floats
) -> None:
    """Write row L, the row having ``count`` unknowns of a part that is ``lacking`` so many."""
    n, m = out.shape[0], places.shape[0]
    for a in range(n):
        out[a] = 0.0
    if share.is_carried[0]:
        add_six((row[0], row[1], row[2], row[3], row[4], row[5]), share.before, out, n)
    for c in range(STATE if share.is_carried[0] else 0, m):
        out[places[c]] += row[c]
    for c in range(m, count):
        out[columns + c - m] += row[c]
    for k in range(lacking):
        for j in range(CORE - STATE):
            out[share.lacking[k]] += row[STATE + j] * share.response[k, j]


@part
def add_part(
    places: Ints, columns: int, lacking: int, share: Share, normal: Floats, descent: Floats
) -> None:
    """Add L^T A_part L and L^T b_part of a part to A and b."""
    n, m, L, right, rows = (descent.shape[0], places.shape[0], share.before, share.right,
                            share.product)  # fmt: skip
    count = m + n - columns
    for i in range(count):
        by_all_unknowns(share.square[i], places, columns, count, lacking, share, rows[i])
        if i >= STATE or not share.is_carried[0]:
            at = place_of(places, columns, i)
            descent[at] += right[i]
            add_scaled(1.0, rows[i], normal[at], n)
    for a in range(n if share.is_carried[0] else 0):
        column = (L[0, a], L[1, a], L[2, a], L[3, a], L[4, a], L[5, a])
        add_six(column, rows, normal[a], n)
        for i in range(STATE):
            descent[a] += L[i, a] * right[i]
    for k in range(lacking):
        at = share.lacking[k]
        for j in range(CORE - STATE):
            descent[at] += share.response[k, j] * right[STATE + j]
            add_scaled(share.response[k, j], rows[STATE + j], normal[at], n)


@part
def pass_on(places: Ints, columns: int, lacking: int, share: Share) -> None:
    """Write X at the end of a part."""
    for j in range(STATE):
        by_all_unknowns(share.phi[j], places, columns, places.shape[0], lacking, share,
                        share.onward[j])  # fmt: skip
    share.is_carried[0] = True
