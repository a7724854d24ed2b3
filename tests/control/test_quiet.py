"""What counts as quiet at a depth: the same offset, whatever the swing's period."""

import numpy as np
import pytest

from equipoise.control.plant.pendulum import hanging
from equipoise.control.plant.settling import at_depth, bounds
from tests.control.simple_loop import guess


def test_an_offset_tilts_twice_as_far_at_half_the_depth_and_swings_as_slowly_as_it_hangs():
    """Tilt offset / depth; rate that times sqrt(m g depth / J); shift and times as they were."""
    plant = hanging(guess())
    deep, shallow = bounds(plant, 1e-7, 0.5), at_depth(bounds(plant, 1e-7, 0.5), plant.depth, 2e-5)
    assert shallow.tilt == pytest.approx(1e-7 / 2e-5)
    w = float(np.sqrt(plant.gain.min() * 2e-5))
    assert shallow.rate == pytest.approx(w * 1e-7 / 2e-5)
    assert (shallow.shift, shallow.memory, shallow.hold) == (deep.shift, deep.memory, deep.hold)
