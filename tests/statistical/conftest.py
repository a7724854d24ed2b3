"""Many runs of what other tests have checked call by call."""

import jaxtyping
import pytest


@pytest.fixture(autouse=True)
def _unchecked():
    """Leave out the shape checks: here they are up to half of the time."""
    jaxtyping.config.update("jaxtyping_disable", True)
    yield
    jaxtyping.config.update("jaxtyping_disable", False)
