"""What a linear solution is worth, in numbers and with reasons."""

from typing import NamedTuple

import numpy as np

from equipoise.estimation.method_contract import origin_of
from equipoise.estimation.parameters.fit_parameters import term_sizes
from equipoise.estimation.parameters.flat_body import flat_reasons
from equipoise.estimation.parameters.observability import DISTANCE, OPEN, Visibility, examine
from equipoise.estimation.parameters.scale_free_ratios import ratios_of
from equipoise.estimation.regression.error_indices import error_indices
from equipoise.estimation.regression.formulations.rows import Posed, Rows, body_with, centred
from equipoise.estimation.regression.solvers.recursion import Passed
from equipoise.maths.linalg import inverse_spd, lag_one
from equipoise.maths.whiteness import portmanteau
from equipoise.model.arrays import Floats, Series, Square
from equipoise.model.errors import InputError
from equipoise.model.estimate import BODY, COM, INERTIA, Course, Estimate, Parameter, Residual
from equipoise.model.mass_properties import MassProperties, is_possible
from equipoise.model.method_card import Card
from equipoise.model.outcome import Outcome
from equipoise.model.reasons.estimate_reasons import EstimateReason as Why
from equipoise.model.reasons.reason import Reason
from equipoise.model.torque_terms import TERMS, unit_of

MATTERS = 0.5  # sd of noise: a bias beyond it makes 95 % less than 92 %
MOST_TAKEN = 0.25  # chosen: beyond, a bias is no longer small, and not what repeating it shows
DROWNED = 100.0  # chosen: residuals ten times those of noise, so nothing is known


class Shifts(NamedTuple):
    """Errors (c,) that no repetition shows, each as far as known."""

    bias: Floats  # what noise in the regressor does
    omitted: Floats  # what the formulation leaves out
    blurred: Floats  # what smoothing does to quick motion


class Answer(NamedTuple):
    """What a solver found, and its possible errors."""

    values: Floats  # (c,) in the order of the rows' names
    covariance: Square  # of what noise does
    shifts: Shifts
    left: Series  # (n, m) of the rows
    excess: float  # of its power over that of noise, where it is greatest; at least 1
    course: Passed | None = None  # of a recursion


def conclude(
    card: Card, posed: Posed, rows: Rows, answer: Answer, pinned: tuple[str, ...]
) -> Estimate:
    """Return the estimate; ``pinned`` was held only because the scale is open."""
    whole = total(answer)
    rounding = np.diag(1e-12 * np.diag(whole) + 1e-60)  # keeps the inverse finite
    view = examine(inverse_spd(whole + rounding), *scale_and_sizes(posed, rows, answer),
                   rows.names)  # fmt: skip
    names, values, covariance, hidden = texts(posed, rows, answer, view, whole, pinned)
    open_scale = bool(pinned)
    body = body_with(posed.testbed, dict(zip(rows.names, answer.values, strict=True)))
    outcome = outcome_of(rows, answer, open_scale, body)
    ratios = ratios_for(names, values, covariance) if open_scale else ()
    return Estimate(
        card.name,
        outcome,
        tuple(parameter(names[k], values[k], covariance[k, k], hidden[k] or open_scale)
              for k in range(len(names))),
        covariance,
        residual_of(rows, answer),
        ((OPEN,) if open_scale else ()) + view.unobservable,
        ratios,
        is_possible(body),
        origin_of(posed.recording),
        course=course_of(rows, answer, whole),
    )  # fmt: skip


def course_of(rows: Rows, answer: Answer, whole: Square) -> Course | None:
    """Return the estimate of a recursion along the rows.

    Its own sd take rows for independent: all are as much wider as the last one is.
    """
    if answer.course is None:
        return None
    wider = np.sqrt(np.diag(whole)) / np.maximum(answer.course.sd[-1], 1e-300)
    return Course(rows.names, rows.t, answer.course.values, answer.course.sd * wider)


def total(answer: Answer) -> Square:
    """Return noise, widened, and the errors that no repetition shows."""
    fixed = np.array(answer.shifts)
    return answer.excess * answer.covariance + fixed.T @ fixed


def scale_and_sizes(posed: Posed, rows: Rows, answer: Answer) -> tuple[Floats, Floats]:
    """Return the direction in which J and com grow alike, and sizes natural to each unknown."""
    body = posed.testbed.body
    inertia = body.mean_moment
    com = [answer.values[k] for k, name in enumerate(rows.names) if name in COM]
    distance = max(float(np.linalg.norm(com)), DISTANCE)
    known = {**dict.fromkeys(INERTIA, inertia), **dict.fromkeys(COM, distance)}
    weight = posed.testbed.weight
    known |= dict(zip(TERMS, term_sizes(TERMS, inertia, weight), strict=True))
    size = np.array([known[name] for name in rows.names])
    stretched = np.where(np.isin(rows.names, BODY), answer.values / size, 0.0)
    return stretched / max(float(np.linalg.norm(stretched)), 1e-300), size


def texts(
    posed: Posed, rows: Rows, answer: Answer, view: Visibility, whole: Square,
    pinned: tuple[str, ...],
) -> tuple[tuple[str, ...], Floats, Square, list[bool]]:  # fmt: skip
    """Return names, values, covariance and what is hidden, in the order of report."""
    found = dict(zip(rows.names, answer.values, strict=True))
    if pinned:
        top = INERTIA.index(pinned[0])
        found[pinned[0]] = float(posed.testbed.body.inertia_P[top, top])
    names = tuple(n for n in (*COM, *INERTIA, *posed.terms) if n in found)
    where = {name: k for k, name in enumerate(rows.names)}
    covariance = np.zeros((len(names), len(names)))
    own = [k for k, name in enumerate(names) if name in where]
    index = [where[names[k]] for k in own]
    covariance[np.ix_(own, own)] = whole[np.ix_(index, index)]
    hidden = [bool(view.hidden[where[n]]) if n in where else False for n in names]
    return names, np.array([found[name] for name in names]), covariance, hidden


def parameter(name: str, value: float, variance: float, hidden: bool) -> Parameter:
    """Return a named value; what is hidden has an infinite interval."""
    unit = "kg m2" if name in INERTIA else "m" if name in COM else unit_of(name)
    sd = np.inf if hidden else float(np.sqrt(max(variance, 0.0)))
    return Parameter(name, unit, float(value), sd, not hidden)


def ratios_for(names: tuple[str, ...], values: Floats, covariance: Square) -> tuple[Parameter, ...]:
    """Return the ratios of com and J."""
    if not set(BODY) <= set(names):
        return ()
    order = [names.index(name) for name in BODY]
    return ratios_of(values[order], covariance[np.ix_(order, order)], np.zeros((9, 0)))


def indices_of(rows: Rows) -> tuple[float | None, dict[str, float]]:
    """Return Lee's error indices, total and relative by parameter; none of rows without answer."""
    middle = centred(rows)
    try:
        found = error_indices(middle.A.reshape(-1, len(rows.names)), middle.b.reshape(-1))
    except InputError:
        return None, {}
    return found.index, dict(zip(rows.names, map(float, found.relative), strict=True))


def residual_of(rows: Rows, answer: Answer) -> Residual:
    """Return how much is left, in units of what noise leaves."""
    index, relative = indices_of(rows)
    freedom = max(answer.left.size - len(answer.values), 1)
    return Residual(
        None,
        None,
        answer.excess * freedom,
        freedom,
        lag_one(answer.left),
        portmanteau(answer.left),
        spectral_peak=answer.excess,
        error_index=index,
        error_indices=relative,
    )


def worst(rows: Rows, shift: Floats, answer: Answer) -> tuple[str, float] | None:
    """Return the parameter that a shift moves most, and by how many sd of noise; None if none."""
    sd = np.sqrt(answer.excess * np.maximum(np.diag(answer.covariance), 1e-300))
    by = shift / sd
    k = int(np.argmax(np.abs(by)))
    return (rows.names[k], float(by[k])) if abs(by[k]) > MATTERS else None


def outcome_of(rows: Rows, answer: Answer, open_scale: bool, body: MassProperties) -> Outcome:
    """Return whether the numbers may be used, and what to think of them and of the body found."""
    found = [] if is_possible(body) else [Reason(Why.IMPOSSIBLE_INERTIA)]
    found.append(Reason(Why.LINEAR_RATIOS if open_scale else Why.LINEAR))
    found += rows.notes
    taken = most_taken(rows, answer)
    if taken > MOST_TAKEN:
        found.append(Reason(Why.REGRESSOR_NOISE_TOO_LARGE, (), {"share": taken}))
    if answer.excess > DROWNED:
        found.append(Reason(Why.RESIDUAL_TOO_LARGE, (), {"power": answer.excess}))
    elif answer.excess > 1:
        widening = float(np.sqrt(answer.excess))
        numbers = {"power": answer.excess, "widening": widening}
        found.append(Reason(Why.RESIDUAL_LARGE, (), numbers))
    flat = flat_reasons(body) if set(INERTIA) <= set(rows.names) else ()
    return Outcome((*found, *flat, *biases(rows, answer)))


def biases(rows: Rows, answer: Answer) -> list[Reason]:
    """Return what moves which parameter by more than noise lets an interval allow for."""
    shifts = answer.shifts
    causes = (
        (Why.BIAS_BY_NOISE, shifts.bias),
        (Why.BIAS_BY_SMOOTHING, shifts.blurred),
        (Why.BIAS_BY_MODEL, shifts.omitted),
    )
    found = [(code, worst(rows, shift, answer)) for code, shift in causes]
    return [Reason(code, (most[0],), {"sds": most[1]}) for code, most in found if most is not None]


def most_taken(rows: Rows, answer: Answer) -> float:
    """Return the greatest share of a moment of inertia that as much noise again takes.

    Of p / (1 + s), s the noise's share, it leaves p / (1 + 2 s): a quarter less is s = 1/2.
    """
    moments = [rows.names.index(name) for name in INERTIA[:3] if name in rows.names]
    bias, values = answer.shifts.bias, answer.values
    shares = [float(-bias[k] / max(abs(values[k]), 1e-300)) for k in moments]
    return max(shares, default=0.0)
