"""One balancing in two levels: weights by hand, then sliding masses; simulated, or a person's."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

from equipoise.app.bench.bench_proxy import RecordedBench
from equipoise.app.runs import balancing, manual_balancing
from equipoise.app.runs.balancing import Balancing, Goal, Limits, procedure, until_stopped
from equipoise.app.runs.manual_balancing import ByHand, Filed, Show, command_of, options_of
from equipoise.app.runs.terminal_balancing import at_terminal
from equipoise.model.arrays import Ints
from equipoise.model.bench import Bench
from equipoise.model.step import Step
from equipoise.model.testbed import Testbed
from equipoise.model.verdict import Verdict
from equipoise.procedure.balancing.hands_then_masses import hands_then_masses, within_reach
from equipoise.simulation.hands import SimulatedHands

NEXT = "Leave every weight in place and switch the bench on. Then:"


@dataclass(frozen=True, slots=True, eq=False)
class InTwoLevels:
    """What was done so far, the aim of all of it, and what the masses did, once they have."""

    by_hand: ByHand  # ended only where the hands gave up: else the last word is of the masses
    goal: Goal
    by_masses: Balancing | None = None

    @property
    def known(self) -> Testbed | None:
        """Return the testbed as loaded by hand, once the masses can correct the rest."""
        steps = self.by_hand.balancing.steps
        return next((step.known for step in reversed(steps) if step.known is not None), None)

    @property
    def ended(self) -> bool:
        """Say whether the last word has been said."""
        return self.by_masses is not None or self.by_hand.ended

    @property
    def verdict(self) -> Verdict | None:
        """Return the last word, if it has been said."""
        return self.by_hand.verdict if self.by_masses is None else self.by_masses.verdict

    @property
    def steps(self) -> Sequence[Step]:
        """Return all steps; those of the masses are on their bench's clock."""
        more = () if self.by_masses is None else self.by_masses.steps
        return (*self.by_hand.balancing.steps, *more)


def run(hands: SimulatedHands, goal: Goal, limits: Limits, rounds: int, show: Show) -> InTwoLevels:
    """Balance a simulated platform, show each step as it comes."""
    benches: list[RecordedBench] = []

    def go_on(known: Testbed) -> Iterator[Step]:
        benches.append(RecordedBench(hands.released(known)))
        return until_stopped(benches[0], procedure(benches[0], goal, limits))

    steps = partial(hands_then_masses, go_on=go_on)
    done = manual_balancing.run(hands, goal, rounds, show, steps)
    whole, count = done.balancing, hand_steps(done.balancing.steps)
    first = replace(whole, goal=coarse(hands.testbed, goal, rounds), steps=whole.steps[:count],
                    truths=whole.truths[:count])  # fmt: skip
    by_hand = replace(done, balancing=first, ended=not benches)
    if not benches:
        return InTwoLevels(by_hand, goal)
    bench = benches[0]
    then = Balancing(bench.testbed, goal, whole.steps[count:], bench.recording(),
                     whole.truths[count - 1], whole.truths[count:], law=limits.law,
                     seed=hands.seed)  # fmt: skip
    return InTwoLevels(by_hand, goal, then)


def resume(filed: Filed, goal: Goal, show: Show) -> tuple[InTwoLevels, list[Ints]]:
    """Play the hands' part of a session back; return it, and what lies where since."""
    steps = partial(hands_then_masses, go_on=lambda _known: iter(()))
    done, placed = manual_balancing.resume(filed, goal, show, steps)
    aim = coarse(filed.testbed, goal, filed.session.max_rounds)
    found = InTwoLevels(replace(done, balancing=replace(done.balancing, goal=aim)), goal)
    if found.known is None:
        return found, placed
    return replace(found, by_hand=replace(found.by_hand, ended=False)), placed


def and_then(done: InTwoLevels, bench: Bench, limits: Limits, show: Show) -> InTwoLevels:
    """Let the masses of a bench go on, which is the platform as loaded."""
    through = at_terminal(bench.testbed)
    return replace(done, by_masses=balancing.run(bench, done.goal, limits, show, through))


def hand_steps(steps: Sequence[Step]) -> int:
    """Return how many of the steps are the hands'."""
    return next((k for k, step in enumerate(steps, 1) if step.known is not None), len(steps))


def coarse(testbed: Testbed, goal: Goal, rounds: int) -> Goal:
    """Return the aim of the hands."""
    return Goal(goal.target, within_reach(testbed, options_of(goal, rounds)).tolerance)


def next_deed(done: InTwoLevels, filed: Filed, session: Path, number: int) -> str:
    """Return what a person has to do next; nothing after the last word."""
    if done.known is not None:
        return f"{NEXT}\n  {command_of(filed, session, '--bench')}"
    return "" if done.ended else manual_balancing.next_deed(filed, session, number)
