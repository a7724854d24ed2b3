"""Whether what sags hangs: a pendulum explains a record better than a part that bends.

Elastic sag and a mass that hangs differ in third order of the tilt. Where sag promises and nobody
declared it, both are fitted, with all else that the model has. The mass that hangs has fewer
unknowns; so it is one where chi-square, in units of its share per row, is less by ``GAIN`` or more.
It comes before events and process noise, which would stand for it.

Cannot see the difference in small swings: at 5 deg it is 0.8 % of the sag's own torque.
"""

import numpy as np

from equipoise.estimation.events.record_model import RecordModel, farther, refitted
from equipoise.estimation.model_selection.model_choice import SURE, promise, with_group
from equipoise.estimation.modes.hanging_fit import fit_hanging
from equipoise.estimation.output_error.solution import chi_square_share
from equipoise.estimation.search_budget import Stage
from equipoise.model.hanging import HangingMass
from equipoise.model.torque_terms import GROUPS, TERMS

SAG = GROUPS["sag"]
GAIN = 10.0  # of chi-square, chosen: 3 sd
FIRST = 0.1  # share of a spring, chosen: to begin with
EXPLAINED = 2.0  # chi-square a row, chosen: more, and events or noise are what is missing first


def first_mass(bent: RecordModel) -> HangingMass:
    """Return the mass that hangs of a fit with sag, by its part across the vertical z."""
    xx, yy, xy = bent.fitted.point.torque[[TERMS.index(term) for term in SAG[:3]]]
    heading = 0.5 * float(np.arctan2(2.0 * xy, xx - yy))
    return HangingMass(float(np.hypot(xx - yy, 2.0 * xy)), heading, FIRST)


def with_hanging_mass(model: RecordModel) -> RecordModel:
    """Return the model with a mass that hangs; the same where the record shows none."""
    if set(SAG) & set(model.params.terms) or not model.may(Stage.TERMS):
        return model
    if promise(model, SAG) < SURE:
        return model
    bent = refitted(with_group(model, SAG))
    if not bent.fitted.converged or chi_square_share(bent.fitted) > EXPLAINED:
        return model
    hung = fit_hanging(model, first_mass(bent)).model
    gained = farther(bent, hung) / max(1.0, chi_square_share(hung.fitted))
    return hung if hung.fitted.converged and gained > GAIN else model
