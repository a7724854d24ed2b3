"""Whether what sags hangs: a mass on a spring, hanging or not, beside a part that bends anyhow.

Elastic sag and a mass that hangs differ in third order of the tilt. Where sag promises more than
all other terms, and explains the record, both are fitted, with all else that the model has; the one
is taken in which the record is more probable, all unknowns integrated out. The mass has three
unknowns, and sag five. Where a record does not show whether it hangs, its spring is open, and so is
com along the vertical by c. It comes before process noise, and before more events than one, which
would stand for it.

Cannot see the difference in small swings: at 5 deg it is 0.8 % of the sag's own torque.
"""

import numpy as np

from equipoise.estimation.events.noise_identification import calibrated
from equipoise.estimation.events.record_model import (
    RecordModel,
    improbability,
    nearest,
    refitted,
)
from equipoise.estimation.model_selection.model_choice import (
    SURE,
    candidates,
    promise,
    with_group,
)
from equipoise.estimation.model_selection.model_search import touched
from equipoise.estimation.modes.hanging_fit import fit_hanging, hung, improbability_of
from equipoise.estimation.output_error.solution import chi_square_share
from equipoise.estimation.search_budget import Stage
from equipoise.model.hanging_mass import HangingMass
from equipoise.model.torque_terms import GROUPS, TERMS

SAG = GROUPS["sag"]
FIRST = (0.1, 0.5)  # shares of a spring, chosen: to begin with
EXPLAINED = 1.2  # of chi-square to its rows, chosen: more, and events or noise are missing first


def first_masses(bent: RecordModel) -> list[HangingMass]:
    """Return masses that hang of a fit with sag, by its part across the vertical z."""
    xx, yy, xy = bent.fitted.point.torque[[TERMS.index(term) for term in SAG[:3]]]
    heading, sag = 0.5 * float(np.arctan2(2.0 * xy, xx - yy)), float(np.hypot(xx - yy, 2.0 * xy))
    return [HangingMass(sag, heading, spring) for spring in FIRST]


def promises_most(model: RecordModel) -> bool:
    """Say whether sag promises, and more than all other terms."""
    most = promise(model, SAG)
    others = (group for group in candidates(model) if group != SAG)
    return most > SURE and all(promise(model, group) < most for group in others)


def is_shaken(model: RecordModel, improbable: float) -> bool:
    """Say whether one unknown event explains more than what is this improbable."""
    shaken = touched(*calibrated(model))
    return shaken is not None and bool(improbability(shaken) < improbable)


def with_hanging_mass(model: RecordModel) -> RecordModel:
    """Return the model with a mass that hangs; the same where the record shows none."""
    if set(SAG) & set(model.params.terms) or not model.may(Stage.TERMS):
        return model
    if not promises_most(model):
        return model
    bent = refitted(with_group(model, SAG))
    if not bent.fitted.converged or chi_square_share(bent.fitted) > EXPLAINED:
        return model
    first = nearest([hung(model, mass) for mass in first_masses(bent)])
    assert first.hanging is not None
    found = fit_hanging(first, first.hanging.mass)
    if not found.model.fitted.converged or not model.may(Stage.TERMS):
        return model
    least = improbability_of(found)
    if least > improbability(bent) or is_shaken(model, least):
        return model
    return found.model
