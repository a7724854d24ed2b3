"""A mass that hangs, fitted with all that a model of a record holds (``profile_descent``).

Its unknowns are those that elastic sag has in the plane, and the share of its spring k,

    a (cos 2 h, sin 2 h),      k

with a its sag and h its heading: a mass that swings to +h swings to -h, too. Its torque follows
from the fitted motion; it hardly changes that, as attitudes are measured.

Cannot state all correlations: the torque is known in each fit, so how it changes with an attitude
that is wrong, as by a camera that leans, is not in them. Each number is within its interval as
stated; com over inertia, which long swings show to 1e-5, may be several of its own sd off.
"""

from dataclasses import replace

import numpy as np

from equipoise.dynamics.hanging_torque import HangingTorque
from equipoise.estimation.events.record_model import RecordModel, improbability, refitted
from equipoise.estimation.modes.modal_response import with_response
from equipoise.estimation.modes.profile_descent import Profile, ProfileFit, descended, fit_here
from equipoise.model.arrays import Floats
from equipoise.model.hanging_mass import HangingMass
from equipoise.model.torque_terms import SIZES

MEAN = 0.5  # of k, chosen: midway between what hangs and what bends
SD = 0.5  # of its prior, chosen: both are plausible
RANGE = (-0.5, 0.95)  # of k, chosen: what hangs may be seen a little below 0
LEAST = 1e-9  # m, chosen: no sag
TURNS = 3  # chosen: fits until a motion and the torque in it agree
VARIED = (0.05, 0.05, 0.05)  # natural sizes, chosen: of a first difference
BOLD = (1.0, 1.0, 0.5)  # natural sizes, chosen: of a step


def natural_sizes() -> Floats:
    """Return natural sizes of the unknowns: what sag usually is, and 1."""
    sag = SIZES["sag"][1]
    return np.array([sag, sag, 1.0])


def vector_of(mass: HangingMass) -> Floats:
    """Return the unknowns of a mass that hangs, from the mean of their prior."""
    x, y = np.cos(2.0 * mass.heading), np.sin(2.0 * mass.heading)
    return np.array([mass.sag * x, mass.sag * y, mass.spring - MEAN]) / natural_sizes()


def mass_at(theta: Floats) -> HangingMass:
    """Return the mass that hangs of unknowns."""
    x, y, k = theta * natural_sizes()
    sag = max(float(np.hypot(x, y)), LEAST)
    return HangingMass(sag, 0.5 * float(np.arctan2(y, x)), float(np.clip(MEAN + k, *RANGE)))


def by_theta(mass: HangingMass) -> Floats:
    """Return the derivative of sag (m), heading (rad) and spring by the unknowns."""
    x, y = np.cos(2.0 * mass.heading), np.sin(2.0 * mass.heading)
    turned = 0.5 / mass.sag
    rows = np.array([[x, y, 0.0], [-turned * y, turned * x, 0.0], [0.0, 0.0, 1.0]])
    return rows * natural_sizes()


def hung(model: RecordModel, mass: HangingMass) -> RecordModel:
    """Return the model fitted with a mass that hangs, in its own motion."""
    torque = model.hanging.torque if model.hanging else None
    model = replace(model, hanging=HangingTorque(mass, torque))
    for _ in range(TURNS):
        model = refitted(with_response(model, model.modes))
    return model


def at(model: RecordModel, theta: Floats) -> RecordModel:
    """Return the model fitted with the mass of unknowns."""
    return hung(model, mass_at(theta))


def profile() -> Profile:
    """Return what is sought."""
    return Profile(at, np.array([1.0, 1.0, SD]), np.array(BOLD), np.array(VARIED))


def fit_hanging(model: RecordModel, mass: HangingMass) -> ProfileFit:
    """Return the optimum of a mass that hangs and all else, from a first one."""
    return descended(profile(), model, vector_of(mass))


def improbability_of(found: ProfileFit) -> float:
    """Return -2 ln of how probable the record is, the mass's unknowns integrated out, too."""
    sd = profile().sd
    prior = float(np.sum((found.theta / sd) ** 2 + 2.0 * np.log(sd)))
    return improbability(found.model) + prior - float(np.linalg.slogdet(found.covariance)[1])


def settled_hanging(model: RecordModel) -> RecordModel:
    """Return the model with its mass that hangs at the optimum; without where it earns no place."""
    if model.hanging is None:
        return model
    found = fit_hanging(model, model.hanging.mass)
    less = refitted(with_response(replace(model, hanging=None), model.modes))
    earns = not less.fitted.converged or improbability_of(found) < improbability(less)
    return found.model if earns else less


def fit_at(model: RecordModel) -> ProfileFit:
    """Return what a model says of the mass that it is fitted with."""
    assert model.hanging is not None
    return fit_here(profile(), model, vector_of(model.hanging.mass))
