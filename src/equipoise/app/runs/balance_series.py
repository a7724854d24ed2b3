"""A series of balancings of one simulated platform: how many end well, and where they leave it."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

from equipoise.app.engine.spread import IN_TURN, Spread
from equipoise.app.runs.balancing import Balancing, Goal, Limits, run
from equipoise.model.reasons.reason import one_reason
from equipoise.model.reasons.verdict_reasons import VerdictReason
from equipoise.model.testbed import Testbed
from equipoise.model.verdict import Verdict
from equipoise.simulation.carried_out import bench_for
from equipoise.simulation.series import seeds_of, with_drawn_platform


@dataclass(frozen=True, slots=True, eq=False)
class BalancedSeries:
    """What was done in each run."""

    testbed: Testbed
    goal: Goal
    law: str
    runs: Sequence[Balancing]

    @property
    def verdict(self) -> Verdict:
        """Return whether every run passed."""
        failed = tuple(str(k) for k, done in enumerate(self.runs, 1) if not done.verdict.passed)
        code = VerdictReason.SOME_RUNS_FAILED if failed else VerdictReason.EVERY_RUN_PASSED
        return Verdict(one_reason(code, *failed, count=len(self.runs), failed=len(failed)))


def run_series(
    testbed: Testbed,
    goal: Goal,
    limits: Limits,
    seeds: tuple[int, int],
    spread: Spread = IN_TURN,
) -> BalancedSeries:
    """Balance the platform that the first seed draws; ``seeds``: how many runs, the first seed."""
    balanced = partial(one_run, with_drawn_platform(testbed, seeds[1]), goal, limits)
    return BalancedSeries(testbed, goal, limits.law, list(spread(balanced, seeds_of(*seeds))))


def one_run(platform: Testbed, goal: Goal, limits: Limits, seed: int) -> Balancing:
    """Balance a platform once; the seed draws noise and start."""
    return run(bench_for(platform, limits.plan, seed), goal, limits, None)
