"""A corpus that judges: records over the whole space, and their halves, which must agree.

One record for each seed (``tests.oracle.corpus``), with every input wrong within its stated sd,
is identified by the reference method, as are its two halves; quiet minutes of one platform and
windows of the real record are siblings too. A number counts when the estimate calls itself usable
and states a finite sd for it: centre of mass and inertia, or ratios where the scale is open.

    refused   not usable; in vain: although the Cramer-Rao bound at the truth is below a tenth of
              each moment of inertia
    wrong     a value over 5 sd off, usable
    lost      crash, or no end within the limit of processor time

Siblings share what the laboratory states. Where an input gives the scale, both err alike, and their
difference is less than the sd say: agreement cannot show a wrong input, the truth does.
"""

from collections.abc import Sequence
from functools import partial
from itertools import combinations

import numpy as np

from equipoise.model.estimate import NORMAL_95, normalised_difference
from verification import real_record
from verification.judged_records import LIMIT, SHOWN, THINNED, WRONG, Judged, judged, sibling
from verification.result import Result, Row, Spread, at_least, at_most, in_turn

MOST_BETWEEN = 3.0  # sd, of two siblings
COVERED = (0.92, 0.98)  # of 95 % intervals stated as trustworthy
IN_VAIN, USABLE_QUIET = 0.05, 0.90  # shares of records
STATED = 300


def between(one: Judged, other: Judged) -> float | None:
    """Return the greatest difference of two siblings, in its sd; None where one is refused."""
    if not (
        one.conclusion and one.conclusion.usable and other.conclusion and other.conclusion.usable
    ):
        return None
    of = {p.name: p for p in other.conclusion.firm}
    shared = [normalised_difference(p, of[p.name]) for p in one.conclusion.firm if p.name in of]
    return max(map(abs, shared), default=None)


# --- rows -----------------------------------------------------------------------------------------


def _list(runs: Sequence[Judged]) -> str:
    """Return the names of some runs, to stand behind a quantity."""
    return f" ({'; '.join(run.name for run in runs[:3])})" if runs else ""


def corpus_rows(runs: Sequence[Judged]) -> tuple[Row, ...]:
    """Return the counts over whole records."""
    z = np.array([v for r in runs if r.conclusion and r.conclusion.relied_on for v in r.z.values()])
    wrong, lost = [r for r in runs if r.wrong], [r for r in runs if r.conclusion is None]
    refused, vain = [r for r in runs if r.refused], [r for r in runs if r.refused and r.shown]
    times = [r.seconds for r in runs]
    inside = float(np.mean(np.abs(z) < NORMAL_95)) if len(z) else 1.0
    share = f"{COVERED[0]:.0%} to {COVERED[1]:.0%}"
    return (
        Row(f"95 % intervals, of {len(z)} stated as trustworthy, that hold the truth",
            f"{inside:.1%}", share, COVERED[0] <= inside <= COVERED[1]),
        Row("records refused", f"{len(refused)} of {len(runs)}", "any", True),
        at_most(f"the same, though the bound tells J within {SHOWN:.0%}{_list(vain)}",
                len(vain) / len(runs), IN_VAIN, ".1%"),
        at_most(f"wrong: over {WRONG:g} sd and usable{_list(wrong)}", len(wrong), 0, "d"),
        at_most(f"lost: crash or no end{_list(lost)}", len(lost), 0, "d"),
        at_most("processor time, s, median", float(np.median(times)), LIMIT),
        at_most("the same, worst", max(times), LIMIT),
    )  # fmt: skip


def sibling_row(name: str, families: Sequence[Sequence[Judged]]) -> Row:
    """Return how many siblings, both usable, disagree."""
    pairs = [pair for family in families for pair in combinations(family, 2)]
    distances = [(a, between(a, b)) for a, b in pairs]
    known = [(a, distance) for a, distance in distances if distance is not None]
    odd = [a for a, distance in known if distance > MOST_BETWEEN]
    text = f"{name}: pairs, of {len(known)} usable of {len(pairs)}, over {MOST_BETWEEN:g} sd"
    return at_most(text + _list(odd), len(odd), 0, "d")


def quiet_rows(minutes: Sequence[Judged]) -> tuple[Row, ...]:
    """Return the rows of quiet records, two minutes of each."""
    usable = float(np.mean([bool(m.conclusion and m.conclusion.usable) for m in minutes]))
    families = [minutes[k : k + 2] for k in range(0, len(minutes), 2)]
    share = at_least("quiet minutes that are usable", usable, USABLE_QUIET, ".1%")
    return share, sibling_row("minutes of quiet records", families)


def real_rows(spread: Spread) -> tuple[Row, ...]:
    """Return the rows of the real record's windows; none where it is not there."""
    if not real_record.RECORD.exists():
        return ()
    places = range(len(real_record.WINDOWS))
    runs = spread(sibling, [("real", every, k) for every in THINNED for k in places])
    families = [runs[k : k + len(places)] for k in range(0, len(runs), len(places))]
    return (sibling_row("windows of the real record", families),)


def measure(seeds: Sequence[int], spread: Spread = in_turn, limit: float = LIMIT) -> Result:
    """Identify the corpus, its halves, quiet minutes and the real record's windows."""
    tried = spread(partial(judged, limit=limit), [(s, part) for s in seeds for part in range(3)])
    halves = [tried[k + 1 : k + 3] for k in range(0, len(tried), 3)]
    few = seeds[: max(len(seeds) // 10, 1)]
    minutes = spread(partial(sibling, limit=limit), [("quiet", s, k) for s in few for k in (0, 1)])
    claim = (
        f"On {len(seeds)} records over the whole space (0.5 kg to 5 t, com 5 um to 5 mm below and "
        "above, spin to 300 deg/s, tilt to 30 deg, camera and gyro of 1 to 200 Hz, 3 s to 1 h), "
        "with every input wrong within its stated sd, no wrong number is stated firmly, and "
        "siblings agree within 3 sd or are refused."
    )
    rows = (*corpus_rows(tried[::3]), sibling_row("halves of a record", halves),
            *quiet_rows(minutes), *real_rows(spread))  # fmt: skip
    return Result("siblings", claim, rows)
