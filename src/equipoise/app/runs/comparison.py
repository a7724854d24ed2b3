"""A comparison of laws and methods: the request, and its run.

Time of a record is the processor's, so that other work on the machine does not count. Memory is
the peak of what Python and NumPy allocate meanwhile (``tracemalloc``), which slows the work down:
it is watched in a run of its own, before the timed one. What a process holds (``ru_maxrss``) would
mostly be libraries and compiled kernels, the same for every method, and never falls again.

Cannot see what compiled kernels allocate by themselves.
"""

import time
import tracemalloc
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields
from functools import partial

from equipoise.app.arguments.checks import one_of
from equipoise.app.engine.running import ALONE, Running
from equipoise.app.engine.spread import Spread, spread_over
from equipoise.app.runs.waiting import QUIET, Waiting
from equipoise.estimation.method_contract import Options
from equipoise.estimation.methods.registry import METHODS
from equipoise.model.arrays import Vector3
from equipoise.model.errors import InputError
from equipoise.model.law_card import LawCard
from equipoise.model.presentation import Plotted
from equipoise.model.testbed import Testbed
from equipoise.model.units import MM
from equipoise.procedure.balancing.balance import BalanceOptions
from equipoise.procedure.balancing.catalogue import CARDS
from equipoise.procedure.balancing.hold import FIRST_MOVES
from equipoise.procedure.balancing.run_law import check, lacking
from equipoise.study.compare_laws import Comparison, compared
from equipoise.study.compare_methods import MethodComparison, compared_methods
from equipoise.study.law_run import Task
from equipoise.study.method_record import Scene
from equipoise.study.method_run import Cost, Found, MethodTask

WEIGHED = 2  # records, chosen: memory hardly changes from one to the next


@dataclass(frozen=True, slots=True, eq=False)
class LawGoal:
    """What laws are to reach, and within what."""

    target: Vector3  # m
    tolerance: Vector3  # m
    tilt: float  # rad, torque counts over directions within it of level
    required: float  # N m, rms over that range
    max_time: float  # s, of each run


@dataclass(frozen=True, slots=True, eq=False)
class Names:
    """Which methods and laws are compared; of a kind that is not compared, none."""

    methods: tuple[str, ...] | None
    laws: Sequence[LawCard] | None


@dataclass(frozen=True, slots=True, eq=False)
class Contest:
    """What is compared, on what, and by what it is judged."""

    names: Names
    scene: Scene  # of the recordings for methods; its testbed is that of the laws, too
    seeds: range
    goal: LawGoal


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Compared(Plotted):
    """What was compared; None: not requested."""

    testbed: Testbed
    requested: Mapping[str, str]
    methods: MethodComparison | None
    laws: Comparison | None


def names_of(testbed: Testbed, only: Sequence[str], methods: bool, laws: bool) -> Names:
    """Return what is to be compared; InputError for nothing, and for what cannot be."""
    if not (methods or laws):
        raise InputError("compare", "nothing to compare", "--methods or --laws")
    of_methods, of_laws = by_kind(only, methods, laws)
    return Names(
        chosen_methods(of_methods) if methods else None,
        chosen(testbed, of_laws) if laws else None,
    )


def run_all(contest: Contest, running: Running = ALONE, waiting: Waiting = QUIET) -> Compared:
    """Return methods compared on the scene's recordings, and laws on the same platforms."""
    scene, names, measured, balanced = contest.scene, contest.names, None, None
    with running.engine() as pool:
        if names.methods is not None:
            kept = running.kept("methods", question_of_methods(scene, names.methods), method_key)
            spread = spread_over(pool, partial(waiting.many, "estimating"), kept)
            measured = run_methods(scene, names.methods, contest.seeds, spread)
        if names.laws is not None:
            kept = running.kept("laws", question_of_laws(contest), law_key)
            spread = spread_over(pool, partial(waiting.many, "balancing"), kept)
            balanced = run(contest, names.laws, spread)
    return Compared(scene.testbed, texts_of(contest), measured, balanced)


def texts_of(contest: Contest) -> dict[str, str]:
    """Return the request, as the report has it."""
    scene, seeds, goal = contest.scene, contest.seeds, contest.goal
    moves = ", ".join(
        f"{t:g}: " + " ".join(f"{name}={d / MM:.6g}" for name, d in targets.items())
        for t, targets in scene.moves
    )
    return {
        "platforms": f"{len(seeds)}, seeds {seeds[0]} to {seeds[-1]}",
        "records": f"{scene.duration:g} s; moves: {moves or 'none'}",
        "laws": f"{goal.max_time:g} s at most, {goal.required:g} N m required",
    }


def chosen(testbed: Testbed, only: Sequence[str]) -> list[LawCard]:
    """Return the laws to run; InputError for one that is unknown or lacks a device, or for none."""
    able = [card for card in CARDS.values() if not lacking(card, testbed)]
    if not able:
        found = "a testbed with the devices of none of the laws"
        raise InputError(testbed.name, found, "the devices that `equipoise laws` lists")
    if not only:
        return able
    cards = [CARDS[one_of("--only", name, list(CARDS))] for name in only]
    for card in cards:
        check(card, testbed)
    return cards


def chosen_methods(only: Sequence[str]) -> tuple[str, ...]:
    """Return the methods to run, all when none is named; InputError for one that is unknown."""
    return tuple(one_of("--only", name, list(METHODS)) for name in only) or tuple(METHODS)


def by_kind(only: Sequence[str], methods: bool, laws: bool) -> tuple[list[str], list[str]]:
    """Return the names of methods and of laws among those given, one by one or with commas.

    InputError for a name that neither of the kinds has that are compared.
    """
    names = [name.strip() for words in only for name in words.split(",")]
    known = [*(METHODS if methods else ()), *(CARDS if laws else ())]
    for name in names:
        one_of("--only", name, known)
    return [n for n in names if methods and n in METHODS], [n for n in names if n in CARDS]


def method_key(task: MethodTask) -> str:
    """Return what the methods on one record are known by."""
    return f"seed {task.seed}"


def law_key(task: Task) -> str:
    """Return what a law on one platform is known by."""
    return f"{task.law}, seed {task.seed}"


def question_of_methods(scene: Scene, methods: tuple[str, ...]) -> dict[str, object]:
    """Return what the results of a seed rest on beside it."""
    return {
        "methods": methods,
        "testbed": scene.testbed,
        "duration": scene.duration,
        "moves": scene.moves,
        "options": stated(scene.options),
    }


def question_of_laws(contest: Contest) -> dict[str, object]:
    """Return what the result of a law and a seed rests on beside them."""
    return {
        "testbed": contest.scene.testbed,
        "options": stated(law_options(contest)),
        "max_time": contest.goal.max_time,
        "tilt": contest.goal.tilt,
    }


def stated(options: Options | BalanceOptions) -> Mapping[str, object]:
    """Return options as a question has them: of a budget only how long it is."""
    found = {each.name: getattr(options, each.name) for each in fields(options)}
    return found | {"budget": options.budget.begin}


def law_options(contest: Contest) -> BalanceOptions:
    """Return how each law balances."""
    goal, budget = contest.goal, contest.scene.options.budget
    return BalanceOptions(goal.target, goal.tolerance, FIRST_MOVES, goal.max_time, budget=budget)


def run(contest: Contest, cards: Sequence[LawCard], spread: Spread) -> Comparison:
    """Return the comparison of laws; runs of one platform by all laws follow each other."""
    goal, testbed, options = contest.goal, contest.scene.testbed, law_options(contest)
    tasks = [
        Task(card.name, testbed, seed, options, goal.max_time, goal.tilt)
        for seed in contest.seeds
        for card in cards
    ]
    return compared(tasks, cards, goal.required, spread)


def run_methods(
    scene: Scene,
    methods: tuple[str, ...],
    seeds: Sequence[int],
    spread: Spread,
) -> MethodComparison:
    """Return the comparison; memory is measured on the first records, whoever computes them.

    A process that does so has loaded its compiled kernels before it measures times.
    """
    tasks = [
        MethodTask(scene, methods, seed, metered, weighed=k < WEIGHED)
        for k, seed in enumerate(seeds)
    ]
    return compared_methods(tasks, spread)


def metered(work: Callable[[], Found], weighed: bool) -> tuple[Found, Cost]:
    """Return what work gives, and what it takes; its memory if it is to be ``weighed``."""
    memory = peak(work) if weighed else None
    start = time.process_time()
    found = work()
    return found, Cost(time.process_time() - start, memory)


def peak(work: Callable[[], object]) -> int:
    """Return by how many bytes the memory of Python and NumPy grows at most during work."""
    tracemalloc.start()
    try:
        work()
        return tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
