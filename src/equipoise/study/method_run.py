"""One method on one simulated record, judged by the truth.

    e       estimate - truth, of com (3) and inertia_P (6)
    z       e / sd, where the method states an sd
    NEES    e^T P^-1 e / n over what it states, P its covariance: 1 on average if P is true

A method that states the centre of mass only as the masses stand at the end is judged by that. What
it takes as known it does not state. An estimate that the method itself calls unusable is a failure,
as is a refusal, or an end in an error.

    settled   of a method that goes along the record: the time from which on its error of com is
              below a tenth (``SETTLED``) of that of the testbed's guess; infinite: never

Time and memory are measured by what the caller hands in: no clock belongs here.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np

from equipoise.estimation.method_contract import Method, estimated
from equipoise.estimation.methods.registry import METHODS
from equipoise.model.arrays import Floats
from equipoise.model.errors import EquipoiseError
from equipoise.model.estimate import COM, END, INERTIA, Estimate
from equipoise.model.reasons.reason import sentence_of
from equipoise.study.method_families import FAMILY, RECURSIVE
from equipoise.study.method_record import JudgedRecord, Scene, judged_record

Ending = Literal["done", "refused", "unusable", "broke"]
MAIN = 2  # reasons of a failure that a table has room for; chosen
SETTLED = 0.1  # of the error of the first guess, chosen
JUDGED = (*COM, *INERTIA)
HELD = 1e-9  # of the value, chosen: an sd below this share is none, the value was held


@dataclass(frozen=True, slots=True)
class Failure:
    """Why a method gave nothing: it refused, or ended in an error."""

    ending: Ending
    why: str


@dataclass(frozen=True, slots=True)
class Cost:
    """What a run took."""

    time: float  # s of the processor
    memory: int | None  # bytes at the peak beyond what was there; None: not measured


Found = Estimate | Failure
Meter = Callable[[Callable[[], Found], bool], tuple[Found, Cost]]


@dataclass(frozen=True, slots=True, eq=False)
class MethodRun:
    """What a run came to. Arrays are in the order of ``JUDGED``; nan: not stated."""

    method: str
    seed: int
    ending: Ending
    sentence: str
    warned: bool
    error: Floats  # SI
    sd: Floats  # SI
    bound: Floats  # SI; infinite: the record does not show it, nan: it was held
    nees: float  # per parameter
    settled: float | None  # s from the record's beginning
    cost: Cost
    why: str = ""  # of what failed: the main reasons, for a person
    met_stop: bool = False  # the record's platform did

    @property
    def stated(self) -> bool:
        """Say whether intervals were stated without a warning."""
        return self.ending == "done" and not self.warned and bool(np.any(np.isfinite(self.sd)))


@dataclass(frozen=True, slots=True, eq=False)
class MethodTask:
    """All methods on the record of one seed."""

    scene: Scene
    methods: tuple[str, ...]
    seed: int
    meter: Meter
    weighed: bool  # memory is measured, too


def method_runs(task: MethodTask) -> list[MethodRun]:
    """Return what methods make of one record."""
    record = judged_record(task.scene, task.seed)
    return [method_run(METHODS[name], record, task) for name in task.methods]


def method_run(method: Method, record: JudgedRecord, task: MethodTask) -> MethodRun:
    """Return what one method makes of a record."""
    found, cost = task.meter(lambda: tried(method, record), task.weighed)
    return judged(method.card.name, task.seed, found, record, cost)


def tried(method: Method, record: JudgedRecord) -> Found:
    """Return the estimate, or why there is none.

    A method that ends in an unexpected error is counted and reported: it does not cost the rest of
    a comparison of hours.
    """
    try:
        found = estimated(method, record.recording, record.testbed, record.options)
    except EquipoiseError as refused:
        return Failure("refused", str(refused))
    except Exception as error:  # whatever a method may raise
        return Failure("broke", f"{type(error).__name__}: {error}")
    return found if found.parameters else Failure("refused", found.outcome.sentence)


def judged(method: str, seed: int, found: Found, record: JudgedRecord, cost: Cost) -> MethodRun:
    """Return what was found beside the truth."""
    names = names_in(found)
    bound = np.array([record.bound.get(name, np.nan) for name in names])
    nothing = np.full(len(JUDGED), np.nan)
    if isinstance(found, Failure):
        return MethodRun(method, seed, found.ending, found.why, False, nothing, nothing, bound,
                         np.nan, None, cost, found.why, record.met_stop)  # fmt: skip
    ending: Ending = "done" if found.outcome.usable else "unusable"
    error, sd = nothing.copy(), nothing.copy()
    for k, name in enumerate(names):
        if states(found, name):
            p = found.parameters[found.index(name)]
            error[k], sd[k] = p.value - record.truth[name], p.sd
    reported = tuple(name for name, e in zip(names, error, strict=True) if np.isfinite(e))
    return MethodRun(
        method, seed, ending, found.outcome.sentence, found.outcome.warns, error, sd, bound,
        nees(found, reported, error[np.isfinite(error)]), settled(found, record), cost,
        sentence_of(found.outcome.reasons[:MAIN]), record.met_stop,
    )  # fmt: skip


def names_in(found: Found) -> tuple[str, ...]:
    """Return by which names an estimate is judged: com at home, or else at the end."""
    at_end = isinstance(found, Estimate) and found.has(END[0]) and not found.has(COM[0])
    return (*(END if at_end else COM), *INERTIA)


def states(found: Estimate, name: str) -> bool:
    """Say whether a parameter was sought and observable."""
    if not found.has(name):
        return False
    p = found.parameters[found.index(name)]
    return p.observable and bool(np.isfinite(p.sd)) and p.sd > HELD * abs(p.value)


def nees(found: Estimate, names: tuple[str, ...], error: Floats) -> float:
    """Return e^T P^-1 e / n, nan where nothing is stated or P is singular."""
    if not names:
        return np.nan
    covariance = found.covariance_of(names)
    sd = np.sqrt(np.diag(covariance))
    z = error / sd
    try:
        return float(z @ np.linalg.solve(covariance / np.outer(sd, sd), z)) / len(names)
    except np.linalg.LinAlgError:
        return np.nan


def settled(found: Estimate, record: JudgedRecord) -> float | None:
    """Return from when on com was near the truth, s; None for a method that does not go along."""
    course = found.course
    if course is None or FAMILY[found.method] not in RECURSIVE or not {*COM} <= {*course.names}:
        return None
    where = [course.names.index(name) for name in COM]
    true = np.array([record.truth[name] for name in COM])
    distance = np.linalg.norm(course.values[:, where] - true, axis=1)
    first = float(np.linalg.norm(record.testbed.body.com - true))
    outside = np.flatnonzero(~(distance <= SETTLED * first))
    if not len(outside):
        return 0.0
    late = int(outside[-1]) + 1
    return float(course.t[late] - record.recording.span[0]) if late < len(distance) else np.inf
