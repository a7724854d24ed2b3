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
from equipoise.estimation.output_error.kernels.segments import STATE, add_scaled
from equipoise.maths.kernels.compiled import kernel, part
from equipoise.model.arrays import Bools, Floats, Ints

SHORT = 16  # steps, chosen: a shorter stand is part of the travel
LITTLE = 0.01  # of the greatest displacement, chosen: by which a mass that stands may be elsewhere
MOSTLY = 0.5  # of the steps, chosen
EXACT = 1e-9  # of the greatest share: by which one that is the same may vary
CORE = 15  # columns: of the first state, J and the first moment
J_AT, MU_AT = 6, 12  # where those of J and the first moment begin


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
    by_all: Floats  # (15, n) L: the first unknowns of the part by all
    mixed: NDArray[np.bool_]  # (15,) which rows of L are not those of the unit matrix
    product: Floats  # (n, n) A_part L
    onward: Floats  # (6, n) X
    own_errors: NDArray[np.bool_]  # of which the part has columns


@kernel
def share_for(columns: int, unknowns: int) -> Share:
    """Return the arrays for so many columns and unknowns."""
    n = unknowns
    return Share(pass_for(columns, n), np.zeros((n, n)), np.zeros(n), np.zeros((STATE, columns)),
                 np.zeros((CORE, n)), np.zeros(CORE, dtype=np.bool_), np.zeros((n, n)),
                 np.zeros((STATE, n)), np.zeros(n, dtype=np.bool_))  # fmt: skip


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
        share.mixed[j] = False


@part
def mean_of(known: Floats, nodes: tuple[int, int], column: int) -> float:
    """Return the mean of a known input from one node to another."""
    total = 0.0
    for i in range(nodes[0], nodes[1] + 1):
        total += known[i, column]
    return total / (nodes[1] + 1 - nodes[0])


@part
def begin_part(places: Ints, error_at: int, share: Share) -> None:
    """Write L of a part whose J and mu are those of the whole, and which errors it has."""
    L = share.by_all
    for j in range(CORE):
        for a in range(L.shape[1]):
            L[j, a] = share.onward[j, a] if j < STATE else 1.0 * (a == j)
        if j >= STATE:
            share.mixed[j] = False
    share.own_errors[:] = False
    for at in places:
        if at >= error_at:
            share.own_errors[at - error_at] = True


@part
def express(
    known: Floats, owners: Ints, maps: Floats, nodes: tuple[int, int], mass: float, error_at: int,
    share: Share,
) -> None:  # fmt: skip
    """Add dJ and dmu by the errors that the part between two nodes has no columns of to L.

    By com instead of mu, as the unknowns have it.
    """
    L = share.by_all
    for c in range(owners.shape[0]):
        owner, error = owners[c, 0], owners[c, 1]
        r = known[nodes[0], KNOWN_D + maps.shape[0] + c]
        if share.own_errors[error] or r == 0.0:
            continue
        d, at = mean_of(known, nodes, KNOWN_D + owner), error_at + error
        for j in range(J_AT, CORE):
            share.mixed[j] = True
        for j in range(6):
            L[J_AT + j, at] += r * (maps[owner, A + j] + 2 * d * maps[owner, B + j])
        for j in range(3):
            L[MU_AT + j, at] += r * maps[owner, j] / mass


@part
def place_of(places: Ints, columns: int, a: int) -> int:
    """Return which of all unknowns is the a-th of a part; ``columns`` are those of all."""
    m = places.shape[0]
    return places[a] if a < m else columns + a - m


@part
def by_all_unknowns(
    row: Floats, places: Ints, columns: int, count: int, share: Share, out: Floats
) -> None:
    """Write row L, the row having ``count`` unknowns of a part."""
    n = out.shape[0]
    for a in range(n):
        out[a] = 0.0
    for c in range(count):
        if c < CORE and share.mixed[c]:
            add_scaled(row[c], share.by_all[c], out, n)
        else:
            out[place_of(places, columns, c)] += row[c]


@part
def add_part(places: Ints, columns: int, share: Share, normal: Floats, descent: Floats) -> None:
    """Add L^T A_part L and L^T b_part of a part to A and b."""
    n, m, L = descent.shape[0], places.shape[0], share.by_all
    count = m + n - columns
    for i in range(count):
        row, size = share.product[i], share.right[i]
        by_all_unknowns(share.square[i], places, columns, count, share, row)
        if i < CORE and share.mixed[i]:
            add_scaled(size, L[i], descent, n)
            for a in range(n):
                if L[i, a] != 0.0:
                    add_scaled(L[i, a], row, normal[a], n)
        else:
            at = place_of(places, columns, i)
            descent[at] += size
            add_scaled(1.0, row, normal[at], n)


@part
def pass_on(places: Ints, columns: int, share: Share) -> None:
    """Write X at the end of a part."""
    for j in range(STATE):
        by_all_unknowns(share.phi[j], places, columns, places.shape[0], share, share.onward[j])
        share.mixed[j] = True
