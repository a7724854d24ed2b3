"""The motion of a recording, to linearise along: a plain fit, with its cautions.

Sensitivities are taken along a motion, and the record's own is best found by a fit. A plain one is
enough: the terms asked for, damping where nothing follows the motion without, and the camera's
vertical free as far as it may lean. Neither events nor process noise are sought. A dense record
is followed as means of its rows, which hold as much information (``decimation``).

Cannot see whether the model is right; ``cautions`` say when its fit shows that it is not.
"""

from dataclasses import dataclass

import numpy as np

from equipoise.dynamics.propagation import Motion, propagate, rigid_body
from equipoise.dynamics.rigid_body import KNOWN_D
from equipoise.dynamics.timeline import Timeline
from equipoise.estimation.events.record_model import RecordModel
from equipoise.estimation.model_selection.decimation import condensed
from equipoise.estimation.model_selection.dense_record import fitted_means
from equipoise.estimation.model_selection.initial_model import plainly
from equipoise.estimation.model_selection.model_choice import levelled
from equipoise.estimation.model_selection.reference_fit import FEWEST, too_few
from equipoise.estimation.output_error.fit_estimate import EXPLAINED
from equipoise.estimation.output_error.solution import Fitted, chi_square_share
from equipoise.estimation.output_error.trajectory import Params
from equipoise.model.arrays import Floats, Ints
from equipoise.model.errors import InputError
from equipoise.model.reasons.data_reasons import Caution
from equipoise.model.reasons.reason import Reason
from equipoise.model.recording import Recording, arranged
from equipoise.model.testbed import Testbed


@dataclass(frozen=True, slots=True, eq=False)
class Followed:
    """A fit of a recording, and what it was a fit of."""

    fitted: Fitted
    testbed: Testbed
    params: Params  # what was asked, with what had to be added
    cautions: tuple[Reason, ...]  # why the motion may be another


def followed(recording: Recording, testbed: Testbed, params: Params) -> Followed:
    """Return the motion of a recording; InputError if it has too few rows or no such sensor."""
    recording = arranged(recording, testbed.mass_names)
    if too_few(recording, testbed):
        raise InputError(
            recording.source or "recording", f"{recording.rows} rows", f"at least {FEWEST}"
        )
    recording, testbed, richer, fitted = searched(recording, testbed, params)
    still = np.zeros(0)
    model = RecordModel(recording, testbed, richer, still, np.zeros(3), (), fitted, testbed)
    if np.isfinite(fitted.at.cost):
        model = levelled(model)
    reported = cautions(model.fitted, damped=richer.terms != params.terms)
    return Followed(model.fitted, testbed, model.params, reported)


def searched(
    recording: Recording, testbed: Testbed, params: Params
) -> tuple[Recording, Testbed, Params, Fitted]:
    """Return the plain fit, of what record, with what sensors and terms."""
    few = condensed(recording, testbed)
    if few is None:
        return recording, testbed, *plainly(recording, testbed, params)
    return fitted_means(few, params)


def cautions(fitted: Fitted, damped: bool) -> tuple[Reason, ...]:
    """Return why the motion may not be the recording's."""
    found = [Reason(Caution.DAMPING_ADDED)] if damped else []
    share = chi_square_share(fitted)
    if not fitted.converged:
        found.append(Reason(Caution.NOT_CONVERGED))
    elif share > EXPLAINED:
        found.append(Reason(Caution.UNEXPLAINED, (), {"times": float(np.sqrt(share))}))
    return tuple(found)


def halved(line: Timeline) -> Timeline:
    """Return a timeline with a node more in the middle of each step."""
    t, known = (np.repeat(x, 2, axis=0)[:-1] for x in (line.t, line.known))
    t[1::2] = 0.5 * (line.t[1:] + line.t[:-1])
    known[1::2] = 0.5 * (line.known[1:] + line.known[:-1])
    return line._replace(t=t, known=known)


def displaced(known: Floats, owners: Ints, error: Floats) -> Floats:
    """Return the known inputs with masses where the fit found them."""
    k = known.shape[1] - KNOWN_D - len(owners)
    out = known.copy()
    for j, (owner, unknown) in enumerate(owners):
        out[:, KNOWN_D + owner] += known[:, KNOWN_D + k + j] * error[unknown]
    return out


def halfway(fitted: Fitted) -> tuple[Timeline, Motion]:
    """Return the motion at both ends and in the middle of each step, as the model has it."""
    problem, point = fitted.problem, fitted.point
    line = halved(problem.line)
    line = line._replace(known=displaced(line.known, line.owners, point.error))
    rigid = rigid_body(point.body(problem.mass), problem.gravity, point.torque)
    return line, propagate(rigid, problem.maps, line, point.q0, point.w0)
