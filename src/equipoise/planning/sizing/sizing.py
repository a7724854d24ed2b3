"""A whole design: reach, steps, records of several lengths, budget, limits, and what to buy.

The budget and its possible improvements are those of the shortest record; the others stand beside.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from equipoise.model.presentation import Plotted
from equipoise.model.verdict import Verdict
from equipoise.planning.sizing.budget import Budget, budget_of
from equipoise.planning.sizing.case import Case
from equipoise.planning.sizing.combined_changes import Spread, combined
from equipoise.planning.sizing.limits import limit_sentence, reach_sentence, verdict
from equipoise.planning.sizing.mass_steps import MassStep, mass_steps
from equipoise.planning.sizing.reachable_set import Reach, reach_of
from equipoise.planning.sizing.sensitivity import Bettered, changes, what_to_buy


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Sizing(Plotted):
    """The result for the masses and sensors of a testbed."""

    case: Case
    required: float | None  # N m
    reach: Reach
    steps: tuple[MassStep, ...]
    budgets: tuple[Budget, ...]  # for each length of record; the first is the one judged
    better: tuple[Bettered, ...]  # the best first
    together: tuple[Bettered, ...]  # in their order, where one is not enough
    reached: str
    limit: str
    verdict: Verdict

    @property
    def budget(self) -> Budget:
        """Return the budget that is judged."""
        return self.budgets[0]


def sized(
    case: Case, records: Sequence[float], required: float | None, spread: Spread = map
) -> Sizing:
    """Return the design of a case, for records of several lengths (s).

    ``spread`` computes budgets, none of which rests on another.
    """
    cases = [replace(case, measurement_time=length) for length in sorted(records)]
    judged, possible = cases[0], list(changes(cases[0]))
    found = list(spread(budget_of, [*cases, *(change.case for change in possible)]))
    budgets, better = found[: len(cases)], what_to_buy(possible, found[len(cases) :])
    together: tuple[Bettered, ...] = ()
    if required is not None and required < min(budgets[0].torque, better[0].torque):
        together = combined(judged, required, better[0], spread)
    reach = reach_of(case.testbed.masses, case.testbed.body.mass)
    return Sizing(
        judged,
        required,
        reach,
        mass_steps(case.testbed, case.tilt),
        tuple(budgets),
        better,
        together,
        reach_sentence(reach, budgets[0].within),
        limit_sentence(judged, budgets[0], better),
        verdict(budgets[0], required, better, together),
    )
