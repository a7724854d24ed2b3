"""Which terms beside gravity and a rigid body a record supports: sensors' errors and torques.

A group of terms is tried when the record is likelier with it, all unknowns integrated out about
the present optimum and the group's coefficients having a plausible size each (W = size^-2):

    2 ln ratio = b^T (S + W)^-1 b - ln det(E + W^-1 S),     S = A_BB - A_BA A_AA^-1 A_AB

(the Bayes factor in Laplace's approximation). Torques that promise about as much are all fitted,
and the one is tried in which the record is most probable. A group is kept when it also predicts
(``cross_validation``): a term that merely bends to fit loses on rows that were held out. A torque
needs a lead (``SURE``; Kass and Raftery 1995 call 6 strong). An error of a sensor needs none: where
it is as likely there as not, leaving it out moves com by several sd.

A log of the masses that was stamped late is such an error, too, and comes first where it has that
lead: what explains a jump at the time of a recorded move first is that move.

A gyro's clock that is fast beside the camera's turns what nutates away from the rows, the more
the longer the record: it is a term, too. Rows are timed anew by what was found (``row_timing``).

An unknown event may resemble a term, and a term events. So a term that promises as much as an
event is taken before it (``is_lawful``), and every term is put to the test again when all else is
known (``bared``).

Cannot separate terms that do the same within the record: the likelier one is kept.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from equipoise.actuators.lags import LAG, logged_late
from equipoise.dynamics.lamp_warmth import by_lamp, warms
from equipoise.estimation.events.event_search import CLEAR, spans_of_travels
from equipoise.estimation.events.jump_test import threshold
from equipoise.estimation.events.record_model import (
    RecordModel,
    farther,
    improbability,
    point_in,
    refitted,
)
from equipoise.estimation.model_selection.cross_validation import posed_in, predicts_better
from equipoise.estimation.model_selection.lamp_response import (
    THERMAL,
    responding,
    with_time_constant,
)
from equipoise.estimation.model_selection.row_timing import retimed, with_clock
from equipoise.estimation.output_error.free_vertical import PLUMB, may_lean, with_free_vertical
from equipoise.estimation.output_error.problem import changes
from equipoise.estimation.output_error.solution import evaluate
from equipoise.estimation.output_error.trajectory import Params
from equipoise.estimation.parameters.fit_parameters import sensor_sizes
from equipoise.estimation.search_budget import Stage
from equipoise.model import sensor_terms, torque_terms
from equipoise.model.arrays import Floats

HEADING = sensor_terms.GROUPS["heading2"] + sensor_terms.GROUPS["heading3"]  # one cause, one group
GYRO = (sensor_terms.GROUPS["gyro_scale"], sensor_terms.GROUPS["gyro_cross"])
DELAY, CLOCK = sensor_terms.GROUPS["camera_delay"], sensor_terms.GROUPS[sensor_terms.GYRO_CLOCK]
SLOWER = (-1.5, 0.0, 1.5)  # of ln of a lamp's time constant, chosen: what may promise
LATE_LOG = (LAG,)  # of the masses: an error of theirs, not a term
SURE = 6.0  # 2 ln ratio
GROUPS = (PLUMB, HEADING, DELAY, CLOCK, *GYRO, *torque_terms.GROUPS.values())
Refused = set[tuple[str, ...]]


def is_of_sensors(group: tuple[str, ...]) -> bool:
    """Say whether a group is of errors of sensors, not of torques."""
    return group == LATE_LOG or set(group) <= set(sensor_terms.TERMS)


def candidates(model: RecordModel) -> list[tuple[str, ...]]:
    """Return the groups of terms that this record could show and that are not sought yet."""
    recording, params = model.recording, model.params
    camera, gyro = (c is not None and len(c) > 0 for c in (recording.attitude, recording.rate))
    found: list[tuple[str, ...]] = [HEADING] if camera else []
    if camera and (gyro or changes(recording)):
        found.append(DELAY)
    if camera and gyro:
        found += GYRO
        if model.testbed.gyro is not None and model.testbed.gyro.clock_sd > 0:
            found.append(CLOCK)
    if spans_of_travels(model) and not all(mass.logged_late for mass in model.testbed.masses):
        found.append(LATE_LOG)
    found += [group for group in torque_terms.GROUPS.values() if group != THERMAL]
    if warms(recording, model.testbed):
        found.append(THERMAL)
    sought = {*params.sensor, *params.terms}
    return [group for group in found if not sought.issuperset(group)]


def levelled(model: RecordModel) -> RecordModel:
    """Return the model fitted with the camera's vertical free, where it may lean.

    And with a declared warmth as slow as the record has it.
    """
    if may_lean(model.recording, model.testbed):
        params = with_free_vertical(model.recording, model.testbed, model.params)
        model = refitted(replace(model, params=params))
    return responding(model)


def with_group(model: RecordModel, group: tuple[str, ...]) -> RecordModel:
    """Return the model with a group of terms more."""
    params, testbed = model.params, model.testbed
    if group == LATE_LOG:
        return replace(model, testbed=replace(testbed, masses=logged_late(testbed.masses)))
    if is_of_sensors(group):
        sensor = sensor_terms.among((*params.sensor, *group))
        return replace(model, params=replace(params, sensor=sensor))
    terms = torque_terms.among((*params.terms, *group))
    return replace(model, params=replace(params, terms=terms))


def added_groups(model: RecordModel, requested: Params) -> list[tuple[str, ...]]:
    """Return the groups of terms, or what of them, that were not asked for."""
    here, reported = ({*p.sensor, *p.terms} for p in (model.params, requested))
    groups = (tuple(t for t in group if t in here and t not in reported) for group in GROUPS)
    late = [LATE_LOG] if any(mass.logged_late for mass in model.testbed.masses) else []
    return [*late, *(group for group in groups if group)]


def without_group(model: RecordModel, group: tuple[str, ...]) -> RecordModel:
    """Return the model without a group of terms, whose coefficients are zero then."""
    params = model.params
    if group == LATE_LOG:
        return replace(model, testbed=replace(model.testbed, masses=model.stated.masses))
    sensor, terms = (
        tuple(term for term in terms if term not in group)
        for terms in (params.sensor, params.terms)
    )
    fitted, point = model.fitted, model.fitted.point
    bare = replace(
        point,
        torque=np.where(np.isin(torque_terms.TERMS, group), 0.0, point.torque),
        sensor=np.where(np.isin(sensor_terms.TERMS, group), 0.0, point.sensor),
    )
    less = replace(
        model,
        params=replace(params, sensor=sensor, terms=terms),
        fitted=replace(fitted, point=bare),
    )
    return with_clock(less, 0.0) if group == CLOCK else less


def plausible(model: RecordModel, group: tuple[str, ...]) -> Floats:
    """Return how large the coefficients of a group may well be, one sd; a torque's, on benches."""
    if is_of_sensors(group):
        return sensor_sizes(group, model.testbed)
    return torque_terms.typical_sizes(group)


def surplus(model: RecordModel, group: tuple[str, ...]) -> float:
    """Return 2 ln of how much likelier the record is with a group than without."""
    problem, jumps = posed_in(with_group(model, group), model.recording)
    names = problem.layout.names
    late, known = group == LATE_LOG, model.fitted.problem.layout.names
    B = np.array([name not in known if late else name in group for name in names])
    if not B.any():
        return -np.inf
    at = evaluate(problem, point_in(problem, model.fitted), jumps)
    unit = np.where(B, 1.0, 1 / np.sqrt(np.diag(at.normal)))
    unit[B] = problem.prior.weight[B] ** -0.5 if late else plausible(model, group)
    normal = at.normal - np.diag(np.where(B, problem.prior.weight, 0.0))
    A, b = normal * np.outer(unit, unit), at.descent * unit
    rest = np.linalg.solve(A[np.ix_(~B, ~B)], A[np.ix_(~B, B)])
    observed = np.eye(int(B.sum())) + A[np.ix_(B, B)] - A[np.ix_(B, ~B)] @ rest
    b_B = b[B] - rest.T @ b[~B]
    return float(b_B @ np.linalg.solve(observed, b_B) - np.linalg.slogdet(observed)[1])


def promise(model: RecordModel, group: tuple[str, ...]) -> float:
    """Return the surplus of a group; that of a lamp's warmth, however slow it is."""
    if group == THERMAL and by_lamp(model.recording, model.testbed):
        return max(surplus(with_time_constant(model, shift), group) for shift in SLOWER)
    return surplus(model, group)


def lead(group: tuple[str, ...]) -> float:
    """Return the 2 ln ratio that a group needs to be tried.

    A clock that is not sought is carried as an input: its sd counts all the same.
    """
    return 0.0 if is_of_sensors(group) and group != CLOCK else SURE


def best_groups(model: RecordModel, refused: Refused) -> list[tuple[str, ...]]:
    """Return the group that promises most beyond its lead; none if none does.

    A late log comes first. Torques that promise about as much as the best torque come with it.
    """
    found = {g: promise(model, g) - lead(g) for g in candidates(model) if g not in refused}
    best = max(found, key=lambda group: found[group], default=())
    if found.get(LATE_LOG, -np.inf) > SURE:
        best = LATE_LOG
    if found.get(best, 0.0) <= 0.0:
        return []
    least = max(found[best] - CLEAR, 0.0)
    others = [g for g in found if g != best and found[g] > least and not is_of_sensors(g)]
    return [best, *([] if is_of_sensors(best) else others)]


def likeliest(models: Sequence[RecordModel]) -> RecordModel:
    """Return the model in which the record is most probable; one alone is not weighed."""
    return models[0] if len(models) == 1 else min(models, key=improbability)


def extended(
    model: RecordModel, groups: Sequence[tuple[str, ...]], refused: Refused
) -> RecordModel:
    """Return the model with the likeliest of some groups of terms, if that predicts better.

    Refuse that group otherwise.
    """
    found = [responding(retimed(refitted(with_group(model, group)))) for group in groups]
    richer = likeliest(found)
    if richer.fitted.converged and model.may(Stage.TERMS) and predicts_better(model, richer):
        return richer
    refused.add(groups[found.index(richer)])
    return model


def is_lawful(model: RecordModel, richer: RecordModel, shaken: RecordModel) -> bool:
    """Say whether a term explains about as much as an event that promises, too.

    Each unknown counting as much as one of an event, or by how likely the record is with either:
    coefficients far smaller than their plausible size do badly by the latter, many by the former.
    Where both do, the term is taken: it leaves open more than an event, which has come and gone.
    """
    more = richer.fitted.problem.layout.size - model.fitted.problem.layout.size
    counted = threshold(richer.spacing) * (more / 3 - 1)
    if farther(richer, shaken) + counted < CLEAR:
        return True
    return improbability(richer) - improbability(shaken) < CLEAR


def bared(model: RecordModel, requested: Params) -> RecordModel:
    """Return the model without the terms that later finds have made needless."""
    for group in added_groups(model, requested):
        if not model.may(Stage.TERMS):
            break
        model = likeliest([refitted(without_group(model, group)), model])
    return model
