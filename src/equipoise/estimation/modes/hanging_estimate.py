"""An estimate with a mass that hangs: its numbers, and what not knowing them adds to all others.

Centre of mass is that of the level platform, the mass at rest.
"""

import numpy as np

from equipoise.estimation.events.record_model import RecordModel
from equipoise.estimation.modes.hanging_fit import by_theta, fit_at, profile
from equipoise.estimation.modes.profile_estimate import with_unknowns
from equipoise.model.arrays import Square
from equipoise.model.estimate import Estimate, Parameter
from equipoise.model.hanging_mass import NAMES, HangingMass
from equipoise.model.reasons.mode_reasons import ModeReason
from equipoise.model.reasons.reason import Reason

UNITS = ("m", "rad", "-")


def hanging_parameters(mass: HangingMass, covariance: Square) -> tuple[Parameter, ...]:
    """Return the numbers of a mass that hangs."""
    sd, values = np.sqrt(np.diag(covariance)), (mass.sag, mass.heading, mass.spring)
    return tuple(
        Parameter(name, unit, value, float(one))
        for name, unit, value, one in zip(NAMES, UNITS, values, sd, strict=True)
    )


def with_hanging_numbers(concluded: Estimate, model: RecordModel) -> Estimate:
    """Return an estimate with the mass that hangs in its model; the same of one without."""
    if model.hanging is None or not concluded.outcome.usable:
        return concluded
    mass = model.hanging.mass

    def named(covariance: Square) -> tuple[Parameter, ...]:
        return hanging_parameters(mass, covariance)

    return with_unknowns(concluded, profile(), fit_at(model), by_theta(mass), named)


def hanging_reasons(model: RecordModel) -> list[Reason]:
    """Return the mass that hangs in the model, if there is one."""
    if model.hanging is None:
        return []
    mass = model.hanging.mass
    numbers = {"sag": mass.sag, "heading": mass.heading, "spring": mass.spring}
    return [Reason(ModeReason.MASS_HANGS, (), numbers)]
