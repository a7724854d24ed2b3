"""What counts as quiet at a depth: the same offset, whatever the swing's period."""

import numpy as np
import pytest

from equipoise.control.plant.moving_means import at_depth
from equipoise.control.plant.pendulum import hanging
from equipoise.control.plant.settling import bounds
from tests.support.simple_loop import guess


def test_settling_bounds_on_tilt_and_rate_scale_with_depth():
    """Tilt offset / depth; rate that times sqrt(m g depth / J); shift and times as they were."""
    plant = hanging(guess())
    deep, shallow = bounds(plant, 1e-7), at_depth(bounds(plant, 1e-7), plant.depth, 2e-5)
    assert shallow.tilt == pytest.approx(1e-7 / 2e-5)
    w = float(np.sqrt(plant.gain.min() * 2e-5))
    assert shallow.rate == pytest.approx(w * 1e-7 / 2e-5)
    assert (shallow.shift, shallow.memory) == (deep.shift, deep.memory)
