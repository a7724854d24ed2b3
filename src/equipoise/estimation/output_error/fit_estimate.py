"""From an optimum to an estimate: covariance, intervals, what was not observed, and the outcome."""

import itertools
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from equipoise.actuators.sliding_masses import com_shift
from equipoise.dynamics.regressor import DRIFT, THERMAL
from equipoise.dynamics.rigid_body import KNOWN_D, KNOWN_WARMTH
from equipoise.estimation.method_contract import origin_of
from equipoise.estimation.output_error.fit_visibility import visibility_of
from equipoise.estimation.output_error.input_errors import (
    STEP,
    input_shifts,
    sought_weights,
)
from equipoise.estimation.output_error.kernels.interval_smoother import Smoothed
from equipoise.estimation.output_error.problem import counted_by_timing
from equipoise.estimation.output_error.servo_sag_covariance import by_sag
from equipoise.estimation.output_error.solution import Fitted, freedom, smooth_at
from equipoise.estimation.parameters.fit_parameters import (
    CORE,
    FIXED,
    JP,
    RATE,
    TURN,
    Layout,
    R,
    physical,
    unknowns_of,
)
from equipoise.estimation.parameters.flat_body import flat_reasons
from equipoise.estimation.parameters.observability import Visibility
from equipoise.estimation.parameters.scale_free_ratios import ratios_of
from equipoise.maths.attitude import logarithm
from equipoise.maths.linalg import inverse_where, lag_one
from equipoise.maths.whiteness import portmanteau, spectral_peak
from equipoise.model.arrays import Floats, Series
from equipoise.model.estimate import BODY, COM, END, Estimate, Parameter, Residual
from equipoise.model.outcome import Outcome, OutcomeCode, outcome
from equipoise.model.reasons.estimate_reasons import EstimateReason as Why
from equipoise.model.reasons.reason import Reason
from equipoise.model.recording import Recording, Samples
from equipoise.model.torque_terms import GROUPS

DRIFTS, THERMALS = GROUPS["drift"], GROUPS["thermal"]
SURE = 4.0  # sd of a statistic before it counts as more than chance
MOSTLY = 0.5  # of a variance, chosen: an input that gives more limits it
EXPLAINED = 2.0  # chosen: chi-square per degree of freedom above which the model does not hold
LOST = np.deg2rad(3.0)  # rms an axis, chosen: no torque on a bearing puts a followed motion off so
BESIDE = 10.0  # times the noise, chosen: a camera so coarse may leave more
UNSETTLED = outcome(Why.NOT_CONVERGED)


def residual_of(fitted: Fitted, jumped: float = 0.0) -> Residual:
    """Return the statistics of what the model leaves; its jumps amount to ``jumped`` unknowns."""
    at, measurements = fitted.at, fitted.problem.observed
    left = at.left_q if len(at.left_q) else at.left_w
    square = float(np.sum(at.left_q**2) + np.sum(at.left_w**2) + np.sum(at.left_v**2))

    def rms(part: Floats, sd: float) -> float | None:
        return float(np.sqrt(np.mean(part**2))) * sd if part.size else None

    return Residual(
        rms(at.left_q, measurements.attitude_sd),
        rms(at.left_w, measurements.rate_sd),
        square,
        max(round(at.residuals - fitted.problem.layout.size - jumped), 1),
        lag_one(left),
        portmanteau(left),
        spectral_peak=spectral_peak(left),
        attitude=_rows_left(fitted.problem.recording.attitude, at.left_q, measurements.attitude_sd),
        rate=_rows_left(fitted.problem.recording.rate, at.left_w, measurements.rate_sd),
    )


def _rows_left(rows: Samples | None, left: Series, sd: float) -> Samples | None:
    """Return the residuals (n, 3) of a sensor's rows in SI; ``left`` is in units of ``sd``."""
    return Samples(rows.t, left * sd) if rows is not None and len(rows) else None


def leaves_more(residual: Residual) -> bool:
    """Say whether a residual is larger than the stated noise, and not by chance."""
    chance = np.sqrt(2 / residual.degrees_of_freedom)
    return bool(residual.reduced_chi_square > 1 + SURE * chance)


def widening(residual: Residual) -> float:
    """Return the factor on every sd for a residual larger or less white than noise."""
    factor = residual.reduced_chi_square if leaves_more(residual) else 1.0
    return float(np.sqrt(factor * residual.spectral_peak))


def selection(layout: Layout) -> list[int]:
    """Return the order in which parameters are reported."""
    first = [*range(R.start, R.stop), *range(JP.start, JP.stop), *range(FIXED, layout.size)]
    return [*first, *range(RATE.start, RATE.stop), *range(TURN.start, TURN.stop)]


def end_rows(fitted: Fitted, after: Smoothed | None) -> tuple[Floats, Floats] | None:
    """Return com at the end, and its derivative by the unknowns of the last stretch.

    Masses as they stand; drift, warmth and steps included. None where that is the com of the
    start with masses at home.
    """
    problem, layout = fitted.problem, fitted.problem.layout
    k, line = len(problem.maps.momentum), problem.line
    last, seconds = line.known[-1], float(line.t[-1] - line.t[0])
    d, response = last[KNOWN_D : KNOWN_D + k], last[KNOWN_D + k :]
    moving = [(j, layout.names.index(name), amount)
              for names, amount in ((DRIFTS, seconds), (THERMALS, float(last[KNOWN_WARMTH])))
              for j, name in enumerate(names) if name in layout.terms]  # fmt: skip
    stepped = any(set(COM) & set(jump.names) for jump in problem.jumps)
    if not (np.any(d) or moving or stepped):
        return None
    com = fitted.point.com if after is None else unknowns_of(after.points[-1]).com
    rows, actual = np.zeros((3, layout.size)), d.copy()
    rows[:, R] = np.eye(3)
    for j, (owner, error) in enumerate(problem.errors.owner):
        actual[owner] += response[j] * fitted.point.error[error]
        column = layout.mass_errors.start + error
        rows[:, column] += response[j] * problem.maps.first_moment[owner] / problem.mass
    for j, column, amount in moving:
        rows[j, column] = amount
    coefficients = fitted.point.torque
    moved = seconds * coefficients[DRIFT : DRIFT + 3]
    moved = moved + last[KNOWN_WARMTH] * coefficients[THERMAL : THERMAL + 3]
    return com + moved + com_shift(problem.maps, problem.mass, actual), rows


def outcome_of(fitted: Fitted, residual: Residual, view: Visibility, factor: float) -> Outcome:
    """Return whether the numbers may be used, and why."""
    camera = residual.attitude_rms is not None
    rms = {"attitude_rms": residual.attitude_rms or 0.0} if camera else {
        "rate_rms": residual.rate_rms or 0.0}  # fmt: skip
    if camera and rms["attitude_rms"] > max(LOST, BESIDE * fitted.problem.observed.attitude_sd):
        return outcome(Why.MOTION_NOT_FOUND, **rms)
    if not fitted.converged:
        return UNSETTLED
    if residual.reduced_chi_square > EXPLAINED:
        code = Why.UNEXPLAINED_ATTITUDE if camera else Why.UNEXPLAINED_RATE
        times = float(np.sqrt(residual.reduced_chi_square))
        return outcome(code, **rms, times=times, lag_one=residual.lag_one)
    found = [Reason(Why.EXPLAINED_ATTITUDE if camera else Why.EXPLAINED_RATE, (), rms)]
    if factor > 1:
        numbers = {"lag_one": residual.lag_one, "spectral_peak": residual.spectral_peak}
        found.append(Reason(Why.COLOURED_RESIDUAL, (), numbers | {"widening": factor}))
    if view.scale_open:
        found.insert(0, Reason(Why.RATIOS_ONLY))
    elif bool(view.hidden[R].any() or view.hidden[JP].any()):
        found.append(Reason(Why.PART_UNOBSERVABLE))
    return Outcome((*found, *flat_reasons(fitted.point.body(fitted.problem.mass))))


def parameters_of(
    fitted: Fitted, view: Visibility, factor: float, after: Smoothed | None
) -> tuple[tuple[Parameter, ...], Floats, tuple[Reason, ...]]:
    """Return the named values with their covariance, in the order in which they are reported.

    And which inputs limit them.
    """
    problem, layout = fitted.problem, fitted.problem.layout
    values = physical(fitted.point, problem.mass, layout)
    values[TURN] = logarithm(fitted.point.q0)
    values += counted_by_timing(layout, problem.testbed)
    order = selection(layout)
    every = tuple(zip(layout.names, layout.units, strict=True))
    rows, labels = np.eye(layout.size)[order], [every[k] for k in order]
    reported = values[order]
    end = end_rows(fitted, after)
    fresh = np.zeros((len(rows) + 3, len(rows) + 3))
    if end is not None:
        last = end[1] if after is None else end[1] @ after.onward
        rows, reported = np.vstack([rows, last]), np.append(reported, end[0])
        labels += [(name, "m") for name in END]
        if after is not None:
            first = after.onward @ after.covariance[0] @ after.onward.T
            fresh[-3:, -3:] = end[1] @ (after.covariance[-1] - first) @ end[1].T  # by jumps alone
    covariance = factor**2 * (rows @ view.covariance @ rows.T + fresh[: len(rows), : len(rows)])
    inputs, shifts = reported_shifts(fitted, rows, after)
    covariance += shifts.T @ shifts
    weights, by_prior = prior_shifts(fitted, rows, view)
    inputs, shifts = [*inputs, *weights], np.vstack([shifts, by_prior])
    hidden = np.any(np.abs(rows[:, view.hidden]) > 0, axis=1)
    sd = np.where(hidden, np.inf, np.sqrt(np.maximum(np.diag(covariance), 0.0)))
    found = [
        Parameter(name, unit, float(reported[i]), float(sd[i]), not bool(hidden[i]))
        for i, (name, unit) in enumerate(labels)
    ]
    return tuple(found), covariance, limits_of(found, inputs, shifts)


def limits_of(
    parameters: Sequence[Parameter], inputs: Sequence[str], shifts: Floats
) -> tuple[Reason, ...]:
    """Return the inputs that give most of the variance of inertia or centre of mass."""
    found: list[Reason] = []
    for name in dict.fromkeys(inputs):
        own = np.array([other == name for other in inputs])
        square = np.sum(shifts[own] ** 2, axis=0)
        limited = [p.name for p, x in zip(parameters, square, strict=True)
                   if p.name in BODY and p.observable and x > MOSTLY * p.sd**2]  # fmt: skip
        if limited:
            found.append(Reason(Why.INPUT_LIMITS, (name, *limited)))
    return tuple(found)


def reported_shifts(
    fitted: Fitted, rows: Floats, after: Smoothed | None
) -> tuple[list[str], Floats]:
    """Return inputs, and how each that is off by one sd moves what is reported: (inputs, rows)."""
    end, names, found = end_rows(fitted, after), list[str](), list[Floats]()
    for name, shift, varied in input_shifts(fitted):
        moved = rows @ shift
        if end is not None:
            other = end_rows(varied, after)
            assert other is not None
            moved[-len(END) :] += (other[0] - end[0]) / STEP
        names.append(name)
        found.append(moved)
    return names, np.array(found).reshape(-1, len(rows))


def prior_shifts(fitted: Fitted, rows: Floats, view: Visibility) -> tuple[list[str], Floats]:
    """Return inputs that are sought, and how a prior of each off by one sd moves what is reported.

    The covariance has it already: A^-1 (1 / s) of a normal matrix A that has 1 / s^2 of the prior.
    """
    sought, weight = sought_weights(fitted.problem), fitted.problem.prior.weight
    columns = list(sought.values())
    moved = (rows @ view.covariance[:, columns]) * np.sqrt(weight[columns])
    return list(sought), moved.T.reshape(-1, len(rows))


def smoothed_residual(fitted: Fitted) -> tuple[Smoothed | None, Residual]:
    """Return what is known of every stretch of a fit with jumps, and what the model leaves."""
    after = smooth_at(fitted) if fitted.problem.jumps else None
    return after, residual_of(fitted, freedom(fitted, after) if after else 0.0)


def meaningless(fitted: Fitted, parameters: tuple[Parameter, ...]) -> tuple[Parameter, ...]:
    """Return what a lost search ended at, without an sd; what is held is held."""
    held = set(itertools.compress(fitted.problem.layout.names, fitted.problem.prior.held))
    return tuple(
        p if p.name in held else replace(p, sd=np.inf, observable=False) for p in parameters
    )


def spread_of(fitted: Fitted, coloured: float = 1.0) -> tuple[tuple[Parameter, ...], Floats]:
    """Return named values and their covariance with every prior counted, and nothing hidden.

    What the data do not show is as uncertain as the priors leave it: a number for whoever asks what
    a combination of parameters may be, where ``conclude`` says that it is unobservable.
    """
    held = fitted.problem.prior.held
    covariance = inverse_where(fitted.at.normal, ~held)
    covariance += by_sag(fitted, covariance)
    view = Visibility(covariance, np.zeros_like(held), (), False, np.zeros((len(held), 0)))
    after, residual = smoothed_residual(fitted)
    return parameters_of(fitted, view, max(widening(residual), coloured), after)[:2]


def conclude(fitted: Fitted, method: str, recording: Recording, coloured: float = 1.0) -> Estimate:
    """Return the estimate. Units are SI; ``com_end`` is with the masses as they stand at the end.

    Intervals are at least ``coloured`` times as wide as rows say that err independently. The sd of
    the first attitude (a rotation vector) is that of a small turn in body axes.
    """
    problem, layout = fitted.problem, fitted.problem.layout
    values = physical(fitted.point, problem.mass, layout)
    view = visibility_of(fitted)
    after, residual = smoothed_residual(fitted)
    factor = max(widening(residual), coloured)
    parameters, covariance, limits = parameters_of(fitted, view, factor, after)
    found = outcome_of(fitted, residual, view, factor)
    body = [[p.name for p in parameters].index(name) for name in BODY]  # as CORE, inputs counted
    return Estimate(
        method,
        Outcome((*found.reasons, *limits)) if found.usable else found,
        meaningless(fitted, parameters) if found.code is OutcomeCode.NOT_CONVERGED else parameters,
        covariance,
        residual,
        view.unobservable,
        ratios_of(values[CORE], covariance[np.ix_(body, body)], view.unseen[CORE])
        if view.scale_open
        else (),
        True,
        provenance=origin_of(recording) | {"evaluations": str(fitted.evaluations)},
    )
