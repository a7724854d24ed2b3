"""What laws and methods are compared by, as it is asked for, and the comparison carried out."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from equipoise.app.arguments.checks import one_of
from equipoise.app.console.process_pool import spread_over
from equipoise.app.runs.resource_use import metered
from equipoise.control.law import LawCard
from equipoise.estimation.methods.registry import METHODS
from equipoise.model.arrays import Vector3
from equipoise.model.errors import InputError
from equipoise.model.testbed import Testbed
from equipoise.procedure.balancing.balance import BalanceOptions
from equipoise.procedure.balancing.catalogue import CARDS
from equipoise.procedure.balancing.hold import FIRST_MOVES
from equipoise.procedure.balancing.run_law import check, lacking
from equipoise.study.compare_laws import Comparison, compared
from equipoise.study.compare_methods import MethodComparison, compared_methods
from equipoise.study.law_run import Task
from equipoise.study.method_record import Scene
from equipoise.study.method_run import MethodTask

DEG = math.pi / 180


@dataclass(frozen=True, slots=True, eq=False)
class Request:
    """Which laws are to be compared, and how."""

    testbed: Testbed
    cards: Sequence[LawCard]
    seeds: Sequence[int]
    target: Vector3  # m
    tolerance: Vector3  # m
    tilt_deg: float
    required: float  # N m
    max_time: float  # s


def chosen(testbed: Testbed, only: Sequence[str]) -> list[LawCard]:
    """Return the laws to run; InputError for one that is unknown or lacks a device, or for none."""
    able = [card for card in CARDS.values() if not lacking(card, testbed)]
    if not able:
        found = "a testbed that has the devices for none of the laws"
        raise InputError(testbed.name, found, "what `equipoise laws` says that they need")
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


def run(requested: Request, workers: int) -> Comparison:
    """Return the comparison; runs of one platform by all laws come one after the other."""
    options = BalanceOptions(requested.target, requested.tolerance, FIRST_MOVES, requested.max_time)
    tilt = requested.tilt_deg * DEG
    tasks = [
        Task(card.name, requested.testbed, seed, options, requested.max_time, tilt)
        for seed in requested.seeds
        for card in requested.cards
    ]
    return compared(tasks, requested.cards, requested.required, spread_over(workers, "balancing"))


def run_methods(
    scene: Scene, methods: tuple[str, ...], seeds: Sequence[int], workers: int
) -> MethodComparison:
    """Return the comparison; memory is measured on as many records as there are processes.

    So most processes have loaded their compiled kernels before they measure times.
    """
    tasks = [
        MethodTask(scene, methods, seed, metered, weighed=k < workers)
        for k, seed in enumerate(seeds)
    ]
    return compared_methods(tasks, spread_over(workers, "estimating"))
