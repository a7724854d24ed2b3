"""The platforms that may be there, and how a hand may let them go: the scenarios of a plan.

    body    centre of mass and moments drawn from the prior, again until they are consistent
    start   the planned one, with a hand's error

The first of several is the expected one: no error anywhere.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from equipoise.estimation.parameters.fit_parameters import core_of
from equipoise.maths import pseudo_inertia
from equipoise.maths.attitude import exponential, multiply
from equipoise.maths.linalg import element_sizes, unpack_symmetric
from equipoise.model.arrays import Floats, Quaternion, Square, Vector3
from equipoise.model.manoeuvre import Manoeuvre
from equipoise.model.mass_properties import MassProperties, is_possible
from equipoise.model.testbed import Testbed

TRIES = 1000  # chosen: draws of a body before the prior counts as impossible


@dataclass(frozen=True, slots=True, eq=False)
class Prior:
    """The prior of inertia and centre of mass: a normal distribution."""

    body: MassProperties
    covariance: Square  # (9, 9) SI


@dataclass(frozen=True, slots=True, eq=False)
class Scenario:
    """One platform, and how far its start is off the planned one, in sd of the hand."""

    body: MassProperties
    lean: Vector3  # -, about the body's axes
    push: Vector3  # -


@dataclass(frozen=True, slots=True, eq=False)
class Platforms:
    """Several scenarios as arrays, one row each."""

    six: Floats  # (k, 6) inertia about the centre of mass, as ``maths.pseudo_inertia`` has it
    com: Floats  # (k, 3) m
    lean: Floats  # (k, 3) -
    push: Floats  # (k, 3) -

    def part(self, start: int, stop: int | None = None) -> "Platforms":
        """Return some of them."""
        rows = slice(start, stop)
        return Platforms(self.six[rows], self.com[rows], self.lean[rows], self.push[rows])


def platforms_of(several: Sequence[Scenario]) -> Platforms:
    """Return scenarios as arrays."""
    return Platforms(
        np.array([pseudo_inertia.from_inertia(each.body.inertia_C) for each in several]),
        np.array([each.body.com for each in several]),
        np.array([each.lean for each in several]),
        np.array([each.push for each in several]),
    )


def let_go(
    q0: Quaternion, manoeuvre: Manoeuvre, lean: Floats, push: Floats, up: Vector3
) -> tuple[Floats, Floats]:
    """Return attitude and rate (rad/s) with which a hand lets go that aims at ``q0``.

    ``lean`` and ``push`` are in its sd, (3,) or a row each, and so is what is returned.
    """
    aside = manoeuvre.tilt_sd * (lean - (lean @ up)[..., None] * up)
    return multiply(q0, exponential(aside)), manoeuvre.rate + manoeuvre.rate_sd * push


def stated_prior(testbed: Testbed) -> Prior:
    """Return the prior by a testbed's nominal values."""
    inertia_sd = testbed.inertia_sd * element_sizes(testbed.body.inertia_P)
    return Prior(testbed.body, np.diag(np.concatenate([inertia_sd, testbed.com_sd]) ** 2))


def scenarios(prior: Prior, count: int, rng: np.random.Generator) -> list[Scenario]:
    """Return the expected scenario, and further draws."""
    zero = np.zeros(3)
    drawn = [
        Scenario(drawn_body(prior, rng), rng.standard_normal(3), rng.standard_normal(3))
        for _ in range(count - 1)
    ]
    return [Scenario(prior.body, zero, zero), *drawn]


def drawn_body(prior: Prior, rng: np.random.Generator) -> MassProperties:
    """Return a body that can be, with the masses at home; the expected one if none is found."""
    mean = core_of(prior.body)
    for _ in range(TRIES):
        core: Floats = rng.multivariate_normal(mean, prior.covariance)
        body = MassProperties(prior.body.mass, core[6:], unpack_symmetric(core[:6]))
        if is_possible(body):
            return body
    return prior.body
