"""Which unknowns several records of one platform share, and where each record keeps them.

Shared are the inertia and the centre of mass, and what belongs to the bench: its sensors' errors
and its drives'. A record keeps its own start, bias, torques, and where its masses stopped. A prior
on what is shared counts once, however many records there are: that a camera leans is one error, and
twenty records do not average it.

Shared coordinates x are physical ones, J_P (6) and com (3) first.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from equipoise.actuators.mass_errors import is_of_drive
from equipoise.estimation.events.record_model import RecordModel
from equipoise.estimation.output_error.problem import Prior, Problem, prior_of
from equipoise.estimation.output_error.solution import Fitted
from equipoise.estimation.output_error.trajectory import held_names
from equipoise.estimation.parameters.fit_parameters import (
    Layout,
    Unknowns,
    physical,
    unknowns_of,
)
from equipoise.estimation.parameters.retraction import retract
from equipoise.model.arrays import Floats, Ints
from equipoise.model.estimate import BODY
from equipoise.model.testbed import Testbed

BODIES = slice(0, 9)  # J_P and com among what is shared
COM = slice(6, 9)


def shared_names(layouts: Sequence[Layout]) -> tuple[str, ...]:
    """Return what records with these unknowns share, each once."""
    of_bench = [
        name for layout in layouts for name in (*layout.sensor, *filter(is_of_drive, layout.errors))
    ]
    return tuple(dict.fromkeys((*BODY, *of_bench)))


@dataclass(frozen=True, slots=True, eq=False)
class Place:
    """Where a record keeps what it shares, and what it keeps for itself."""

    own: Ints  # coordinates of the record
    shared: Ints  # where each of these stands among all that is shared
    private: Ints  # the record's other coordinates

    def spread(self, size: int, of_own: Floats) -> Floats:
        """Return values of the record's share among all that is shared, zero elsewhere."""
        out = np.zeros(size)
        out[self.shared] = of_own
        return out


def place_of(layout: Layout, names: tuple[str, ...]) -> Place:
    """Return the place of what is shared in a layout."""
    known = {name: k for k, name in enumerate(layout.names)}
    shared = [j for j, name in enumerate(names) if name in known]
    own = [known[names[j]] for j in shared]
    private = np.setdiff1d(np.arange(layout.size), own)
    return Place(np.array(own), np.array(shared), private)


@dataclass(frozen=True, slots=True, eq=False)
class Record:
    """A record in a joint fit: its problem with what is shared free, and where it stands."""

    problem: Problem  # without a prior on what is shared
    place: Place
    weight: float  # of its cost: 1 / (how much wider its intervals are than its noise says)^2
    fitted: Fitted  # at the optimum of what is private; the local model has all coordinates

    def values(self, size: int) -> Floats:
        """Return what is shared as the record has it, zero for what it does not have."""
        layout = self.problem.layout
        x = physical(self.fitted.point, self.problem.mass, layout)
        return self.place.spread(size, x[self.place.own])


@dataclass(frozen=True, slots=True, eq=False)
class Shared:
    """What all records share, and what is known of it otherwise."""

    names: tuple[str, ...]
    units: tuple[str, ...]
    prior: Prior
    scale_open: bool  # in every record: one moment is held for the search

    @property
    def size(self) -> int:
        """Return the number of coordinates."""
        return len(self.names)


def without_shared(prior: Prior, place: Place) -> Prior:
    """Return a record's prior without what it says of shared coordinates, all free."""
    weight, anchor, held = prior.weight.copy(), prior.anchor.copy(), prior.held.copy()
    weight[place.own], anchor[place.own], held[place.own] = 0.0, 0.0, False
    return replace(prior, weight=weight, anchor=anchor, held=held)


def freed(model: RecordModel, names: tuple[str, ...]) -> tuple[Problem, Place]:
    """Return the problem of a record whose shared unknowns are free, and their place."""
    problem = model.fitted.problem
    place = place_of(problem.layout, names)
    prior = without_shared(problem.prior, place)
    return replace(problem, prior=prior, scale_open=False), place


def keeping(problem: Problem, place: Place) -> Problem:
    """Return the problem of a record whose shared unknowns stay where they are."""
    held = problem.prior.held.copy()
    held[place.own] = True
    return replace(problem, prior=replace(problem.prior, held=held))


def shared_of(models: Sequence[RecordModel], testbed: Testbed) -> Shared:
    """Return what the records share; ``testbed`` has what is known of the body beforehand.

    The scale is open, and one moment held, where no record fixes it.
    """
    layouts = [model.fitted.problem.layout for model in models]
    names = shared_names(layouts)
    scale_open = all(model.fitted.problem.scale_open for model in models)
    mean, weight, anchor = np.zeros((3, len(names)))
    held, units = np.zeros(len(names), dtype=bool), dict[str, str]()
    for model, layout in zip(models, layouts, strict=True):
        hold = model.params.hold
        if scale_open:
            hold = held_names(model.recording, testbed, model.params)
        errors, use_prior = model.fitted.problem.errors, model.params.use_prior
        prior, place = prior_of(testbed, errors, layout, use_prior, hold), place_of(layout, names)
        for whole, part in zip(
            (mean, weight, anchor, held),
            (prior.mean, prior.weight, prior.anchor, prior.held),
            strict=True,
        ):
            whole[place.shared] = part[place.own]
        units |= dict(zip(layout.names, layout.units, strict=True))
    kept = tuple(units[name] for name in names)
    return Shared(names, kept, Prior(mean, weight, anchor, held), scale_open)


def placed(record: Record, point: Unknowns, x: Floats) -> Unknowns:
    """Return a point with what is shared at x."""
    problem, place = record.problem, record.place
    now = physical(point, problem.mass, problem.layout)
    step = np.zeros(problem.layout.size)
    step[place.own] = x[place.shared] - now[place.own]
    return stepped(problem, point, step)


def stepped(problem: Problem, point: Unknowns, step: Floats) -> Unknowns:
    """Return the point after a step in the physical coordinates of a record."""
    flat = point.flat
    out = np.empty_like(flat)
    retract(flat, step, problem.mass, problem.layout.slots, out)
    return unknowns_of(out)
