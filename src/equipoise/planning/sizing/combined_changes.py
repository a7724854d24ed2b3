"""The changes that meet a requirement together, where no single one does.

The best change is made first, and the best of what can then be better next. What limits the result
is so named in its order. A change that the others make superfluous is left out. It is a
combination that is sufficient, and the shortest of those that begin with the best change; a search
of all would take hundreds of budgets.
"""

from collections.abc import Callable, Iterable, Sequence

from equipoise.planning.sizing.budget import Budget, budget_of
from equipoise.planning.sizing.case import Case
from equipoise.planning.sizing.sensitivity import Bettered, Change, changes, what_to_buy

MOST = 3  # changes, chosen: more is another platform

Spread = Callable[[Callable[[Case], Budget], Sequence[Case]], Iterable[Budget]]


def combined(
    case: Case, required: float, best: Bettered, spread: Spread = map
) -> tuple[Bettered, ...]:
    """Return changes in the order in which they are made, each with the torque that it leaves.

    ``best`` is the single change that leaves least. They end when ``required`` (N m) is met, or
    with MOST; whether it is met is seen from the last.
    """
    found, now = (best,), made(case, best.name)
    while now is not None and len(found) < MOST and found[-1].torque > required:
        possible = list(changes(now))
        after = what_to_buy(possible, spread(budget_of, [each.case for each in possible]))[0]
        found, now = (*found, after), made(now, after.name)
    return found


def made(case: Case, name: str) -> Case | None:
    """Return the case with the change of this name; None: it cannot be made again."""
    chosen: Change | None = next((each for each in changes(case) if each.name == name), None)
    return None if chosen is None else chosen.case
