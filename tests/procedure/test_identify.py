"""Identify: methods from coarse to fine, one sentence each."""

import numpy as np
import pytest
from builders import COM, move_at, noisy, platform, recording

from equipoise.model.errors import InputError
from equipoise.procedure.identify import COARSE_TO_FINE, METHODS, IdentifyOptions, identify


@pytest.fixture(scope="module")
def seen():
    return noisy(recording(120.0, move_at(60.0, 120.0), 5.0, 20.0), 1)


TESTBED = platform(accuracy=1e-4, gyro=True)


def test_an_unknown_method_names_the_nearest(seen):
    with pytest.raises(InputError, match="did you mean 'trajectory'"):
        list(identify(seen, TESTBED, IdentifyOptions(method="trajektory")))


def test_auto_goes_from_coarse_to_fine(seen):
    """A look, then methods in their order; the last is the fit, and is right to 4 sd."""
    steps = list(identify(seen, TESTBED, IdentifyOptions()))
    assert [step.kind for step in steps] == ["look"] + ["estimate"] * (len(steps) - 1)
    names = [step.estimate.method for step in steps[1:]]
    assert names == [name for name in COARSE_TO_FINE if name in names]
    assert names[-1] == "trajectory"
    last = steps[-1].estimate
    sd = np.sqrt(np.diag(last.covariance_of(("com_x", "com_y", "com_z"))))
    assert np.all(np.abs(last.com - COM) < 4 * sd)


@pytest.mark.parametrize("method", METHODS)
def test_a_method_can_be_asked_for(seen, method):
    """One look, one estimate, whatever it can say."""
    steps = list(identify(seen, TESTBED, IdentifyOptions(method=method)))
    assert [step.kind for step in steps] == ["look", "estimate"]
    assert steps[1].estimate.method == method
    assert steps[1].sentence.startswith(f"{method}: ")
