"""What all records of a joint fit show of all unknowns at once, and its covariance.

The information of what is shared and of every record's own unknowns is one matrix; it is judged as
that of one record is (``observability``). Beside it, to first order (Schmidt 1966): with w_i S_i of
a record and C the joint covariance, a shift c of the record's own estimate moves the joint one by

    C w_i S_i c

Such shifts are those of events whose moments are not known, each record's own, and of masses that
hang on soft drives, which they do alike in all records. So do inputs that were stated, not
measured (``input_errors``): more records tell no more of a mass.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from equipoise.estimation.events.record_model import RecordModel
from equipoise.estimation.joint.profile_descent import Joint, reduced, without_private
from equipoise.estimation.joint.shared_parameters import BODIES, Record
from equipoise.estimation.output_error.fit_estimate import conclude
from equipoise.estimation.output_error.input_errors import input_effects
from equipoise.estimation.output_error.kernels.gauss_newton import HELD
from equipoise.estimation.output_error.servo_sag_covariance import descent_by_sag
from equipoise.estimation.output_error.trajectory import METHOD
from equipoise.estimation.parameters.observability import (
    OPEN,
    Visibility,
    examine_unheld,
    natural_sizes,
    without_multiples,
)
from equipoise.model.arrays import Bools, Floats, Ints, Square
from equipoise.model.estimate import Estimate


@dataclass(frozen=True, slots=True, eq=False)
class Whole:
    """All unknowns of a joint fit: what is shared first, then each record's own."""

    information: Square  # without anchors
    size: Floats
    names: tuple[str, ...]
    held: Bools


def sizes_of(record: Record) -> Floats:
    """Return the natural sizes of a record's unknowns."""
    problem, point = record.problem, record.fitted.point
    return natural_sizes(point, problem.mass, problem.layout)


def without_anchor(record: Record) -> Square:
    """Return the weighted information of a record without what only keeps its search near."""
    prior = record.problem.prior
    return record.weight * (record.fitted.at.normal - np.diag(prior.anchor))


def whole_of(joint: Joint) -> Whole:
    """Return the information on all unknowns."""
    shared, prior = joint.shared, joint.shared.prior
    names, where = list(shared.names), list[Ints]()
    for k, record in enumerate(joint.records):
        at, own = np.empty(record.problem.layout.size, dtype=np.int64), record.place
        at[own.own], at[own.private] = own.shared, len(names) + np.arange(len(own.private))
        names += [f"{record.problem.layout.names[j]} of run {k + 1}" for j in own.private]
        where.append(at)
    information, size = np.zeros((len(names),) * 2), np.ones(len(names))
    for at, record in zip(where, joint.records, strict=True):
        information[np.ix_(at, at)] += without_anchor(record)
        size[at] = sizes_of(record)
    held = np.append(prior.held, np.zeros(len(names) - shared.size, dtype=bool))
    known = np.append(prior.weight - prior.anchor, np.zeros(len(names) - shared.size))
    information[np.diag_indices_from(information)] += known
    information[held], information[:, held] = 0.0, 0.0
    fixed = np.maximum(np.abs(joint.x[prior.held]), 1e-9)
    information[held, held] = (HELD * fixed) ** -2
    return Whole(information, size, tuple(names), held)


def visibility_of(joint: Joint) -> Visibility:
    """Return covariance and visibility of what is shared at a joint fit.

    Of a scale that is open one moment was held only for the search.
    """
    whole, n = whole_of(joint), joint.shared.size
    stretched = np.zeros(len(whole.names))
    stretched[BODIES] = joint.x[BODIES] / whole.size[BODIES]
    stretched /= np.linalg.norm(stretched)
    view = examine_unheld(whole.information, stretched, whole.size, whole.names, whole.held)
    view = without_multiples(view, whole.size, BODIES.start)
    hidden, covariance = view.hidden[:n].copy(), view.covariance[:n, :n]
    if not joint.shared.scale_open:
        return Visibility(covariance, hidden, view.unobservable, view.scale_open, view.unseen[:n])
    hidden[BODIES] = True
    return Visibility(covariance, hidden, (OPEN, *view.unobservable), True, view.unseen[:n])


def pull_of_sag(joint: Joint, record: Record, covariance: Square) -> Floats:
    """Return by how much masses that hang, by one sd, change w g of a record."""
    own, shared = record.place.own, record.place.shared
    spread = np.zeros((record.problem.layout.size,) * 2)
    spread[np.ix_(own, own)] = covariance[np.ix_(shared, shared)]
    moved = descent_by_sag(record.fitted, spread)
    if moved is None:
        return np.zeros(joint.shared.size)
    return record.place.spread(joint.shared.size, without_private(record, moved))


def by_inputs(joint: Joint, covariance: Square) -> Square:
    """Return what inputs that are uncertain, each alike in all records, add to a covariance."""
    size, shifts = joint.shared.size, dict[tuple[str, str], Floats]()
    for record in joint.records:
        place, effects = record.place, input_effects(record.fitted)
        if not effects:
            continue
        moved = without_private(record, np.column_stack([each.descent for each in effects]))
        for effect, pull in zip(effects, moved.T, strict=True):
            key = (effect.name, effect.axis)
            # what it does to J_P itself is the same in every record
            before = shifts.get(key, place.spread(size, effect.direct[place.own]))
            shifts[key] = before + covariance @ place.spread(size, pull)
    return sum((np.outer(s, s) for s in shifts.values()), np.zeros_like(covariance))


def beside_fit(joint: Joint, k: int, model: RecordModel, own: Estimate) -> Square:
    """Return what a record's own estimate adds to the covariance of its fit, by what is shared.

    That is for the moments of its events.
    """
    n, record = joint.shared.size, joint.records[k]
    added = np.zeros((n, n))
    if not model.events:
        return added
    plain = conclude(model.fitted, METHOD, model.recording, model.coloured)
    layout = record.problem.layout
    names = tuple(layout.names[int(k)] for k in record.place.own)
    at = np.ix_(record.place.shared, record.place.shared)
    added[at] = own.covariance_of(names) - plain.covariance_of(names)
    return added


def shared_information(joint: Joint, k: int) -> tuple[Square, Floats]:
    """Return w S and w g of a record among all that is shared."""
    (S, g), place = reduced(joint.records[k]), joint.records[k].place
    whole = np.zeros((joint.shared.size,) * 2)
    whole[np.ix_(place.shared, place.shared)] = S
    return whole, place.spread(joint.shared.size, g)


def considered(
    joint: Joint, covariance: Square, beside: Sequence[Square], pulls: Sequence[Floats]
) -> Square:
    """Return the covariance with the moments of events and the sag of masses counted."""
    wider = covariance.copy()
    for k, added in enumerate(beside):
        gain = covariance @ shared_information(joint, k)[0]
        wider += gain @ added @ gain.T
    shift = covariance @ np.sum(pulls, axis=0)
    return wider + np.outer(shift, shift)
