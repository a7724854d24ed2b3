"""Planar: the maximum-likelihood fit of a platform whose bearing floats over a flat table.

    minimise  sum |log(q_pred^-1 q_meas)|^2 / sd_q^2 + sum |p_meas - p|^2 / sd_p^2
              + sum |w_meas - w - b|^2 / sd_w^2 + priors

over first attitude, rate, position and velocity, J, com, the slope of the table, the lean of the
attitude's vertical from its normal, torques, the gyro's bias and a friction map
(``dynamics.planar``). The platform drags the sled along: that shows mu / M, so that free motion
fixes the scale of J and com, as M is weighed. It fixes it well where mu is large: its sd there is
that of a position over sqrt(rows), times M, over sqrt(tilt^2).

Cannot see friction where the record never went; a constant force in the plane beside the slope; a
pad that scrapes; the sled's own rotation; errors of displacement of moving masses. Air that
blows on the platform is no process noise here: what it leaves widens the intervals.
"""

import numpy as np

from equipoise.actuators.sliding_masses import com_shift, com_shift_covariance, mass_maps
from equipoise.estimation.method_contract import Method, Options, origin_of, refused
from equipoise.estimation.output_error.fit_estimate import EXPLAINED, UNSETTLED, widening
from equipoise.estimation.parameters.flat_body import flat_reasons
from equipoise.estimation.parameters.observability import Visibility, examine_unheld
from equipoise.estimation.parameters.scale_free_ratios import ratios_of
from equipoise.estimation.planar.planar_fit import PlanarFit
from equipoise.estimation.planar.planar_layout import (
    FRICTION_MEAN,
    INPUTS,
    NODE,
    POSITION,
    VELOCITY,
    node_names,
)
from equipoise.estimation.planar.planar_search import PlanarCase, nodes_along, searched
from equipoise.estimation.search_budget import cut_short
from equipoise.maths.attitude import logarithm
from equipoise.maths.linalg import inverse_where, lag_one, unpack_symmetric
from equipoise.maths.straight_lines import read_at
from equipoise.maths.whiteness import portmanteau, spectral_peak
from equipoise.model import torque_terms
from equipoise.model.arrays import Floats, Square
from equipoise.model.estimate import (
    ATTITUDE,
    BODY,
    COM,
    END,
    INERTIA,
    RATE,
    Estimate,
    Parameter,
    Residual,
)
from equipoise.model.mass_properties import MassProperties
from equipoise.model.method_card import Card
from equipoise.model.outcome import Outcome, outcome
from equipoise.model.reasons.estimate_reasons import EstimateReason as Why
from equipoise.model.reasons.reason import Reason
from equipoise.model.reasons.table_reasons import TableReason
from equipoise.model.recording import Recording, Samples, arranged
from equipoise.model.testbed import Testbed

FEWEST = 50  # rows of a sensor, chosen: fewer hold no path beside a swing
LAST = (*RATE, *ATTITUDE, *POSITION, *VELOCITY)  # of what is reported

CARD = Card(
    "planar",
    "integrated motion of five degrees of freedom: platform, sled, sloping table, friction map",
    "maximum likelihood, Levenberg-Marquardt",
    "docs/planar.md",
    "attitude and position, and a table in the testbed",
    "friction where the record never went; a constant force in the plane beside the slope",
    "free",
    ("term", "hold", "prior"),
)


def moves_over_table(recording: Recording, testbed: Testbed) -> bool:
    """Say whether the bearing of a platform moved: positions were recorded, on a stated table."""
    return recording.position is not None and testbed.table is not None


def run(recording: Recording, testbed: Testbed, options: Options) -> Estimate:
    """Return the estimate."""
    lacking = (recording.attitude, recording.position, testbed.attitude, testbed.position)
    if testbed.table is None or any(each is None for each in lacking):
        return refused(CARD, TableReason.NO_POSITION)
    assert recording.attitude is not None
    assert recording.position is not None
    fewest = min(len(recording.attitude), len(recording.position))
    if fewest < FEWEST:
        return refused(CARD, Why.TOO_FEW_ROWS, rows=fewest)
    recording = arranged(recording, testbed.mass_names)
    terms = torque_terms.among((*testbed.disturbances, *options.terms))
    case = PlanarCase(recording, testbed, terms, options.hold, options.use_prior)
    fit = searched(case, options.budget)
    if not np.all(np.isfinite(fit.normal)):
        return refused(CARD, Why.NOT_CONVERGED)
    return cut_short(conclude(fit, recording), options.budget.unfinished, explained(fit))


METHOD = Method(CARD, run, on_table=True)


def explained(fit: PlanarFit) -> bool:
    """Say whether a fit leaves little more than the stated noise."""
    return fit.chi_square < EXPLAINED * fit.problem.rows


def residual_of(fit: PlanarFit) -> Residual:
    """Return the statistics of what a fit leaves; the worse of attitude and position counts."""
    problem, left = fit.problem, fit.left
    camera, gyro = problem.attitude, problem.rate
    unknowns = int(np.sum(~problem.prior.held))
    channels = (left.attitude, left.position)
    return Residual(
        float(np.sqrt(np.mean(left.attitude**2))) * camera.sd,
        float(np.sqrt(np.mean(left.rate**2))) * gyro.sd if len(left.rate) else None,
        fit.chi_square,
        max(problem.rows - unknowns, 1),
        lag_one(left.attitude),
        min(portmanteau(each) for each in channels),
        spectral_peak=max(spectral_peak(each) for each in channels),
        attitude=Samples(camera.rows.t, left.attitude * camera.sd),
        rate=Samples(gyro.rows.t, left.rate * gyro.sd) if len(left.rate) else None,
    )


def visibility_of(fit: PlanarFit) -> Visibility:
    """Return what the record shows beside the priors that a testbed states."""
    problem, values = fit.problem, fit.point.values
    size, scale = natural_now(fit), np.zeros(len(values))
    core = problem.layout.of(*BODY)
    scale[core] = values[core] / size[core]
    scale /= max(float(np.linalg.norm(scale)), 1e-300)
    information = fit.normal - np.diag(problem.prior.anchor)
    held = problem.prior.held
    return examine_unheld(information, scale, size, problem.layout.names, held)


def natural_now(fit: PlanarFit) -> Floats:
    """Return natural sizes as the fit has them: the inertia, the distance and the friction found.

    A node of the map counts as observable where its sd is below half of the mean of all nodes.
    """
    problem, values = fit.problem, fit.point.values
    layout, size = problem.layout, problem.size.copy()
    J, r, map_ = layout.of(*INERTIA), layout.of(*COM), layout.friction
    size[J] = float(np.mean(values[J[:3]]))
    size[r] = max(float(np.linalg.norm(values[r])), size[r[0]] * 1e-2)
    weight = np.diag(fit.normal)[map_]
    mean = float(np.sum(weight * values[map_]) / max(float(np.sum(weight)), 1e-300))
    size[map_] = max(abs(mean), 1e-2 * size[map_.start])
    return size


def reported(fit: PlanarFit) -> list[str]:
    """Return the unknowns that are reported, in order."""
    layout, held = fit.problem.layout, fit.problem.prior.held
    known = {name for name, fixed in zip(layout.names, held, strict=True) if fixed}
    hidden = {*BODY, *LAST, *INPUTS, *known.difference(BODY)}
    between = [name for name in layout.names if name not in hidden]
    return [*COM, *INERTIA, *between, *LAST]


def at_the_end(fit: PlanarFit) -> Floats:
    """Return the displacements of the masses (m) at the end of the record."""
    line, masses = fit.problem.line, fit.problem.testbed.masses
    return line.known[-1, line.known.shape[1] - len(masses) :]


def parameters_of(
    fit: PlanarFit, view: Visibility, factor: float, start: Floats
) -> tuple[tuple[Parameter, ...], Square]:
    """Return the named values with their covariance; ``start``: displacements (m) at the start.

    The covariance has the priors and anchors of what is hidden: what a map is at a place may be
    known though its nodes are not. With masses off home it has the accuracy of their places.
    """
    problem, layout = fit.problem, fit.problem.layout
    names, values = reported(fit), fit.point.values.copy()
    values[layout.of(*ATTITUDE)] = logarithm(fit.point.q0)
    rows, end = np.eye(layout.size)[layout.of(*names)], at_the_end(fit)
    labels = [(name, layout.unit(name)) for name in names]
    maps, mass = mass_maps(problem.testbed.masses), problem.testbed.body.mass
    mean, first_node = np.zeros(layout.size), names.index(node_names(layout.nodes)[0])
    mean[layout.friction] = nodes_along(problem, problem.position.rows.values).mean(axis=0)
    rows = np.insert(rows, first_node, mean, axis=0)
    labels.insert(first_node, (FRICTION_MEAN, layout.unit(NODE)))
    shown = rows @ values
    if np.any(end):
        rows = np.vstack([rows, np.eye(layout.size)[layout.of(*COM)]])
        shown = np.append(shown, shown[: len(COM)] + com_shift(maps, mass, end))
        labels += [(name, "m") for name in END]
    covariance = factor**2 * rows @ inverse_where(fit.normal, ~problem.prior.held) @ rows.T
    accuracy = np.array([each.accuracy for each in problem.testbed.masses])
    off_home = (start != 0).astype(float)
    covariance[:3, :3] += com_shift_covariance(maps, mass, accuracy, off_home)
    hidden = np.any(np.abs(rows[:, view.hidden]) > 0, axis=1)
    hidden[first_node] = False  # the record shows the mean over its path in any case
    sd = np.where(hidden, np.inf, np.sqrt(np.maximum(np.diag(covariance), 0.0)))
    found = [
        Parameter(name, unit, float(shown[i]), float(sd[i]), not bool(hidden[i]))
        for i, (name, unit) in enumerate(labels)
    ]
    return tuple(found), covariance


def outcome_of(fit: PlanarFit, residual: Residual, view: Visibility, factor: float) -> Outcome:
    """Return whether the numbers may be used, and why."""
    if not fit.converged:
        return UNSETTLED
    off, problem = fit.left.position, fit.problem
    position = {"position_rms": float(np.sqrt(np.mean(off**2))) * problem.position.sd}
    if not explained(fit):
        times = float(np.sqrt(residual.reduced_chi_square))
        attitude = {"attitude_rms": residual.attitude_rms or 0.0}
        return outcome(TableReason.UNEXPLAINED_ON_TABLE, **attitude, **position, times=times)
    attitude = {"attitude_rms": residual.attitude_rms or 0.0}
    found = [
        Reason(Why.EXPLAINED_ATTITUDE, (), attitude),
        Reason(TableReason.EXPLAINED_POSITION, (), position),
        Reason(TableReason.FRICTION_MAP, (), {"nodes": problem.layout.nodes}),
    ]
    if factor > 1:
        numbers = {"lag_one": residual.lag_one, "spectral_peak": residual.spectral_peak}
        found.append(Reason(Why.COLOURED_RESIDUAL, (), numbers | {"widening": factor}))
    if view.scale_open:
        found.insert(0, Reason(Why.RATIOS_ONLY))
    elif bool(view.hidden[problem.layout.of(*BODY)].any()):
        found.append(Reason(Why.PART_UNOBSERVABLE))
    values = fit.point.values
    J = unpack_symmetric(values[problem.layout.of(*INERTIA)])
    body = MassProperties(problem.testbed.body.mass, values[problem.layout.of(*COM)], J)
    return Outcome((*found, *flat_reasons(body)))


def conclude(fit: PlanarFit, recording: Recording) -> Estimate:
    """Return the estimate in SI; ``com_end`` is with the masses as they stand at the end."""
    layout, view, residual = fit.problem.layout, visibility_of(fit), residual_of(fit)
    factor, masses = widening(residual), fit.problem.testbed.masses
    rows = recording.masses
    start = np.zeros(len(masses))
    if rows is not None and len(rows):
        start = read_at(np.array([recording.span[0]]), rows.t, rows.values)[0]
    parameters, covariance = parameters_of(fit, view, factor, start)
    core = layout.of(*BODY)
    wide = view.covariance[np.ix_(core, core)] * factor**2
    ratios = ratios_of(fit.point.values[core], wide, view.unseen[core]) if view.scale_open else ()
    return Estimate(
        CARD.name,
        outcome_of(fit, residual, view, factor),
        parameters,
        covariance,
        residual,
        view.unobservable,
        ratios,
        provenance=origin_of(recording),
    )
