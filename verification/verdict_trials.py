"""A trial of every verdict of the package that can pass: what it says, and whether that is true.

A trial is named by the module that gives the verdict. Which modules do is found in the source
(``judging_modules``): each that names a criterion of ``model.criterion``, or takes the verdict on a
centre of mass from ``procedure.steps.verify``. One without a trial here is an error.

Each trial is a use as a laboratory has it, with records that can decide: long enough, and with
moves of known masses where the scale matters. ``verdicts`` judges records that cannot, too.
"""

import ast
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from functools import cache, partial
from pathlib import Path
from typing import NamedTuple

import numpy as np

import equipoise
from equipoise.dynamics.sag_trim import residual_torque
from equipoise.io.testbed.presets import read_preset
from equipoise.model import criterion
from equipoise.model.criterion import BALANCED as CENTRED
from equipoise.model.criterion import DESIGN, HELD, OFFSET, TORQUE, Criterion, VerdictOutcome
from equipoise.model.recording import Recording, join
from equipoise.planning.sizing.budget import Budget, budget_of, mean_square
from equipoise.planning.sizing.expected_torque import expected_torque
from equipoise.planning.sizing.limits import ENOUGH
from equipoise.planning.sizing.limits import verdict as design_verdict
from equipoise.procedure.identification.assess import (
    AssessOptions,
    answers_of,
    bounds_of,
    fit_of,
    pull_of,
)
from equipoise.procedure.steps.tilt_guard import guarded
from equipoise.simulation.bench import SimulatedBench
from equipoise.study.law_run import law_run
from verification import balanced, drift, laws, manual
from verification.design_predictions import TILT, beds, case_of, chain

LAW = "slew_and_measure"
HOLD = 300.0  # s
PART = 60.0  # s, of a record of an assessment; there are three
DEPTH = 0.04  # m, by which masses go down in the second
LIMITS = (1e-4, 3e-3)  # N m, chosen: from three times the floor of such a record
ASIDE = 0.1  # of its height, chosen: one that hangs leaning by more swings beyond its tilt limit
MULTIPLES = (0.2, 5.0)  # of what is required, the truth
CHAINS = 200  # platforms, by which a design is judged


class Judged(NamedTuple):
    """One verdict."""

    outcome: VerdictOutcome
    true: bool  # what it would claim by passing


def balance(seed: int) -> Judged:
    """Balance the preset sputnix."""
    run = balanced.balanced(seed)
    return Judged(run.outcome, run.good)


def law(seed: int) -> Judged:
    """Let a law balance the preset reference-table, and swing for the proof."""
    (task,) = laws.tasks_of((LAW,), [seed])
    run = law_run(task)
    return Judged(run.verdict.outcome, bool(np.all(np.abs(run.offset) <= task.options.tolerance)))


def by_hand(seed: int) -> Judged:
    """Balance the preset weights-by-hand."""
    run = manual.placed(seed)
    return Judged(run.outcome, run.within)


def hold(seed: int) -> Judged:
    """Balance and hold a platform that drifts; the truth at every second counts."""
    run = drift.held(HOLD, seed).run
    return Judged(run.outcome, run.well)


def log_uniform(rng: np.random.Generator, ends: tuple[float, float]) -> float:
    """Return a number whose logarithm is uniform."""
    low, high = np.log(ends)
    return float(np.exp(rng.uniform(low, high)))


def hanging_record(bench: SimulatedBench) -> Recording:
    """Return a record with a known move down and back, by which the scale is known."""
    goals = {m.name: -DEPTH * m.axis[2] for m in bench.testbed.masses if abs(m.axis[2]) > 0.5}
    parts = [guarded(bench, PART)]
    for share in (1.0, 0.0):
        bench.move({name: share * goal for name, goal in goals.items()})
        parts.append(guarded(bench, PART))
    return join(join(parts[0], parts[1]), parts[2])


def requirement(criterion_of: Criterion, seed: int) -> Judged:
    """Assess a hanging platform that is a drawn multiple of what is required off."""
    rng, bed = np.random.default_rng([78, seed]), read_preset("sputnix")
    assert bed.truth is not None
    way = np.append(ASIDE * rng.normal(size=2), -1.0)
    way /= np.linalg.norm(way)
    limit, multiple = log_uniform(rng, LIMITS), log_uniform(rng, MULTIPLES)
    tilt = AssessOptions().tilt

    def torque(com: np.ndarray) -> float:
        return bed.weight * residual_torque(com, np.zeros((3, 3)), bed.up, tilt)

    size = multiple * limit / torque(way)
    bed = replace(bed, truth=replace(bed.truth, com=size * way))
    bench = SimulatedBench(bed, seed)
    requested = AssessOptions(require_torque=limit, require_offset=size / multiple)
    estimate, spread = fit_of(hanging_record(bench), bed, requested)
    found = answers_of(requested, *bounds_of(requested, pull_of(*spread), bed))
    com = bench.truth().com
    true = (torque(com) <= limit, bool(np.linalg.norm(com) <= size / multiple))
    k = (TORQUE, OFFSET).index(criterion_of)
    return Judged(
        found[k].outcome if estimate.outcome.usable else VerdictOutcome.UNDECIDED, true[k]
    )


@cache
def designed(which: int) -> tuple[float, Budget]:
    """Return the torque (N m) that a testbed's platforms are left with, and its budget."""
    bed = beds()[which]
    one, two = budget_of(replace(case_of(bed), moves=1)), budget_of(case_of(bed))
    measurements = (one.last.com, mean_square(one.standing.error), two.last.com)
    left = np.array([chain(bed, measurements, seed).last for seed in range(CHAINS)])
    others = two.torque**2 - expected_torque(bed, mean_square(two.standing.error), TILT) ** 2
    found = expected_torque(bed, mean_square(left), TILT) ** 2 + max(others, 0.0)
    return float(np.sqrt(found)), two


def design(seed: int) -> Judged:
    """Design with a requirement; platforms balanced in simulation are what is true."""
    left, budget = designed(seed % len(beds()))
    required = left / log_uniform(np.random.default_rng([79, seed]), MULTIPLES)
    good = left <= required and budget.within >= ENOUGH
    return Judged(design_verdict(budget, required, ()).outcome, good)


class Trial(NamedTuple):
    """A verdict and its use."""

    criterion: Criterion
    judge: Callable[[int], Judged]
    cost: int = 1  # one in so many of the seeds is tried


TRIALS: Mapping[str, Trial] = {
    "procedure.balancing.balance": Trial(CENTRED, balance),
    "procedure.steps.swing_verdict": Trial(CENTRED, law, 5),
    "procedure.balancing.balance_manually": Trial(CENTRED, by_hand, 2),
    "procedure.balancing.hold_verdict": Trial(HELD, hold, 10),
    "procedure.identification.requirement, torque": Trial(TORQUE, partial(requirement, TORQUE)),
    "procedure.identification.requirement, offset": Trial(OFFSET, partial(requirement, OFFSET)),
    "planning.sizing.limits": Trial(DESIGN, design),
}
PROVEN_BY = {"verdict", "judged"}  # of ``procedure.steps.verify``


def judging_modules() -> frozenset[str]:
    """Return the modules of the package that give a verdict which can pass."""
    root = Path(equipoise.__file__).parent
    return frozenset(
        ".".join(path.relative_to(root).with_suffix("").parts)
        for path in root.rglob("*.py")
        if any(judges(node) for node in ast.walk(ast.parse(path.read_text("utf-8"))))
    ) - {"model.verdict", "procedure.steps.verify"}


def judges(node: ast.AST) -> bool:
    """Say whether an import is of a criterion, or of the verdict on a centre of mass."""
    if not isinstance(node, ast.ImportFrom) or node.module is None:
        return False
    names = {alias.name for alias in node.names}
    if node.module.endswith("model.criterion"):
        return bool(names & set(named_criteria()))
    return node.module.endswith("steps.verify") and bool(names & PROVEN_BY)


def named_criteria() -> Iterator[str]:
    """Yield the names of the criteria in ``model.criterion``, and of the list of all."""
    for name, value in vars(criterion).items():
        if isinstance(value, Criterion) or value is criterion.CRITERIA:
            yield name
