"""What a method is: a card that says what to expect of it, and the estimator itself.

A method is a formulation (its model of the motion) times a solver. Every method takes the
same three things and gives the same record, so that lists, tests and studies need not know them.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from equipoise.estimation.search_budget import UNLIMITED, Budget
from equipoise.estimation.stays_at_stop import judged_by_stays
from equipoise.model.errors import InputError
from equipoise.model.estimate import Estimate
from equipoise.model.method_card import Card, Choice
from equipoise.model.outcome import outcome
from equipoise.model.reasons.reason import Code, Number
from equipoise.model.reasons.table_reasons import TableReason
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed
from equipoise.model.version import __version__

SURPRISED = 1.5  # chosen: times the expected square of innovations, beyond which nothing is usable


@dataclass(frozen=True, slots=True)
class Options:
    """What is asked of a method."""

    terms: tuple[str, ...] = ()  # torques and sensors' errors to estimate, beside the testbed's own
    hold: tuple[str, ...] = ()  # parameters kept at the testbed's value
    use_prior: bool = False  # the testbed's inertia and centre of mass, with their sd
    robust: bool = False  # outliers weigh less
    budget: Budget = UNLIMITED  # of the search


FIELDS: dict[Choice, str] = {
    "term": "terms",
    "hold": "hold",
    "prior": "use_prior",
    "robust": "robust",
}


@dataclass(frozen=True, slots=True)
class Method:
    """A card and its estimator."""

    card: Card
    run: Callable[[Recording, Testbed, Options], Estimate]
    on_table: bool = False  # whether its model has a bearing that moves over a table


def ignored(card: Card, options: Options) -> tuple[str, ...]:
    """Return the options that were asked for and that a method does not know."""
    requested = {name for name, field in FIELDS.items() if getattr(options, field)}
    return tuple(name for name in FIELDS if name in requested.difference(card.heeds))


def heeded(card: Card, options: Options) -> Options:
    """Return what a method knows of what was asked, the rest left out."""
    return Options(**{FIELDS[name]: getattr(options, FIELDS[name]) for name in card.heeds})


def estimated(method: Method, recording: Recording, testbed: Testbed, options: Options) -> Estimate:
    """Return what a method makes of a record; InputError for an option that it does not know."""
    for name in ignored(method.card, options):
        known = ", ".join(f"--{choice}" for choice in method.card.heeds) or "none of these options"
        raise InputError("method", f"--{name} with {method.card.name}, which knows {known}",
                         "another method, such as trajectory, or no such option")  # fmt: skip
    if recording.position is not None and testbed.table is not None and not method.on_table:
        return refused(method.card, TableReason.BEARING_MOVES)
    found = method.run(recording, testbed, replace(options, budget=options.budget.renewed()))
    return judged_by_stays(found, recording, testbed)


def origin_of(recording: Recording) -> dict[str, str]:
    """Return what an estimate was made of, and by which version."""
    return {"version": __version__, "source": recording.source, "sha256": recording.sha256}


def refused(card: Card, why: Code, **numbers: Number) -> Estimate:
    """Return the estimate of a method that could not begin, and why; numbers are in SI."""
    return Estimate(card.name, outcome(why, **numbers), (), np.zeros((0, 0)))
