"""Identify: methods from coarse to fine, one sentence each."""

import numpy as np
import pytest

from equipoise.estimation.methods.registry import METHODS
from equipoise.maths.linalg import pack_symmetric
from equipoise.model.errors import InputError
from equipoise.model.estimate import END, INERTIA
from equipoise.procedure.identification.identify import COARSE_TO_FINE, IdentifyOptions, identify
from tests.support.builders import COM, MASS, move_at, noisy, platform, recording


@pytest.fixture(scope="module")
def observed():
    return noisy(recording(120.0, move_at(60.0, 120.0), 5.0, 20.0), 1)


@pytest.fixture(scope="module")
def briefly():
    """The same swing for as long as any method needs."""
    return noisy(recording(30.0, move_at(15.0, 30.0), 5.0, 20.0), 1)


pytestmark = pytest.mark.usefixtures("few_draws")

TESTBED = platform(accuracy=1e-4, gyro=True)


def test_an_unknown_method_names_the_nearest(observed):
    with pytest.raises(InputError, match="did you mean 'trajectory'"):
        list(identify(observed, TESTBED, IdentifyOptions(method="trajektory")))


def test_auto_goes_from_coarse_to_fine(observed):
    """A measurement, then methods in their order; the last is the fit, and is right to 4 sd."""
    steps = list(identify(observed, TESTBED, IdentifyOptions()))
    assert [step.kind for step in steps] == ["measurement"] + ["estimate"] * (len(steps) - 1)
    names = [step.estimate.method for step in steps[1:]]
    assert names == [name for name in COARSE_TO_FINE if name in names]
    assert names[-1] == "trajectory"
    last = steps[-1].estimate
    sd = np.sqrt(np.diag(last.covariance_of(("com_x", "com_y", "com_z"))))
    assert np.all(np.abs(last.com - COM) < 4 * sd)


@pytest.mark.parametrize("method", METHODS)
def test_a_method_can_be_requested(briefly, method):
    """One measurement, one estimate, whatever its outcome."""
    steps = list(identify(briefly, TESTBED, IdentifyOptions(method=method)))
    assert [step.kind for step in steps] == ["measurement", "estimate"]
    assert steps[1].estimate.method == method
    assert steps[1].sentence.startswith(f"{method}: ")


def test_the_tracker_says_where_the_centre_of_mass_is_at_the_end(observed):
    """After a move, the masses as they stand, and the inertia: within 4 sd.

    Known to 2 um and 2 % of J_zz, a priori 100 um and 10 %.
    """
    found = list(identify(observed, TESTBED, IdentifyOptions(method="tracker")))[-1].estimate
    names = (*END, *INERTIA)
    true = [
        *(COM + np.array([-10e-3, -10e-3, -50e-3]) * 0.0156 / MASS),
        *pack_symmetric(TESTBED.body.inertia_P),
    ]
    sd = np.sqrt(np.diag(found.covariance_of(names)))
    assert np.all(np.abs(found.values(names) - true) < 4 * sd)
    assert np.all(sd < np.repeat([2e-6, 0.02 * 0.878], [3, 6]))
