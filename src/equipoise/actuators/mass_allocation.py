"""From a wanted shift of the centre of mass to whole motor steps, fast enough for a feedback loop.

With x_i the steps from where mass i is, q_i what one of them does to the centre of mass, and r what
is wanted less what is there:

    minimise  sum c_i |q_i| |x_i| + C |r - sum q_i x_i|_1,    low_i <= x_i <= high_i

a linear programme in three rows (``maths.bounded_simplex``). Then, from the coarsest mass to the
finest, each is rounded to the better neighbour, with the finer masses free to take up what is left.
Masses whose steps are alike within a factor of 2 form a tier; a tier's c is 100 times the next
finer one's, so that

- a coarse mass moves only by as many steps as the finer ones cannot do. It then stays until they
  are at their ends again, which is the hysteresis that keeps it from chattering;
- what no masses can reach is approached as nearly as possible, by the sum over the axes.

Coarse masses that move only as far as they must leave fine ones at an end, where the next small
change would move a coarse one again, with its larger error; on skew rails they leave them in a
corner of what these can reach, where there may be no whole coarse step. Where a coarse mass moves,
all is done once more with a fifth of the travel of the fine ones beside it kept back until the
coarse ones are decided; where an error is left, of all fine ones. It counts where it leaves less,
or no more than rounding.

Within what can be reached, the error along each rail is at most half a step of the finest masses
where rails are at right angles, and the sum over the axes at most sum |q_i|_1 / 2 over three of the
finest where they are not; at the corners of what coarse and fine masses on skew rails reach
together, it may be some steps of the fine ones. A mass without steps (resolution 0) belongs to the
finest.

``displacements_for`` in ``sliding_masses`` finds the best of all steps, in some milliseconds.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from equipoise.actuators.sliding_masses import mass_maps
from equipoise.maths.bounded_simplex import Table, level_of, minimise
from equipoise.maths.kernels.compiled import kernel, part
from equipoise.model.arrays import Bools, Floats, Ints, Vector3
from equipoise.model.testbed import SlidingMass

ALIKE = 2.0  # -, chosen: coarse masses have steps many times the fine ones'
DEARER = 100.0  # -, chosen: more than a coarse step can save of fine ones
TIERS = 3  # chosen: more would drown the finest tier's cost in rounding
WRONG = 1e6  # -, chosen: an error of a step's length costs so many of the dearest steps
FREE_STEP = 1e-3  # m, chosen: in which a mass without steps is counted
WHOLE = 1e-6  # steps, chosen: nearer to a whole step than this is there
NEAR = 1e-3  # units, chosen: rounding of what is allowed
NEARBY = 1.0  # steps of the coarsest, chosen: half of one is needed, the rest keeps it still
PROMPT = 0.5  # s, chosen: of travel, that feedback at periods of ten seconds and more bears
ONE_WAY = 0.5  # cosine, chosen: rails that share a direction
KEPT = 0.2  # -, chosen: of the travel at each end


class Rails(NamedTuple):
    """The masses as the kernel takes them; lengths of the centre of mass in units of ``unit``."""

    gain: Floats  # (k, 3) per step
    step: Floats  # (k,) m
    whole: Bools  # (k,) moves by whole steps
    low: Floats  # (k,) steps from home
    high: Floats  # (k,)
    prompt: Floats  # (k,) steps in PROMPT
    cost: Floats  # (k,) per step
    order: Ints  # (k,) coarsest first
    tier: Ints  # (k,) 0: the finest
    allowed: float  # what rounding the finest may leave, sum over the axes
    error_cost: float
    unit: float  # m, what the finest step does


class Search(NamedTuple):
    """Where the search for whole steps stands."""

    table: Table  # columns: steps forward, steps back, error over and under
    x: Floats  # (k,) the solution of the programme, steps from now
    fixed: Bools  # (k,) masses that are decided
    chosen: Floats  # (k,) and where, steps from now


def tiers_of(quanta: Floats) -> Ints:
    """Return the tier of each mass by what its step does, 0 the finest."""
    tier, level, finest = np.zeros(len(quanta), dtype=np.int64), 0, 0.0
    for rank, i in enumerate(np.argsort(quanta, kind="stable")):
        if rank == 0:
            finest = quanta[i]
        elif quanta[i] > ALIKE * finest:
            level, finest = min(level + 1, TIERS - 1), quanta[i]
        tier[i] = level
    return tier


def rails_of(masses: Sequence[SlidingMass], total_mass: float) -> Rails:
    """Return the rails of these masses, in their order."""
    resolution = np.array([m.resolution for m in masses])
    whole, step = resolution > 0, np.where(resolution > 0, resolution, FREE_STEP)
    low, high = np.array([m.travel for m in masses]).T / step
    gain = mass_maps(masses).first_moment * step[:, None] / total_mass
    length = np.linalg.norm(gain, axis=1)
    unit = float(length.min())
    tier = tiers_of(length * whole)
    cost = DEARER**tier * length / unit
    speed = np.array([m.speed for m in masses])
    halves = 0.5 * abs(gain).sum(axis=1) / unit * (whole & (tier == 0))
    return Rails(
        gain / unit,
        step,
        whole,
        np.where(whole, np.ceil(low - WHOLE), low),
        np.where(whole, np.floor(high + WHOLE), high),
        PROMPT * speed / step,
        cost,
        np.argsort(-length * whole, kind="stable"),
        tier,
        float(np.sort(halves)[-3:].sum()) + NEAR,
        WRONG * float(cost.max()),
        unit,
    )


@part
def lay_out(rails: Rails, now: Floats, rest: Floats, at: Search) -> None:
    """Write the table whose basic columns are the errors, for what is not decided yet."""
    k, table = now.shape[0], at.table
    for j in range(k):
        free = 0.0 if at.fixed[j] else 1.0
        table.upper[j] = free * (rails.high[j] - now[j])
        table.upper[k + j] = free * (now[j] - rails.low[j])
        table.cost[j] = table.cost[k + j] = rails.cost[j]
    table.full[:] = False
    table.rows[:] = 0.0
    for a in range(3):
        left = rest[a]
        for j in range(k):
            left -= rails.gain[j, a] * at.chosen[j] if at.fixed[j] else 0.0
        sign = 1.0 if left >= 0 else -1.0
        for j in range(k):
            table.rows[a, j] = sign * rails.gain[j, a]
            table.rows[a, k + j] = -table.rows[a, j]
        over, under = 2 * k + a, 2 * k + 3 + a
        table.rows[a, over], table.rows[a, under] = sign, -sign
        table.basic[a], table.value[a] = (over if left >= 0 else under), abs(left)
        table.cost[over] = table.cost[under] = rails.error_cost
        table.upper[over] = table.upper[under] = np.inf


@part
def solve(rails: Rails, now: Floats, rest: Floats, at: Search) -> float:
    """Write the least-cost steps of what is not decided; return all cost, decided ones counted."""
    k, total = now.shape[0], 0.0
    lay_out(rails, now, rest, at)
    minimise(at.table)
    for j in range(at.table.cost.shape[0]):
        level = level_of(at.table, j)
        total += at.table.cost[j] * level
        if j < k:
            at.x[j] = level + (at.chosen[j] if at.fixed[j] else 0.0)
            total += rails.cost[j] * abs(at.chosen[j]) if at.fixed[j] else 0.0
        elif j < 2 * k:
            at.x[j - k] -= level
    return total


@part
def decide(rails: Rails, now: Floats, rest: Floats, at: Search, i: int) -> None:
    """Fix mass i at the better of the whole steps beside where it should be."""
    x = at.x[i]
    near = np.rint(x)
    at.fixed[i], at.chosen[i] = True, near if rails.whole[i] else x
    if not rails.whole[i] or abs(x - near) < WHOLE:
        return
    cost = solve(rails, now, rest, at)
    at.chosen[i] = near + (1.0 if x > near else -1.0)
    if solve(rails, now, rest, at) >= cost:
        at.chosen[i] = near
        solve(rails, now, rest, at)


@kernel
def _allocate(rails: Rails, eased: Rails, now: Floats, rest: Floats, out: Floats) -> None:
    k = now.shape[0]
    n = 2 * k + 6
    table = Table(
        np.empty((3, n)), np.empty(3, dtype=np.int64), np.empty(3), np.empty(n), np.empty(n),
        np.empty(n, dtype=np.bool_),
    )  # fmt: skip
    at = Search(table, np.empty(k), np.zeros(k, dtype=np.bool_), np.zeros(k))
    coarse = True
    solve(eased, now, rest, at)
    for i in rails.order:
        if coarse and rails.tier[i] == 0:
            coarse = False
            solve(rails, now, rest, at)
        decide(eased if coarse else rails, now, rest, at, i)
    out[:] = at.chosen


def with_ends_kept(rails: Rails, travel: Rails, which: Bools) -> Rails:
    """Return the rails with both ends of travel kept back, of some below the coarsest tier.

    ``travel`` are the rails as long as they are, of which ``rails`` may be parts. A part that lies
    in an end is left as it is.
    """
    finer = which & (rails.tier < rails.tier.max())
    kept = np.where(finer, KEPT * (travel.high - travel.low), 0.0)
    kept = np.where(rails.whole, np.floor(kept), kept)
    low = np.maximum(rails.low, travel.low + kept)
    high = np.minimum(rails.high, travel.high - kept)
    within = low <= high
    return rails._replace(low=np.where(within, low, rails.low),
                          high=np.where(within, high, rails.high))  # fmt: skip


def reached(rails: Rails, eased: Rails, steps: Floats, wanted: Vector3) -> tuple[Floats, float]:
    """Return the steps to go to from ``steps``, and how far they miss, in units."""
    begin, moved = np.clip(steps, eased.low, eased.high), np.zeros_like(steps)
    _allocate(rails, eased, begin, wanted - begin @ rails.gain, moved)
    there = begin + moved
    return there, float(abs(wanted - there @ rails.gain).sum())


def allocate(rails: Rails, now: Floats, wanted: Vector3) -> Floats:
    """Return displacements (m, from home) that shift the centre of mass by ``wanted`` (m).

    Counted from home, not from where the masses are ``now`` (m, taken at the nearest step); see
    ``com_shift`` for what is reached.
    """
    return _allocated(rails, rails, now, wanted)


def _allocated(rails: Rails, travel: Rails, now: Floats, wanted: Vector3) -> Floats:
    """Return displacements (m) within ``rails``, which are parts of ``travel``."""
    steps = now / rails.step
    steps = np.clip(np.where(rails.whole, np.rint(steps), steps), rails.low, rails.high)
    there, missed = reached(rails, rails, steps, wanted / rails.unit)
    coarse = (there != steps) & (rails.tier > 0)
    which = beside(rails, coarse) if missed <= rails.allowed else np.ones(len(steps), bool)
    if coarse.any() or missed > rails.allowed:
        again, still = reached(
            rails, with_ends_kept(rails, travel, which), steps, wanted / rails.unit
        )
        there = again if still < missed or still <= rails.allowed else there
    return there * rails.step


def beside(rails: Rails, moved: Bools) -> Bools:
    """Return which masses shift the centre of mass along about the same line as one that moved."""
    along = rails.gain / np.linalg.norm(rails.gain, axis=1, keepdims=True)
    return np.any(np.abs(along @ along[moved].T) > ONE_WAY, axis=1)


def at_once(rails: Rails) -> Floats:
    """Return how many steps each mass goes before a coarser one is asked to."""
    quantum = np.linalg.norm(rails.gain, axis=1)
    coarsest = float(quantum[rails.tier == rails.tier.max()].min())
    return np.maximum(rails.prompt, NEARBY * coarsest / quantum)


def least_changes(rails: Rails) -> Floats:
    """Return the change of the shift (m) from which on each mass may have to move.

    The finest move from half a step on, the others from where finer ones do not go at once.
    """
    quantum = np.linalg.norm(rails.gain, axis=1)
    first, there = 0.5 * quantum, at_once(rails) * quantum
    for i in np.flatnonzero(rails.tier > 0):
        first[i] = there[rails.tier < rails.tier[i]].min()
    return first * rails.unit


def without_delay(rails: Rails, now: Floats, here: Floats, wanted: Vector3) -> Floats:
    """Return displacements (m, from home) as ``allocate`` does, but soon reached from ``here`` (m).

    Slow fine masses cross their travel in a time in which a feedback loop has long lost its phase:
    they go no further from where they are than in PROMPT, or than NEARBY steps of the coarsest, and
    those do the rest. Where that would miss, the fine ones go as far as they must.
    """
    coarsest, nearby = rails.tier == rails.tier.max(), at_once(rails)
    steps = np.clip(here / rails.step, rails.low, rails.high)
    low = np.where(coarsest, rails.low, np.maximum(rails.low, np.floor(steps - nearby)))
    high = np.where(coarsest, rails.high, np.minimum(rails.high, np.ceil(steps + nearby)))
    near = _allocated(rails._replace(low=low, high=high), rails, now, wanted)
    missed = float(abs(wanted / rails.unit - near / rails.step @ rails.gain).sum())
    return near if missed <= rails.allowed else allocate(rails, now, wanted)
