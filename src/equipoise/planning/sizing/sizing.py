"""A whole design: reach, steps, records of several lengths, budget, limits, and what to buy.

The budget and its possible improvements are those of the shortest record; the others stand beside.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from equipoise.model.presentation import Plotted
from equipoise.model.verdict import Verdict
from equipoise.planning.sizing.budget import Budget, budget_of
from equipoise.planning.sizing.case import Case
from equipoise.planning.sizing.limits import limit_sentence, reach_sentence, verdict
from equipoise.planning.sizing.mass_steps import MassStep, mass_steps
from equipoise.planning.sizing.reachable_set import Reach, reach_of
from equipoise.planning.sizing.sensitivity import Bettered, what_to_buy


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Sizing(Plotted):
    """The result for the masses and sensors of a testbed."""

    case: Case
    required: float | None  # N m
    reach: Reach
    steps: tuple[MassStep, ...]
    budgets: tuple[Budget, ...]  # for each length of record; the first is the one judged
    better: tuple[Bettered, ...]  # the best first
    reached: str
    limit: str
    verdict: Verdict

    @property
    def budget(self) -> Budget:
        """Return the budget that is judged."""
        return self.budgets[0]


def sized(case: Case, records: Sequence[float], required: float | None) -> Sizing:
    """Return the design of a case, for records of several lengths (s)."""
    cases = [replace(case, measurement_time=length) for length in sorted(records)]
    budgets = tuple(budget_of(each) for each in cases)
    judged, better = cases[0], what_to_buy(cases[0])
    reach = reach_of(case.testbed.masses, case.testbed.body.mass)
    return Sizing(
        judged,
        required,
        reach,
        mass_steps(case.testbed, case.tilt),
        budgets,
        better,
        reach_sentence(reach, budgets[0].within),
        limit_sentence(judged, budgets[0], better),
        verdict(budgets[0], required, better),
    )
