"""Testbeds of round numbers, so that their motion can be computed by hand."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.model.mass_properties import MassProperties
from equipoise.model.testbed import AttitudeSensor, Gyro, SlidingMass, Testbed, Truth

LEVEL = np.zeros(3)


@pytest.fixture
def rail():
    """Return a maker of masses: 0.5 kg, from -50 to 50 mm at 10 mm/s, exact unless stated."""

    def make(name="x", axis=(1.0, 0.0, 0.0), home=(0.0, 0.2, -0.05), **changes):
        mass = SlidingMass(name, 0.5, np.array(home), np.array(axis), (-0.05, 0.05), 0.0, 0.0, 0.0,
                           0.01)  # fmt: skip
        return replace(mass, **changes)

    return make


@pytest.fixture
def truth():
    """Return a maker of truths: level, at rest and balanced unless stated."""

    def make(**changes):
        given = Truth(LEVEL, LEVEL, LEVEL, None, 0.0, LEVEL, 0.0, LEVEL, 0.0, {}, 0.0, 30.0, LEVEL)
        return replace(given, **changes)

    return make


@pytest.fixture
def testbed(truth):
    """Return a maker of testbeds: 10 kg, J = diag(1, 2, 2.5) kg m^2, sensors without noise.

    It may turn over: there is no stop.
    """

    def make(com=(0.0, 0.0, 0.0), **changes):
        com = np.array(com)
        body = MassProperties(10.0, com, np.diag([1.0, 2.0, 2.5]))
        start = truth(com=com, inertia_P=body.inertia_P)
        plain = Testbed(
            "plain", body, 0.1, np.full(3, 1e-4), np.array([0.0, 0.0, 1.0]), np.pi, 9.81,
            attitude=AttitudeSensor(5.0, 0.0), gyro=Gyro(50.0, 0.0, 0.0), truth=start,
        )  # fmt: skip
        own = changes.pop("truth", {})
        return replace(plain, truth=replace(start, **own), **changes)

    return make
